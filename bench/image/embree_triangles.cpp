// SPDX-License-Identifier: MIT
// Embree on triangles, as its manual builds a scene for speed: each mesh once, and instances of
// it. A shape that occurs in one place only is not worth an instance: its triangles go into the
// scene itself.
#include <algorithm>

#include "bench/image/clock.h"
#include "bench/image/embree_scene.h"
#include "bench/image/subject.h"
#include "bench/image/tracers.h"

namespace minkray::bench {
namespace {

class Triangles : public Tracer {
 public:
  Triangles(const Scene& scene, const Meshes& meshes, bool highest_quality, int threads)
      : top_(threads),
        quality_(highest_quality ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM) {
    std::vector<std::size_t> uses(meshes.meshes.size());
    for_each_instance(scene, [&](std::uint32_t shape, const Affine<double>&) { ++uses[shape]; });
    shared_ = std::any_of(uses.begin(), uses.end(), [](std::size_t count) { return count > 1; });
    if (shared_)
      for (const TriangleMesh& mesh : meshes.meshes) shapes_.push_back(scene_of(mesh));
    unsigned number = 0;
    for_each_instance(scene, [&](std::uint32_t shape, const Affine<double>& pose) {
      if (shared_)
        add_instance(shapes_[shape], pose, number++);
      else
        attach(mesh_geometry(meshes.meshes[shape], pose), top_.scene(), number++);
    });
    const Clock clock;
    if (!shared_) rtcSetSceneBuildQuality(top_.scene(), quality_);
    rtcCommitScene(top_.scene());
    hierarchy_seconds_ = clock.seconds_on(threads);
  }
  ~Triangles() override {
    for (const RTCScene scene : shapes_) rtcReleaseScene(scene);
  }

  std::vector<std::string> entries() const override { return embree_entries(); }
  std::unique_ptr<RayQueue> queue(std::size_t entry) const override {
    return embree_queue(top_.scene(), shared_ ? EmbreeNumber::instance : EmbreeNumber::geometry,
                        entry);
  }
  Vec3<float> world_normal(const FirstHit& hit) const override {
    if (!shared_) return hit.normal.normalized();
    const Mat3<float> rotation = linear_[hit.instance];
    return (rotation * hit.normal).normalized();
  }
  std::size_t bytes() const override { return top_.bytes(); }
  double hierarchy_seconds() const override { return hierarchy_seconds_; }

 private:
  static void attach(RTCGeometry geometry, RTCScene scene, unsigned number) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, number);
    rtcReleaseGeometry(geometry);
  }

  RTCGeometry mesh_geometry(const TriangleMesh& mesh, const Affine<double>& pose) const {
    RTCGeometry geometry = rtcNewGeometry(top_.device(), RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryBuildQuality(geometry, quality_);
    auto* to = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                           RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                           mesh.vertices.size()));
    for (const Vec3<float>& vertex : mesh.vertices) {
      const Vec3<float> placed = pose(vertex.cast<double>()).cast<float>();
      to = std::copy(placed.begin(), placed.end(), to);
    }
    auto* indices = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(unsigned), mesh.triangles.size()));
    for (const auto& triangle : mesh.triangles)
      indices = std::copy(triangle.begin(), triangle.end(), indices);
    return geometry;
  }

  RTCScene scene_of(const TriangleMesh& mesh) const {
    RTCScene scene = rtcNewScene(top_.device());
    rtcSetSceneBuildQuality(scene, quality_);
    attach(mesh_geometry(mesh, {}), scene, 0);
    rtcCommitScene(scene);
    return scene;
  }

  void add_instance(RTCScene shape, const Affine<double>& pose, unsigned number) {
    RTCGeometry geometry = rtcNewGeometry(top_.device(), RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(geometry, shape);
    std::array<float, 12> columns;
    for (int i = 0; i < 9; ++i)
      columns[static_cast<std::size_t>(i)] = static_cast<float>(pose.linear(i % 3, i / 3));
    for (int i = 0; i < 3; ++i)
      columns[static_cast<std::size_t>(9 + i)] = static_cast<float>(pose.translation[i]);
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns.data());
    attach(geometry, top_.scene(), number);
    linear_.push_back(pose.linear.cast<float>());
  }

  EmbreeScene top_;
  RTCBuildQuality quality_;
  bool shared_ = false;
  std::vector<RTCScene> shapes_;
  std::vector<Mat3<float>> linear_;  ///< of the instances; the benchmark's scenes only turn shapes
  double hierarchy_seconds_ = 0;
};

}  // namespace

std::unique_ptr<Tracer> embree_triangles(const Scene& scene, const Meshes& meshes,
                                         bool highest_quality, int threads) {
  return std::make_unique<Triangles>(scene, meshes, highest_quality, threads);
}

}  // namespace minkray::bench
