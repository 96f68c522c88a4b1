// SPDX-License-Identifier: MIT
#include "renderer/surfaces/looks_of_meshes.h"

#include <cmath>

namespace minkray {
namespace {

/// Normals that lean by more than 60 degrees are those of no surface near the triangle: light from
/// behind such a triangle does not reach its front.
constexpr double least_curved_cosine = 0.5;

}  // namespace

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

SmoothPoint LooksOfMeshes::smooth(const World& world, const SurfaceHit& hit,
                                  const Vec3<double>& point, double time) const {
  if (!has_normals(hit.instance)) return {hit.normal};
  const Instances& instances = world.instances();
  const Look& look = looks_[hit.instance];
  const Vec3<double> at_rest = look.to_mesh(instances.seen_by(hit.instance, point, time));
  const MeshPoint found = at(hit, at_rest);
  if (found.normal.isZero(0)) return {hit.normal};
  const Mat3<double>& to_mesh = look.to_mesh.linear;
  // Normals go by the transposed inverse of the map.
  const Vec3<double> normal =
      instances.turned(hit.instance, unit<double>(to_mesh.transpose() * found.normal), time);
  const double cosine = normal.dot(hit.normal);
  const bool is_back = cosine < 0;
  SmoothPoint smooth{is_back ? Vec3<double>(-normal) : normal};
  smooth.is_curved = std::abs(cosine) >= least_curved_cosine;
  if (smooth.is_curved)
    smooth.lift = instances.turned(
        hit.instance,
        way_to_smooth(*look.mesh, *look.of->attributes, hit.part, at_rest, to_mesh, is_back), time);
  return smooth;
}

}  // namespace minkray
