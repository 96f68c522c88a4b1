// SPDX-License-Identifier: MIT
#include "renderer/inspect/shape_mesh.h"

#include <cmath>
#include <stdexcept>

#include "core/derived/sandwich.h"

namespace minkray {
namespace {

template <class Place>
Json json_of(const Mesh& mesh, double scale, const Place& place) {
  Json vertices = Json::array(), triangles = Json::array();
  for (const Vec3<double>& vertex : mesh.vertices) {
    const Vec3<double> at = place(vertex) / scale;
    for (int axis = 0; axis < 3; ++axis)
      vertices.push_back(static_cast<std::int64_t>(std::lround(at[axis])));
  }
  for (const auto& corners : mesh.triangles)
    for (const std::uint32_t corner : corners) triangles.push_back(corner);
  return {{"v", std::move(vertices)}, {"t", std::move(triangles)}};
}

}  // namespace

Json mesh_json(const Shape& shape, const Ball<double>& ball, int directions) {
  SandwichOptions options;
  options.directions = directions;
  try {
    const Sandwich sandwich = sandwich_of(shape, options);
    const double scale = (ball.radius > 0 ? ball.radius : 1) / mesh_steps;
    const auto from_centre = [&](const Vec3<double>& vertex) -> Vec3<double> {
      return sandwich.frame.from_frame(vertex) - ball.centre;
    };
    return {{"rank", sandwich.rank()},
            {"scale", scale},
            {"inner", json_of(sandwich.inner, scale, from_centre)},
            {"outer", json_of(sandwich.outer, scale, from_centre)}};
  } catch (const std::runtime_error&) {
    return {{"rank", -1}};  // the steps are shown without it
  }
}

}  // namespace minkray
