// SPDX-License-Identifier: MIT
#include "core/polytope/plane_rows.h"

#include <algorithm>

namespace minkray::exact {

void PlaneRows::add(const Vec3<double>& normal, double offset, double depth) {
  const std::size_t place = size_ % planes_a_row;
  if (place == 0) numbers_.resize(numbers_.size() + planes_a_row * numbers_a_plane);
  double* const row = &numbers_[size_ / planes_a_row * planes_a_row * numbers_a_plane];
  // Also fills the rest of the row, in case no further plane follows.
  for (std::size_t i = place; i < planes_a_row; ++i) {
    for (std::size_t k = 0; k < 3; ++k) row[k * planes_a_row + i] = normal[static_cast<int>(k)];
    row[3 * planes_a_row + i] = offset;
    row[4 * planes_a_row + i] = depth;
  }
  ++size_;
}

}  // namespace minkray::exact
