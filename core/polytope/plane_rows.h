// SPDX-License-Identifier: MIT
// Planes around a polytope, stored so that several are tested together, and the test of a line
// against all planes. Compiled once for each instruction set, without fused operations, so results
// are bit-identical.
#pragma once

#include <vector>

#include "core/query/line.h"

namespace minkray::exact {

/// The planes n.x = offset as rows of numbers, four planes per row: n.x, n.y, n.z, offset, depth.
/// The depth is the distance from the plane down to the lowest corner of its triangles.
class PlaneRows {
 public:
  static constexpr std::size_t planes_a_row = 4, numbers_a_plane = 5;

  /// Adds a plane. Unused items of the last row repeat the plane.
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

/// The plane whose half-space a line enters last, and the plane whose half-space it leaves first.
/// If several planes have equal parameters, the first of them.
struct PlaneScan {
  double in = 0, out = 0;  ///< the line's parameters there
  /// Latest entry and earliest exit if all planes are moved inwards by their depths and the line's
  /// E.
  double in_hi = 0, out_lo = 0;
  std::size_t entered = 0, left = 0;  ///< indices of the two planes
};

/// Tests the line against all planes.
void scan_planes_sse2(const PlaneRows& planes, const Line<double>& line, PlaneScan& found);
/// Same results, bit for bit. Requires AVX2 and FMA, but does not use FMA.
void scan_planes_avx2(const PlaneRows& planes, const Line<double>& line, PlaneScan& found);

}  // namespace minkray::exact
