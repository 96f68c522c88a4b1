// SPDX-License-Identifier: MIT
// The shapes that are measured.
#pragma once

#include <string>
#include <vector>

#include "core/shape/shape.h"

namespace minkray::bench {

struct Subject {
  std::string name;
  Shape<double> shape;
};

std::vector<Subject> subjects();

/// The same shape `scale` times as large.
Shape<double> scaled(const Shape<double>& shape, double scale);

}  // namespace minkray::bench
