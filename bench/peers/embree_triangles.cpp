// SPDX-License-Identifier: MIT
#include "bench/peers/embree_triangles.h"

#include <embree3/rtcore.h>

#include <numbers>
#include <stdexcept>
#include <vector>

#include "core/shape/convex_hull.h"

namespace minkray::bench {

struct EmbreeTriangles::Scene {
  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene scene = rtcNewScene(device);
  std::size_t triangles = 0;

  ~Scene() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
};

EmbreeTriangles::EmbreeTriangles(const Shape<double>& shape, int longitudes)
    : scene_(std::make_unique<Scene>()) {
  // By longitude and latitude about the z axis, as one would tessellate the shapes by hand: rims
  // come out as regular polygons, without slivers.
  std::vector<Vec3<double>> points;
  for (int i = 0; i < longitudes; ++i) {
    for (int j = 0; j < longitudes / 2; ++j) {
      const double phi = 2 * std::numbers::pi * (i + 0.5) / longitudes;
      const double theta = 2 * std::numbers::pi * (j + 0.5) / longitudes;
      points.push_back(shape.support(Vec3<double>(
          std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta))));
    }
  }
  const ConvexHull hull = convex_hull(points);
  if (hull.rank() != 3) throw std::runtime_error("a flat shape has no closed mesh");

  std::vector<std::array<unsigned, 3>> triangles;
  for (std::size_t f = 0; f < hull.facets.size(); ++f) {
    const auto corners = hull.facets[f];
    for (std::size_t i = 2; i < corners.size(); ++i)
      triangles.push_back({corners[0], corners[i - 1], corners[i]});
  }
  scene_->triangles = triangles.size();

  RTCGeometry geometry = rtcNewGeometry(scene_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                               hull.vertices.size()));
  for (std::size_t i = 0; i < hull.vertices.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      vertices[3 * i + static_cast<std::size_t>(axis)] =
          static_cast<float>(points[hull.vertices[i]][axis]);
  auto* indices = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(unsigned), triangles.size()));
  for (std::size_t i = 0; i < triangles.size(); ++i)
    std::copy(triangles[i].begin(), triangles[i].end(), indices + 3 * i);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcSetSceneFlags(scene_->scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene_->scene, RTC_BUILD_QUALITY_HIGH);
  rtcCommitScene(scene_->scene);
}

EmbreeTriangles::~EmbreeTriangles() = default;

std::size_t EmbreeTriangles::triangles() const {
  return scene_->triangles;
}

float EmbreeTriangles::entry(const Ray<float>& ray) const {
  RTCRayHit query = {};
  query.ray.org_x = ray.origin.x();
  query.ray.org_y = ray.origin.y();
  query.ray.org_z = ray.origin.z();
  query.ray.dir_x = ray.direction.x();
  query.ray.dir_y = ray.direction.y();
  query.ray.dir_z = ray.direction.z();
  query.ray.tfar = std::numeric_limits<float>::infinity();
  query.ray.mask = ~0u;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene_->scene, &context, &query);
  return query.hit.geomID == RTC_INVALID_GEOMETRY_ID ? std::numeric_limits<float>::infinity()
                                                     : query.ray.tfar;
}

}  // namespace minkray::bench
