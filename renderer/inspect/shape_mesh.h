// SPDX-License-Identifier: MIT
// Inner and outer mesh of a shape for the page, made of support points alone
// (core/derived/sandwich.h).
#pragma once

#include "core/math/bounds.h"
#include "core/shape/shape.h"
#include "renderer/json/json.h"

namespace minkray {

/// Directions for a mesh: smooth enough for a view; few enough for a page of hundreds of shapes.
inline constexpr int fine_mesh = 160, coarse_mesh = 60;

/// Coordinates are rounded to this share of the largest: less than a pixel, unless magnified.
inline constexpr double mesh_steps = 5000;

/// {"rank", "scale", "inner": {"v": [x, y, z, ...], "t": [corners, ...]}, "outer"}: coordinates
/// from the ball's centre, as whole numbers to be multiplied by the scale. Shapes that Qhull fails
/// at have no meshes; shapes of rank 1 and 0 have no inner one.
Json mesh_json(const Shape& shape, const Ball<double>& ball, int directions);

}  // namespace minkray
