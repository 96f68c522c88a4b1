// SPDX-License-Identifier: MIT
#include "renderer/compare/embree_mesh.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <stdexcept>

namespace minkray {
namespace {

constexpr double gamma(int k) {
  const double u = std::numeric_limits<float>::epsilon() / 2;
  return k * u / (1 - k * u);
}

template <class Element>
void copy_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format,
                 const std::vector<Element>& elements) {
  auto* buffer = static_cast<Element*>(
      rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(Element), elements.size()));
  std::copy(elements.begin(), elements.end(), buffer);
}

}  // namespace

struct EmbreeMesh::Scene {
  // One thread and no Embree workers: callers bring their own threads.
  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene scene = nullptr;

  Scene() {
    if (!device) throw std::runtime_error("Embree: no device");
    scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  }
  ~Scene() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
};

EmbreeMesh::EmbreeMesh(const Mesh& mesh)
    : scene_(std::make_unique<Scene>()), triangles_(mesh.triangles) {
  for (const Vec3<double>& vertex : mesh.vertices) vertices_.push_back(vertex.cast<float>());
  if (!triangles_.empty()) {
    RTCGeometry geometry = rtcNewGeometry(scene_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    copy_buffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, vertices_);
    copy_buffer(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, triangles_);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_->scene, geometry);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(scene_->scene);
  if (rtcGetDeviceError(scene_->device) != RTC_ERROR_NONE)
    throw std::runtime_error("Embree: the mesh was refused");
}

EmbreeMesh::~EmbreeMesh() = default;
EmbreeMesh::EmbreeMesh(EmbreeMesh&&) noexcept = default;
EmbreeMesh& EmbreeMesh::operator=(EmbreeMesh&&) noexcept = default;

std::array<Vec3<double>, 3> EmbreeMesh::corners(unsigned triangle) const {
  const auto& [a, b, c] = triangles_[triangle];
  return {vertices_[a].cast<double>(), vertices_[b].cast<double>(), vertices_[c].cast<double>()};
}

std::optional<MeshHit> EmbreeMesh::cast(const Ray<float>& ray) const {
  RTCRayHit query = {};
  query.ray.org_x = ray.origin.x();
  query.ray.org_y = ray.origin.y();
  query.ray.org_z = ray.origin.z();
  query.ray.dir_x = ray.direction.x();
  query.ray.dir_y = ray.direction.y();
  query.ray.dir_z = ray.direction.z();
  query.ray.tfar = ray.t_max;
  query.ray.mask = ~0u;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;

  const auto [a, b, c] = corners(query.hit.primID);
  const Vec3<double> origin = ray.origin.cast<double>(), direction = ray.direction.cast<double>();
  const Vec3<double> normal = (b - a).cross(c - a);
  const double distance = std::max({(a - origin).norm(), (b - origin).norm(), (c - origin).norm()});
  const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
  const double area = normal.norm();
  const double across = gamma(12) * (distance + longest * longest * longest / area);
  return MeshHit{query.ray.tfar, across * area / std::abs(normal.dot(direction)), query.hit.primID};
}

std::optional<double> EmbreeMesh::nearest(const Ray<float>& ray) const {
  std::optional<double> first;
  const Vec3<double> origin = ray.origin.cast<double>(), direction = ray.direction.cast<double>();
  for (unsigned triangle = 0; triangle < triangles_.size(); ++triangle) {
    auto [a, b, c] = corners(triangle);
    a -= origin, b -= origin, c -= origin;
    const double ab = direction.dot(a.cross(b)), bc = direction.dot(b.cross(c)),
                 ca = direction.dot(c.cross(a));
    const bool through = (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
    const Vec3<double> normal = (b - a).cross(c - a);
    const double t = normal.dot(a) / normal.dot(direction);
    if (through && t >= 0 && t <= static_cast<double>(ray.t_max) && (!first || t < *first))
      first = t;
  }
  return first;
}

}  // namespace minkray
