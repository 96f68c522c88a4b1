// SPDX-License-Identifier: MIT
#include "renderer/surfaces/looks_of_meshes.h"

namespace minkray {

LooksOfMeshes::LooksOfMeshes(const Scene& scene) {
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    if (!object.mesh || !object.look || !object.look->attributes) continue;
    looks_.resize(i + 1);
    const Mat3<double> linear = inverse_of(object.pose.linear);
    looks_[i] = {object.mesh, object.look, {linear, -(linear * object.pose.translation)}};
  }
}

std::uint32_t LooksOfMeshes::material(std::uint32_t instance, std::uint32_t part,
                                      std::uint32_t otherwise) const {
  const Look* look = of(instance);
  if (!look || part >= look->of->attributes->material_of.size()) return otherwise;
  const std::uint32_t number = look->of->attributes->material_of[part];
  return number < look->of->materials.size() ? look->of->materials[number] : otherwise;
}

MeshPoint LooksOfMeshes::at(const SurfaceHit& hit, const Vec3<double>& point) const {
  const Look* look = of(hit.instance);
  if (!look || hit.part >= look->mesh->size()) return {};
  return mesh_point(*look->mesh, *look->of->attributes, hit.part, point);
}

Vec3<double> LooksOfMeshes::normal(const World& world, const SurfaceHit& hit,
                                   const Vec3<double>& point, double time) const {
  if (!has_normals(hit.instance)) return hit.normal;
  const Instances& instances = world.instances();
  const Affine<double>& to_mesh = looks_[hit.instance].to_mesh;
  const MeshPoint found = at(hit, to_mesh(instances.seen_by(hit.instance, point, time)));
  if (found.normal.isZero(0)) return hit.normal;
  // Normals go by the transposed inverse of the map.
  const Vec3<double> normal =
      instances.turned(hit.instance, unit<double>(to_mesh.linear.transpose() * found.normal), time);
  return normal.dot(hit.normal) < 0 ? Vec3<double>(-normal) : normal;
}

}  // namespace minkray
