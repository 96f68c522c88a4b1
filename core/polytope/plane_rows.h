// SPDX-License-Identifier: MIT
// Planes around a polytope in an order in which several are tested together, and a line between
// all of them. Compiled once for each instruction set, without fused operations: the same bits.
#pragma once

#include <vector>

#include "core/query/line.h"

namespace minkray::exact {

/// The planes n.x = offset as rows of numbers, four planes a row: n.x, n.y, n.z, the offset, and
/// how much further in the plane would have to be to hold no point of its triangles.
class PlaneRows {
 public:
  static constexpr std::size_t planes_a_row = 4, numbers_a_plane = 5;

  /// The last row is filled up with the last plane.
  void add(const Vec3<double>& normal, double offset, double depth);

  std::size_t size() const { return size_; }
  std::size_t rows() const { return numbers_.size() / (planes_a_row * numbers_a_plane); }
  const double* row(std::size_t i) const {
    return numbers_.data() + i * planes_a_row * numbers_a_plane;
  }

 private:
  std::vector<double> numbers_;
  std::size_t size_ = 0;
};

/// The plane that a line enters last, and the one it leaves first. Where several are equal, the
/// first.
struct PlaneScan {
  double in = 0, out = 0;
  /// The entry is no later, and the exit no earlier, at any plane moved in by its depth and E.
  double in_hi = 0, out_lo = 0;
  std::size_t entered = 0, left = 0;
};

void scan_planes_sse2(const PlaneRows& planes, const Line<double>& line, PlaneScan& found);
/// Only on machines that have AVX2 and FMA, which it does not use; the same bits.
void scan_planes_avx2(const PlaneRows& planes, const Line<double>& line, PlaneScan& found);

}  // namespace minkray::exact
