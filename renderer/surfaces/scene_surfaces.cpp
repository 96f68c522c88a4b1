// SPDX-License-Identifier: MIT
#include "renderer/surfaces/scene_surfaces.h"

#include <algorithm>

#include "renderer/scene/scene_instances.h"
#include "renderer/surfaces/conductor_bsdf.h"
#include "renderer/surfaces/mix_bsdf.h"
#include "renderer/surfaces/relief_normal.h"

namespace minkray {

std::vector<std::uint32_t> material_of_instance(const Scene& scene) {
  std::vector<std::uint32_t> of_instance;
  of_instance.reserve(instance_count(scene));
  for (const Object& object : scene.objects) of_instance.push_back(object.material);
  for (const ParticleSet& set : scene.particles)
    for (std::size_t i = 0; i < set.size(); ++i) of_instance.push_back(set.material(i));
  return of_instance;
}

Colour radiance_of(const Scene& scene, const Material& material) {
  if (const auto* emissive = std::get_if<EmissiveMaterial>(&material.kind))
    return emissive->radiance;
  if (const auto* mix = std::get_if<MixMaterial>(&material.kind)) {
    const auto of = [&](std::size_t i) -> Colour {
      return radiance_of(scene, scene.materials[mix->materials.indices[i]]);
    };
    return (1 - mix->amount) * of(0) + mix->amount * of(1);
  }
  return Colour::Zero();
}

namespace {

/// Medium inside a body of the material; for a mixture that of its second part, if that transmits
/// light.
Medium medium_of(const Scene& scene, const Material& material) {
  if (const auto* glass = std::get_if<DielectricMaterial>(&material.kind))
    return {glass->index_of_refraction, glass->absorption, glass->priority};
  if (const auto* layers = std::get_if<PrincipledMaterial>(&material.kind))
    return {layers->index_of_refraction, Colour::Zero(), 0};
  if (const auto* mix = std::get_if<MixMaterial>(&material.kind)) {
    const Medium second = medium_of(scene, scene.materials[mix->materials.indices[1]]);
    return second.eta != 1 ? second : medium_of(scene, scene.materials[mix->materials.indices[0]]);
  }
  return {};
}

/// True if all parts of the material that transmit light are thin sheets.
bool is_sheet(const Scene& scene, const Material& material) {
  if (std::holds_alternative<TranslucentMaterial>(material.kind)) return true;
  const auto* mix = std::get_if<MixMaterial>(&material.kind);
  if (!mix) return false;
  bool any = false;
  for (const std::uint32_t i : mix->materials.indices) {
    const Material& part = scene.materials[i];
    const auto* layers = std::get_if<PrincipledMaterial>(&part.kind);
    if (std::holds_alternative<DielectricMaterial>(part.kind) ||
        (layers && layers->transmission > 0))
      return false;
    any = any || is_sheet(scene, part);
  }
  return any;
}

/// Main colour of a material: for metals, what they mirror straight ahead; for glass, white.
Paint paint_of(const Scene& scene, const Material& material) {
  if (const auto* metal = std::get_if<ConductorMaterial>(&material.kind)) {
    for (const Metal& known : metals)
      if (known.name == metal->metal.name) return MetalFresnel(known).straight_ahead();
    return metal->colour.value_or(Colour::Ones());
  }
  if (const auto* mix = std::get_if<MixMaterial>(&material.kind)) {
    const auto of = [&](std::size_t i) {
      return paint_of(scene, scene.materials[mix->materials.indices[i]]).colour();
    };
    return (1 - mix->amount) * of(0) + mix->amount * of(1);
  }
  if (std::holds_alternative<DielectricMaterial>(material.kind)) return Colour::Ones();
  return std::visit(
      []<class M>(const M& kind) -> Paint {
        if constexpr (!std::is_same_v<M, ConductorMaterial> && requires { Paint(kind.colour); })
          return kind.colour;
        else
          return Colour::Zero();
      },
      material.kind);
}

}  // namespace

SceneSurfaces::SceneSurfaces(const Scene& scene)
    : of_instance_(material_of_instance(scene)), looks_(scene) {
  for (const Material& material : scene.materials) {
    PreparedMaterial made;
    if (const auto* mix = std::get_if<MixMaterial>(&material.kind))
      made.bsdf =
          std::make_unique<MixBsdf>(*materials_[mix->materials.indices[0]].bsdf,
                                    *materials_[mix->materials.indices[1]].bsdf, mix->amount);
    else
      made.bsdf = make_bsdf(material);
    made.radiance = radiance_of(scene, material);
    made.colour = paint_of(scene, material);
    made.inside = medium_of(scene, material);
    made.relief = in_numbers(material.relief);
    made.is_sheet = is_sheet(scene, material);
    has_sheets_ = has_sheets_ || made.is_sheet;
    materials_.push_back(std::move(made));
    has_textures_ = has_textures_ || is_painted(material);
  }
  for (const Object& object : scene.objects) {
    axes_.push_back(unit<double>(object.pose.linear * Vec3<double>::UnitZ()));
    const Mat3<double> linear = inverse_of(object.pose.linear);
    to_object_.push_back({linear, -(linear * object.pose.translation)});
  }
}

TexturePoint SceneSurfaces::place(const World& world, const SurfaceHit& hit,
                                  const Vec3<double>& point, double time,
                                  const Vec3<double>& direction, const RayCone& cone) const {
  const Instances& instances = world.instances();
  const std::uint32_t instance = hit.instance;
  const auto [at_rest, n, unused] =
      instances.seen_by(instance, Ray<double>{point, hit.normal}, time);
  SurfaceFootprint footprint = footprint_of(cone, direction, hit.normal);
  for (Vec3<double>& axis : footprint) axis = instances.unturned(instance, axis, time);
  if (instance >= to_object_.size())
    return {at_rest - instances.at(instance).centre(), n, footprint};
  const Affine<double>& to_object = to_object_[instance];
  for (Vec3<double>& axis : footprint) axis = to_object.linear * axis;
  // Normals go by the transposed inverse of the map.
  TexturePoint place{to_object(at_rest), unit<double>(inverse_of(to_object.linear).transpose() * n),
                     footprint};
  if (looks_.none() || hit.part == no_part) return place;
  const MeshPoint found = looks_.at(hit, place.position);
  place.uv = found.uv;
  place.uv_slopes = found.uv_slopes;
  place.has_uv = found.has_uv;
  if (!found.normal.isZero(0))
    place.normal = found.normal.dot(place.normal) < 0 ? Vec3<double>(-found.normal) : found.normal;
  return place;
}

void SceneSurfaces::describe(const World& world, const Ray<double>& ray, const RayCone& cone,
                             const WorldHit& hit, Colour& albedo, Colour& emission) const {
  if (hit.cast.status != Status::hit) return;
  const PreparedMaterial& material = of(hit.instance, hit.part);
  emission = material.radiance;
  albedo = material.colour.colour();
  if (material.colour.texture())
    albedo = paint_at(material.colour, place(world, surface_hit(hit), ray.at(hit.cast.t()), 0,
                                             ray.direction, cone.at(hit.cast.t())));
}

Vec3<double> SceneSurfaces::uv(const World& world, const Ray<double>& ray,
                               const WorldHit& hit) const {
  if (hit.cast.status != Status::hit) return Vec3<double>::Zero();
  const TexturePoint at =
      place(world, surface_hit(hit), ray.at(hit.cast.t()), 0, ray.direction, {});
  return at.has_uv ? at.uv : radial_place(at.position);
}

Vec3<double> SceneSurfaces::relief_normal_at(std::uint32_t instance, const TexturePoint& at) const {
  const Vec3<double> normal = relief_normal(of(instance).relief, at);
  if (instance >= to_object_.size()) return normal;
  return unit<double>(to_object_[instance].linear.transpose() * normal);
}

bool SceneSurfaces::has_lamps() const {
  return std::ranges::any_of(materials_, [](const PreparedMaterial& material) {
    return material.radiance.maxCoeff() > 0;
  });
}

std::vector<Colour> SceneSurfaces::radiances() const {
  std::vector<Colour> radiances;
  radiances.reserve(of_instance_.size());
  for (const std::uint32_t material : of_instance_)
    radiances.push_back(materials_[material].radiance);
  return radiances;
}

}  // namespace minkray
