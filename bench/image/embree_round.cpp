// SPDX-License-Identifier: MIT
// Embree's own round geometry: spheres, and round curves of one piece each, which are capsules.
#include "bench/image/clock.h"
#include "bench/image/embree_scene.h"
#include "bench/image/subject.h"
#include "bench/image/tracers.h"

namespace minkray::bench {
namespace {

/// An instance is a primitive of one geometry.
class RoundGeometry : public Tracer {
 public:
  RoundGeometry(const Scene& scene, bool are_capsules, int threads) : top_(threads) {
    const std::vector<Shape> shapes = shapes_of(scene);
    std::vector<std::array<float, 4>> points;  ///< with radii; two of each capsule
    const auto add = [&](const Vec3<double>& point, double radius) {
      points.push_back({static_cast<float>(point.x()), static_cast<float>(point.y()),
                        static_cast<float>(point.z()), static_cast<float>(radius)});
    };
    for_each_instance(scene, [&](std::uint32_t shape, const Affine<double>& pose) {
      if (!are_capsules) return add(pose.translation, std::get<Sphere>(shapes[shape].kind).radius);
      const auto& capsule = std::get<Capsule>(shapes[shape].kind);
      for (const double z : {-capsule.half_height, capsule.half_height})
        add(pose(Vec3<double>(0, 0, z)), capsule.radius);
    });
    const Clock clock;
    RTCGeometry geometry =
        rtcNewGeometry(top_.device(), are_capsules ? RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE
                                                   : RTC_GEOMETRY_TYPE_SPHERE_POINT);
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
    void* const vertices = rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, sizeof(points[0]), points.size());
    std::copy(points.begin(), points.end(), static_cast<std::array<float, 4>*>(vertices));
    if (are_capsules) {
      const std::size_t count = points.size() / 2;
      auto* firsts = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
          geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, sizeof(unsigned), count));
      for (unsigned i = 0; i < count; ++i) firsts[i] = 2 * i;
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(top_.scene(), geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneBuildQuality(top_.scene(), RTC_BUILD_QUALITY_HIGH);
    rtcCommitScene(top_.scene());
    hierarchy_seconds_ = clock.seconds_on(threads);
  }

  std::vector<std::string> entries() const override { return embree_entries(); }
  std::unique_ptr<RayQueue> queue(std::size_t entry) const override {
    return embree_queue(top_.scene(), EmbreeNumber::primitive, entry);
  }
  Vec3<float> world_normal(const FirstHit& hit) const override { return hit.normal.normalized(); }
  std::size_t bytes() const override { return top_.bytes(); }
  double hierarchy_seconds() const override { return hierarchy_seconds_; }

 private:
  EmbreeScene top_;
  double hierarchy_seconds_ = 0;
};

template <class S>
bool all_are(const Scene& scene) {
  const std::vector<Shape> shapes = shapes_of(scene);
  return std::all_of(shapes.begin(), shapes.end(),
                     [](const Shape& shape) { return std::holds_alternative<S>(shape.kind); });
}

}  // namespace

bool has_round_geometry(const Scene& scene) {
  return all_are<Sphere>(scene) || all_are<Capsule>(scene);
}

std::unique_ptr<Tracer> embree_round(const Scene& scene, int threads) {
  return std::make_unique<RoundGeometry>(scene, all_are<Capsule>(scene), threads);
}

}  // namespace minkray::bench
