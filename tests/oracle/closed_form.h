// SPDX-License-Identifier: MIT
// Finds where a line enters and leaves a shape, in long double, by school geometry: quadratics,
// slabs and unions of them. Shares no code with the solvers, nor with the support mappings.
#pragma once

#include <optional>

#include "core/shape/shape.h"

namespace minkray::testing {

using Long = long double;

/// The parameters t with origin + t * direction in the shape; empty if lower > upper.
struct Interval {
  Long lower = std::numeric_limits<Long>::infinity();
  Long upper = -std::numeric_limits<Long>::infinity();

  bool empty() const { return !(lower <= upper); }
};

/// The whole line, t of any sign. The shape's numbers are taken as exact. Nothing for shapes that
/// have no closed form here: points and segments, which no line meets by chance, and those
/// operators that make new surfaces.
std::optional<Interval> line_in_shape(const Shape& shape, const Vec3<Long>& origin,
                                      const Vec3<Long>& direction);

}  // namespace minkray::testing
