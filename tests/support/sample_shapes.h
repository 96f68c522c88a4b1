// SPDX-License-Identifier: MIT
// The shapes that tests run over: every kind, with common, extreme and flat parameters; and random
// nestings of them.
#pragma once

#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include "core/shape/shape.h"

namespace minkray::testing {

struct SampleShape {
  std::string name;  ///< the kind's name, then what is special
  Shape shape;
};

/// Printed by GoogleTest instead of bytes.
inline void PrintTo(const SampleShape& sample, std::ostream* out) {
  *out << sample.name;
}

/// There is at least one of every kind.
std::vector<SampleShape> sample_shapes();

/// A shape of up to `depth` operators inside each other, of sizes near 1, solid or flat.
Shape random_nesting(std::uint64_t seed, int depth = 3);

/// The sample shapes, and random nestings of these seeds.
std::vector<SampleShape> sample_shapes_and_nestings(std::uint64_t first, std::uint64_t last);

/// Such as "rounded(minkowski_sum(box, hull))".
std::string name_of_nesting(const Shape& shape);

}  // namespace minkray::testing
