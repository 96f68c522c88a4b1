// SPDX-License-Identifier: MIT
#include "renderer/inspect/shape_mesh.h"

#include <cmath>
#include <stdexcept>

#include "core/derived/sandwich.h"

namespace minkray {
namespace {

/// Smooth enough to look at, few enough for a page that holds dozens of shapes.
constexpr int mesh_directions = 160;

/// Coordinates are rounded to this share of the largest: less than a pixel of any screen.
constexpr double steps_to_largest = 20000;

template <class Place>
Json json_of(const Mesh& mesh, double scale, const Place& place, bool is_mirrored) {
  Json vertices = Json::array(), triangles = Json::array();
  for (const Vec3<double>& vertex : mesh.vertices) {
    const Vec3<double> at = place(vertex) / scale;
    for (int axis = 0; axis < 3; ++axis)
      vertices.push_back(static_cast<std::int64_t>(std::lround(at[axis])));
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    triangles.push_back(a);
    triangles.push_back(is_mirrored ? c : b);
    triangles.push_back(is_mirrored ? b : c);
  }
  return {{"v", std::move(vertices)}, {"t", std::move(triangles)}};
}

template <class Place>
Json meshes(const Shape<double>& shape, double largest, const Place& place, bool is_mirrored) {
  SandwichOptions options;
  options.directions = mesh_directions;
  try {
    const Sandwich sandwich = sandwich_of(shape, options);
    const double scale = (largest > 0 ? largest : 1) / steps_to_largest;
    const auto in_shape = [&](const Vec3<double>& vertex) {
      return place(sandwich.frame.from_frame(vertex));
    };
    return {{"rank", sandwich.rank()},
            {"scale", scale},
            {"inner", json_of(sandwich.inner, scale, in_shape, is_mirrored)},
            {"outer", json_of(sandwich.outer, scale, in_shape, is_mirrored)}};
  } catch (const std::runtime_error&) {
    return {{"rank", -1}};  // the steps are shown without it
  }
}

}  // namespace

Json mesh_json(const Shape<double>& shape, const Ball<double>& ball) {
  return meshes(
      shape, ball.radius,
      [&](const Vec3<double>& point) -> Vec3<double> { return point - ball.centre; }, false);
}

Json mirrored_mesh_json(const Shape<double>& shape, const Ball<double>& ball,
                        const Vec3<double>& from) {
  return meshes(
      shape, ball.radius + (from - ball.centre).norm(),
      [&](const Vec3<double>& point) -> Vec3<double> { return from - point; }, true);
}

}  // namespace minkray
