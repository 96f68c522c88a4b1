// SPDX-License-Identifier: MIT
// A triangle mesh of a rounded polytope as one would build it by hand: the facets moved outwards,
// a strip of rectangles along each edge, and a patch of the sphere at each corner. The mesh has
// far fewer triangles than a grid of directions, which ignores edges.
#pragma once

#include <optional>

#include "bench/tessellate.h"

namespace minkray::bench {

/// Closed, within the shape, no point of it deeper below the surface than `error` (a length);
/// nothing for other shapes than rounded solid polytopes.
std::optional<TriangleMesh> rounded_mesh(const Shape& shape, double error);

}  // namespace minkray::bench
