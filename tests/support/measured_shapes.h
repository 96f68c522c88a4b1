// SPDX-License-Identifier: MIT
// The shapes that benchmarks measure and millions of casts are tried on.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "core/shape/shape.h"

namespace minkray::testing {

struct MeasuredShape {
  std::string name;
  Shape shape;
  Shape same = shape;  ///< the same set of points, as a shape that the oracle has
};

/// Printed by GoogleTest instead of bytes.
inline void PrintTo(const MeasuredShape& measured, std::ostream* out) {
  *out << measured.name;
}

std::vector<MeasuredShape> measured_shapes();
/// Sums, differences and hulls of shapes that equal a simpler shape.
std::vector<MeasuredShape> derived_shapes();

/// Makes the shape `scale` times as large.
Shape scaled(const Shape& shape, double scale);

}  // namespace minkray::testing
