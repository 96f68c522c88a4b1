// SPDX-License-Identifier: MIT
// Embree: its triangles, its sphere and its round curve, one ray and eight rays at a time. Built at
// its highest quality, with its fastest (not its robust) intersection.
#include <embree3/rtcore.h>

#include <algorithm>
#include <array>

#include "bench/peers/others.h"

namespace minkray::bench {
namespace {

/// A device and a scene of one geometry.
struct Scene {
  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene scene = rtcNewScene(device);
  std::size_t triangles = 0;

  Scene() = default;
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
  ~Scene() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }

  template <class T>
  T* buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t size,
            std::size_t count) const {
    return static_cast<T*>(rtcSetNewGeometryBuffer(geometry, type, 0, format, size, count));
  }
  void commit(RTCGeometry geometry) const {
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    rtcCommitScene(scene);
  }
};

using ScenePointer = std::shared_ptr<Scene>;

Hit as_hit(bool met, float t, float x, float y, float z) {
  if (!met) return {};
  Hit hit = hit_at(static_cast<double>(t));
  hit.normal = Vec3<float>(x, y, z);
  return hit;
}

/// Shared by one and eight rays: the scene, and the coherence of the batch.
class EmbreePeer : public Peer {
 public:
  EmbreePeer(std::string name, ScenePointer scene)
      : Peer(std::move(name)), scene_(std::move(scene)) {}
  std::size_t triangles() const override { return scene_->triangles; }

 protected:
  void set_flags(const RayBatch& rays) {
    flags_ =
        rays.coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  }
  RTCIntersectContext context() const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = flags_;
    return context;
  }
  RTCScene scene() const { return scene_->scene; }

 private:
  ScenePointer scene_;
  RTCIntersectContextFlags flags_ = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
};

class OneRay : public EmbreePeer {
 public:
  using EmbreePeer::EmbreePeer;

  void prepare(const RayBatch& rays) override {
    set_flags(rays);
    queries_.assign(rays.size(), {});
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Ray<float>& ray = rays.in_float[i];
      RTCRayHit& query = queries_[i];
      query.ray.org_x = ray.origin.x();
      query.ray.org_y = ray.origin.y();
      query.ray.org_z = ray.origin.z();
      query.ray.dir_x = ray.direction.x();
      query.ray.dir_y = ray.direction.y();
      query.ray.dir_z = ray.direction.z();
      query.ray.tfar = ray.t_max;
      query.ray.mask = ~0u;
      query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    }
  }

  void cast() override {
    RTCIntersectContext asked = context();
    for (RTCRayHit& query : queries_) rtcIntersect1(scene(), &asked, &query);
  }

  void read(std::span<Hit> hits) const override {
    for (std::size_t i = 0; i < hits.size(); ++i) {
      const RTCRayHit& query = queries_[i];
      hits[i] = as_hit(query.hit.geomID != RTC_INVALID_GEOMETRY_ID, query.ray.tfar, query.hit.Ng_x,
                       query.hit.Ng_y, query.hit.Ng_z);
    }
  }

 private:
  std::vector<RTCRayHit> queries_;
};

class EightRays : public EmbreePeer {
 public:
  using EmbreePeer::EmbreePeer;

  void prepare(const RayBatch& rays) override {
    set_flags(rays);
    queries_.assign((rays.size() + 7) / 8, {});
    for (std::size_t i = 0; i < queries_.size() * 8; ++i) {
      RTCRayHit8& query = queries_[i / 8];
      const Ray<float>& ray = rays.in_float[std::min(i, rays.size() - 1)];
      const std::size_t lane = i % 8;
      query.ray.org_x[lane] = ray.origin.x();
      query.ray.org_y[lane] = ray.origin.y();
      query.ray.org_z[lane] = ray.origin.z();
      query.ray.dir_x[lane] = ray.direction.x();
      query.ray.dir_y[lane] = ray.direction.y();
      query.ray.dir_z[lane] = ray.direction.z();
      query.ray.tfar[lane] = ray.t_max;
      query.ray.mask[lane] = ~0u;
      query.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
      query.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
    }
  }

  void cast() override {
    RTCIntersectContext asked = context();
    alignas(32) constexpr std::array<int, 8> all = {-1, -1, -1, -1, -1, -1, -1, -1};
    for (RTCRayHit8& query : queries_) rtcIntersect8(all.data(), scene(), &asked, &query);
  }

  void read(std::span<Hit> hits) const override {
    for (std::size_t i = 0; i < hits.size(); ++i) {
      const RTCRayHit8& query = queries_[i / 8];
      const std::size_t lane = i % 8;
      hits[i] = as_hit(query.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID, query.ray.tfar[lane],
                       query.hit.Ng_x[lane], query.hit.Ng_y[lane], query.hit.Ng_z[lane]);
    }
  }

 private:
  std::vector<RTCRayHit8> queries_;
};

Peers one_and_eight(const std::string& label, const ScenePointer& scene) {
  Peers peers;
  peers.push_back(std::make_unique<OneRay>("embree-1-" + label + "/float", scene));
  peers.push_back(std::make_unique<EightRays>("embree-8-" + label + "/float", scene));
  return peers;
}

/// x, y, z and radius of each point.
ScenePointer round_scene(RTCGeometryType type, const std::vector<std::array<float, 4>>& points) {
  auto scene = std::make_shared<Scene>();
  RTCGeometry geometry = rtcNewGeometry(scene->device, type);
  auto* vertices = scene->buffer<float>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4,
                                        4 * sizeof(float), points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    std::copy(points[i].begin(), points[i].end(), vertices + 4 * i);
  if (points.size() > 1)
    *scene->buffer<unsigned>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, sizeof(unsigned),
                             1) = 0;
  scene->commit(geometry);
  return scene;
}

}  // namespace

Peers embree_triangles(const TriangleMesh& mesh, const std::string& label) {
  auto scene = std::make_shared<Scene>();
  scene->triangles = mesh.triangles.size();
  RTCGeometry geometry = rtcNewGeometry(scene->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = scene->buffer<float>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3,
                                        3 * sizeof(float), mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      vertices[3 * i + static_cast<std::size_t>(axis)] = mesh.vertices[i][axis];
  auto* indices = scene->buffer<unsigned>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3,
                                          3 * sizeof(unsigned), mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    std::copy(mesh.triangles[i].begin(), mesh.triangles[i].end(), indices + 3 * i);
  scene->commit(geometry);
  return one_and_eight("triangles-" + label, scene);
}

Peers embree_own(const Shape& shape) {
  const auto f = [](double x) { return static_cast<float>(x); };
  if (const auto* s = std::get_if<Sphere>(&shape.kind))
    return one_and_eight("sphere",
                         round_scene(RTC_GEOMETRY_TYPE_SPHERE_POINT, {{0, 0, 0, f(s->radius)}}));
  if (const auto* s = std::get_if<Capsule>(&shape.kind))
    return one_and_eight("round-curve", round_scene(RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE,
                                                    {{0, 0, f(-s->half_height), f(s->radius)},
                                                     {0, 0, f(s->half_height), f(s->radius)}}));
  if (const auto* s = std::get_if<TaperedCapsule>(&shape.kind))
    return one_and_eight("round-curve", round_scene(RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE,
                                                    {{0, 0, f(-s->half_height), f(s->radii[0])},
                                                     {0, 0, f(s->half_height), f(s->radii[1])}}));
  return {};
}

}  // namespace minkray::bench
