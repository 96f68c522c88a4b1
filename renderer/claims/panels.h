// SPDX-License-Identifier: MIT
// Distance algorithm in the plane as a strip of pictures, one per iteration, after the figures of
// the textbook's section on distance in 2D.
#pragma once

#include <string>

#include "core/shape/shape.h"
#include "renderer/paper/distance.h"

namespace minkray {

/// The SVG file, from a real run: the obstacle C with the origin, the simplex S_k, its point V_k
/// closest to the origin, the support line through the new vertex W_k, and the vertices that are
/// discarded. `result` gets the answer.
std::string distance_panels_svg(const Shape& a, const Shape& b, SubalgorithmKind subalgorithm,
                                DistanceResult<double, 2>& result);

}  // namespace minkray
