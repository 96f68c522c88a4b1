// SPDX-License-Identifier: MIT
#include "renderer/light/scene_surfaces.h"

#include "renderer/scene/scene_instances.h"

namespace minkray {

std::vector<std::uint32_t> material_of_instance(const Scene& scene) {
  std::vector<std::uint32_t> of_instance;
  of_instance.reserve(instance_count(scene));
  for (const Object& object : scene.objects) of_instance.push_back(object.material);
  for (const ParticleSet& set : scene.particles)
    for (std::size_t i = 0; i < set.size(); ++i) of_instance.push_back(set.material(i));
  return of_instance;
}

Colour radiance_of(const Material& material) {
  const auto* emissive = std::get_if<EmissiveMaterial>(&material.kind);
  return emissive ? emissive->radiance : Colour(Colour::Zero());
}

SceneSurfaces::SceneSurfaces(const Scene& scene) : of_instance_(material_of_instance(scene)) {
  for (const Material& material : scene.materials) {
    PreparedMaterial& made = materials_.emplace_back();
    made.bsdf = make_bsdf(material);
    made.radiance = radiance_of(material);
    if (const auto* glass = std::get_if<DielectricMaterial>(&material.kind))
      made.inside = {glass->index_of_refraction, glass->absorption, glass->priority};
  }
  for (const Object& object : scene.objects)
    axes_.push_back(unit<double>(object.pose.linear * Vec3<double>::UnitZ()));
}

std::vector<Colour> SceneSurfaces::radiances() const {
  std::vector<Colour> radiances;
  radiances.reserve(of_instance_.size());
  for (const std::uint32_t material : of_instance_)
    radiances.push_back(materials_[material].radiance);
  return radiances;
}

}  // namespace minkray
