// SPDX-License-Identifier: MIT
// Embree's hierarchy over user geometry: one geometry of as many primitives as there are instances,
// whose boxes are ours, and whose casts are callbacks.
#include <algorithm>

#include "bench/image/clock.h"
#include "bench/image/embree_scene.h"
#include "bench/image/rounded_box_entry.h"
#include "bench/image/subject.h"
#include "bench/image/tracers.h"
#include "core/cast/cast.h"

namespace minkray::bench {
namespace {

/// `Caster` answers FirstHit cast(instance, Ray<float>), with a world normal; it has the boxes
/// until the hierarchy is built.
template <class Caster>
class UserGeometry : public Tracer {
 public:
  UserGeometry(const Scene& scene, int threads) : top_(threads), caster_(scene) {
    const FirstTouchVector<Bounds<float>> boxes = caster_.take_boxes();
    const Clock clock;
    RTCGeometry geometry = rtcNewGeometry(top_.device(), RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(boxes.size()));
    boxes_ = boxes.data();
    rtcSetGeometryUserData(geometry, this);
    rtcSetGeometryBoundsFunction(geometry, &UserGeometry::box_of, this);
    rtcSetGeometryIntersectFunction(geometry, &UserGeometry::intersect);
    rtcSetGeometryOccludedFunction(geometry, &UserGeometry::occlude);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(top_.scene(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(top_.scene());
    hierarchy_seconds_ = clock.seconds_on(threads);
  }

  std::vector<std::string> entries() const override { return embree_entries(); }
  std::unique_ptr<RayQueue> queue(std::size_t entry) const override {
    return embree_queue(top_.scene(), EmbreeNumber::primitive, entry);
  }
  Vec3<float> world_normal(const FirstHit& hit) const override { return hit.normal; }
  std::size_t bytes() const override { return top_.bytes() + caster_.bytes(); }
  double hierarchy_seconds() const override { return hierarchy_seconds_; }

 private:
  static void box_of(const RTCBoundsFunctionArguments* arguments) {
    const auto* self = static_cast<const UserGeometry*>(arguments->geometryUserPtr);
    const Bounds<float>& box = self->boxes_[arguments->primID];
    RTCBounds& to = *arguments->bounds_o;
    to.lower_x = box.lower.x();
    to.lower_y = box.lower.y();
    to.lower_z = box.lower.z();
    to.upper_x = box.upper.x();
    to.upper_y = box.upper.y();
    to.upper_z = box.upper.z();
  }

  static Ray<float> ray_in(RTCRayN* rays, unsigned n, unsigned i) {
    return {{RTCRayN_org_x(rays, n, i), RTCRayN_org_y(rays, n, i), RTCRayN_org_z(rays, n, i)},
            {RTCRayN_dir_x(rays, n, i), RTCRayN_dir_y(rays, n, i), RTCRayN_dir_z(rays, n, i)},
            RTCRayN_tfar(rays, n, i)};
  }

  static void intersect(const RTCIntersectFunctionNArguments* arguments) {
    const auto* self = static_cast<const UserGeometry*>(arguments->geometryUserPtr);
    const unsigned n = arguments->N;
    RTCRayN* rays = RTCRayHitN_RayN(arguments->rayhit, n);
    RTCHitN* hits = RTCRayHitN_HitN(arguments->rayhit, n);
    for (unsigned i = 0; i < n; ++i) {
      if (!arguments->valid[i]) continue;
      const FirstHit hit = self->caster_.cast(arguments->primID, ray_in(rays, n, i));
      if (!hit.found()) continue;
      RTCRayN_tfar(rays, n, i) = hit.t;
      RTCHitN_Ng_x(hits, n, i) = hit.normal.x();
      RTCHitN_Ng_y(hits, n, i) = hit.normal.y();
      RTCHitN_Ng_z(hits, n, i) = hit.normal.z();
      RTCHitN_primID(hits, n, i) = arguments->primID;
      RTCHitN_geomID(hits, n, i) = arguments->geomID;
    }
  }

  static void occlude(const RTCOccludedFunctionNArguments* arguments) {
    const auto* self = static_cast<const UserGeometry*>(arguments->geometryUserPtr);
    const unsigned n = arguments->N;
    for (unsigned i = 0; i < n; ++i) {
      if (!arguments->valid[i]) continue;
      if (self->caster_.cast(arguments->primID, ray_in(arguments->ray, n, i)).found())
        RTCRayN_tfar(arguments->ray, n, i) = -std::numeric_limits<float>::infinity();
    }
  }

  EmbreeScene top_;
  Caster caster_;
  const Bounds<float>* boxes_ = nullptr;
  double hierarchy_seconds_ = 0;
};

class OurCast {
 public:
  explicit OurCast(const Scene& scene) : instances_(instances_of(scene)) {}

  FirstTouchVector<Bounds<float>> take_boxes() { return instances_.take_boxes(); }
  std::size_t bytes() const { return instances_.bytes(); }
  FirstHit cast(unsigned instance, const Ray<float>& ray) const {
    const CastResult<double> result = cast_ray(
        instances_.at(instance),
        Ray<double>{ray.origin.cast<double>(), ray.direction.cast<double>(), double(ray.t_max)});
    if (result.status != Status::hit || !(result.t() < double(ray.t_max))) return {};
    return {static_cast<float>(result.t()), instance, result.normal.cast<float>()};
  }

 private:
  Instances instances_;
};

/// Rounded boxes by the formula.
class ClosedForm {
 public:
  explicit ClosedForm(const Scene& scene) {
    boxes_ = instances_of(scene).take_boxes();
    for (const Shape& shape : shapes_of(scene)) {
      const auto& rounded = std::get<Rounded>(shape.kind);
      const auto& box = std::get<Box>(rounded.shape->kind);
      shapes_.push_back({box.half_extents.cast<float>(), static_cast<float>(rounded.radius)});
    }
    for_each_instance(scene, [&](std::uint32_t shape, const Affine<double>& pose) {
      places_.push_back({Mat3<float>(inverse_of(pose.linear).cast<float>()),
                         pose.translation.cast<float>(), shape});
    });
  }

  FirstTouchVector<Bounds<float>> take_boxes() { return std::move(boxes_); }
  std::size_t bytes() const { return places_.capacity() * sizeof(Place); }
  FirstHit cast(unsigned instance, const Ray<float>& ray) const {
    const Place& place = places_[instance];
    const Vec3<float> from = ray.origin - place.centre;
    const RoundedBoxEntry entry =
        rounded_box_entry(shapes_[place.shape].half, shapes_[place.shape].radius,
                          {place.to_shape * from, place.to_shape * ray.direction, ray.t_max});
    if (!(entry.t < ray.t_max)) return {};
    // The poses only turn: the inverse is the transpose.
    return {entry.t, instance, place.to_shape.transpose() * entry.normal};
  }

 private:
  struct RoundedBox {
    Vec3<float> half;
    float radius;
  };
  struct Place {
    Mat3<float> to_shape;
    Vec3<float> centre;
    std::uint32_t shape;
  };
  FirstTouchVector<Bounds<float>> boxes_;
  std::vector<RoundedBox> shapes_;
  std::vector<Place> places_;
};

bool is_rounded_box(const Shape& shape) {
  const auto* rounded = std::get_if<Rounded>(&shape.kind);
  return rounded && std::holds_alternative<Box>(rounded->shape->kind);
}

}  // namespace

std::unique_ptr<Tracer> embree_with_our_cast(const Scene& scene, int threads) {
  return std::make_unique<UserGeometry<OurCast>>(scene, threads);
}

bool has_closed_form(const Scene& scene) {
  const std::vector<Shape> shapes = shapes_of(scene);
  return std::all_of(shapes.begin(), shapes.end(), is_rounded_box);
}

std::unique_ptr<Tracer> embree_with_closed_form(const Scene& scene, int threads) {
  return std::make_unique<UserGeometry<ClosedForm>>(scene, threads);
}

}  // namespace minkray::bench
