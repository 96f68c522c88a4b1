// SPDX-License-Identifier: MIT
#include "renderer/plan/motion_page.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "core/derived/sandwich.h"
#include "renderer/import/model/mesh_hull.h"
#include "renderer/import/model/orientation.h"
#include "renderer/json/number_json.h"
#include "renderer/scene/scene_instances.h"

namespace minkray {
namespace {

/// Limit of moments in the page, which interpolates linearly between them.
constexpr std::size_t most_moments = 400;

/// Rounds coordinates to a tenth of a millimetre.
double rounded(double length) {
  return std::round(1e4 * length) / 1e4;
}

Json mesh_of(const Shape& shape, const Affine<double>& pose) {
  Json vertices = Json::array(), triangles = Json::array();
  try {
    SandwichOptions options;
    options.directions = 200;
    const Sandwich sandwich = sandwich_of(shape, options);
    // Represents shapes without a surface by their bounding box.
    const Mesh& mesh = sandwich.rank() >= 2 ? sandwich.inner : sandwich.outer;
    for (const Vec3<double>& vertex : mesh.vertices) {
      const Vec3<double> at = pose(sandwich.frame.from_frame(vertex));
      for (int axis = 0; axis < 3; ++axis) vertices.push_back(rounded(at[axis]));
    }
    for (const auto& corners : mesh.triangles)
      for (const std::uint32_t corner : corners) triangles.push_back(corner);
  } catch (const std::runtime_error&) {
    // Leaves the shape out of the page.
  }
  return {{"v", std::move(vertices)}, {"t", std::move(triangles)}};
}

/// Meshes of more triangles are represented by their hulls.
constexpr std::size_t most_triangles = 20'000;

Json mesh_of(const TriangleMesh& mesh, const Affine<double>& pose) {
  if (mesh.size() > most_triangles) return mesh_of(hull_of(mesh), pose);
  Json vertices = Json::array(), triangles = Json::array();
  for (const Vec3<double>& vertex : mesh.vertices()) {
    const Vec3<double> at = pose(vertex);
    for (int axis = 0; axis < 3; ++axis) vertices.push_back(rounded(at[axis]));
  }
  for (const Corners& corners : mesh.triangles())
    for (const std::uint32_t corner : corners) triangles.push_back(corner);
  return {{"v", std::move(vertices)}, {"t", std::move(triangles)}};
}

/// A large square that represents a half-space.
Json square_of(const Affine<double>& pose) {
  constexpr double half = 3;
  Json vertices = Json::array();
  for (const auto& [x, y] : {std::pair(-half, -half), {half, -half}, {half, half}, {-half, half}}) {
    const Vec3<double> at = pose(Vec3<double>(x, y, 0));
    for (int axis = 0; axis < 3; ++axis) vertices.push_back(rounded(at[axis]));
  }
  return {{"v", std::move(vertices)}, {"t", Json::array({0, 1, 2, 0, 2, 3})}};
}

/// Bodies in the order of the workcell.
Json bodies_json(const Workcell& cell) {
  Json bodies = Json::array();
  const std::vector<bool> chosen = chosen_geoms(cell.model, cell.geometry);
  for (std::size_t i = 0; i < cell.model.geoms.size(); ++i) {
    if (!chosen[i]) continue;
    const ModelGeom& geom = cell.model.geoms[i];
    Json body = geom.touches_as_half_space() ? square_of(geom.pose)
                : geom.mesh                  ? mesh_of(*geom.mesh, geom.pose)
                                             : mesh_of(*geom.shape, geom.pose);
    body["link"] = geom.link;
    bodies.push_back(std::move(body));
  }
  for (const Scene& scene : cell.scenes)
    for (std::size_t i = 0; i < instance_count(scene); ++i) {
      const Object object = instance_object(scene, i);
      Json body = object.half_space
                      ? square_of({rotation_of_z_to(object.half_space->posed(object.pose).normal),
                                   object.pose.translation})
                  : object.mesh ? mesh_of(*object.mesh, object.pose)
                                : mesh_of(object.shape, object.pose);
      body["link"] = -1;
      bodies.push_back(std::move(body));
    }
  return bodies;
}

/// All rows if they are few; between them as many moments per step as the limit allows.
std::vector<double> moments_of(const JointPath& path, double worst) {
  const std::size_t steps = path.times.size() - 1;
  const std::size_t parts = steps == 0 ? 1 : std::clamp<std::size_t>(most_moments / steps, 1, 60);
  const std::size_t stride = std::max<std::size_t>(1, steps / most_moments);
  std::vector<double> moments = {path.times.front(), path.times.back(), worst};
  for (std::size_t i = 0; i < steps; i += stride)
    for (std::size_t k = 0; k < parts; ++k) {
      const double s = static_cast<double>(k) / static_cast<double>(parts);
      moments.push_back(path.times[i] + s * (path.times[i + 1] - path.times[i]));
    }
  std::ranges::sort(moments);
  moments.erase(std::ranges::unique(moments).begin(), moments.end());
  return moments;
}

}  // namespace

std::string motion_page(const Workcell& cell, const JointPath& path, const ShownMotion& shown) {
  Json names = Json::array(), moments = Json::array(), poses = Json::array();
  for (const ClearanceBody& body : cell.bodies) names.push_back(printable(body.name));
  for (const double time : moments_of(path, shown.worst)) {
    moments.push_back(time);
    Json links = Json::array();
    for (const Affine<double>& pose : link_poses(path.posed_at(time))) {
      for (int axis = 0; axis < 3; ++axis) links.push_back(rounded(pose.translation[axis]));
      for (const double number : quaternion_of(pose.linear))
        links.push_back(std::round(1e5 * number) / 1e5);
    }
    poses.push_back(std::move(links));
  }
  const Json motion = {{"bodies", bodies_json(cell)},   {"names", std::move(names)},
                       {"times", std::move(moments)},   {"poses", std::move(poses)},
                       {"verdict", shown.verdict},      {"text", shown.text},
                       {"worst", shown.worst},          {"has_times", shown.has_times},
                       {"view", point_json(shown.view)}};
  std::string data = motion.dump();
  // Text must not end the enclosing script.
  for (std::size_t at = 0; (at = data.find('<', at)) != std::string::npos;)
    data.replace(at, 1, "\\u003c");
  std::string html = motion_page_html();
  constexpr std::string_view mark = "<!-- motion -->";
  return html.replace(html.find(mark), mark.size(), data);
}

}  // namespace minkray
