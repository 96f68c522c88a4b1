// SPDX-License-Identifier: MIT
// Represents a Minkowski sum or difference of two operands by their cores. A ray at such a shape is
// the motion of one operand towards the other.
#pragma once

#include <optional>

#include "core/derived/core_and_radius.h"

namespace minkray {

/// The shape is the set of all a + b with a in A and b in B. A difference A - B is the sum of A and
/// the mirrored B.
struct SumOfCores {
  CoreAndRadius a, b;
  Vec3<double> middle = Vec3<double>::Zero();  ///< sum of the middles, in the shape's frame
  double loss = 0;                             ///< error bound of the operands' positions
};

/// Finds the two operands of a shape. Points and balls move and grow the others; without another
/// operand, B is a point or ball. Roundings and maps are applied to the operands. Returns nothing
/// for shapes of other kinds, for more operands, and if an operand has a core of the kind `other`.
std::optional<SumOfCores> sum_of_cores(const Shape& shape);

}  // namespace minkray
