// SPDX-License-Identifier: MIT
#include "bench/peers/closed_forms.h"
#include "bench/peers/others.h"

namespace minkray::bench {
namespace {

template <class Entry>
Peers one(Entry entry) {
  Peers peers;
  peers.push_back(single_rays<float>(
      "closed-form/float", [entry](const Ray<float>& ray) { return entry(ray); }, hit_at));
  return peers;
}

}  // namespace

Peers closed_forms(const Shape& shape) {
  if (const auto* s = std::get_if<Sphere>(&shape.kind))
    return one([radii = Vec3<float>(Vec3<float>::Constant(static_cast<float>(s->radius)))](
                   const Ray<float>& ray) { return ellipsoid_entry(radii, ray); });
  if (const auto* s = std::get_if<Ellipsoid>(&shape.kind))
    return one([radii = Vec3<float>(s->radii.cast<float>())](const Ray<float>& ray) {
      return ellipsoid_entry(radii, ray);
    });
  if (const auto* s = std::get_if<Box>(&shape.kind))
    return one([extents = Vec3<float>(s->half_extents.cast<float>())](const Ray<float>& ray) {
      return box_entry(extents, ray);
    });
  if (const auto* s = std::get_if<Cylinder>(&shape.kind))
    return one([r = static_cast<float>(s->radius), h = static_cast<float>(s->half_height)](
                   const Ray<float>& ray) { return cylinder_entry(r, h, ray); });
  if (const auto* s = std::get_if<Capsule>(&shape.kind))
    return one([r = static_cast<float>(s->radius), h = static_cast<float>(s->half_height)](
                   const Ray<float>& ray) { return capsule_entry(r, h, ray); });
  if (const auto* s = std::get_if<Cone>(&shape.kind))
    return one([r = static_cast<float>(s->radius), h = static_cast<float>(s->half_height)](
                   const Ray<float>& ray) { return cone_entry(r, h, ray); });
  if (const auto* s = std::get_if<Rounded>(&shape.kind))
    if (const auto* box = std::get_if<Box>(&s->shape->kind))
      return one([extents = Vec3<float>(box->half_extents.cast<float>()),
                  r = static_cast<float>(s->radius)](const Ray<float>& ray) {
        return rounded_box_entry(extents, r, ray);
      });
  return {};
}

}  // namespace minkray::bench
