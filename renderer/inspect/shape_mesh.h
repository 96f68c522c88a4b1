// SPDX-License-Identifier: MIT
// A shape's two meshes for the page: one within the shape and one around it, made of support points
// alone (core/derived/sandwich.h).
#pragma once

#include "core/math/bounds.h"
#include "core/shape/shape.h"
#include "renderer/json/json.h"

namespace minkray {

/// {"rank", "scale", "inner": {"v": [x, y, z, ...], "t": [corners, ...]}, "outer"}: coordinates
/// from the ball's centre, as whole numbers to be multiplied by the scale. What Qhull fails at has
/// no meshes; shapes of rank 1 and 0 have no inner one.
Json mesh_json(const Shape<double>& shape, const Ball<double>& ball);

/// The shape's points x become `from` - x: C of a distance query.
Json mirrored_mesh_json(const Shape<double>& shape, const Ball<double>& ball,
                        const Vec3<double>& from);

}  // namespace minkray
