// SPDX-License-Identifier: MIT
// Sorts directions into the cells of a grid on the faces of a cube around the origin.
#pragma once

#include <cmath>
#include <cstddef>

#include "core/math/vec.h"

namespace minkray {

class CubeMap {
 public:
  struct Cell {
    int axis;            ///< axis of the face: that of the largest component
    double sign;         ///< sign of that component
    double u, v, width;  ///< other components / largest: [u, u + width], [v, v + width]
  };

  /// Makes about this many cells, but no more than float can count.
  explicit CubeMap(double about_cells)
      : resolution_(static_cast<std::size_t>(
            std::ceil(std::sqrt(std::min(std::max(about_cells, 1.0), most_cells) / 6)))) {}

  std::size_t cells() const { return 6 * resolution_ * resolution_; }

  Cell operator[](std::size_t cell) const {
    const std::size_t face = cell / (resolution_ * resolution_);
    const double width = 2 / static_cast<double>(resolution_);
    return {static_cast<int>(face / 2), face % 2 == 0 ? 1.0 : -1.0,
            -1 + width * static_cast<double>(cell / resolution_ % resolution_),
            -1 + width * static_cast<double>(cell % resolution_), width};
  }

  /// Returns the index (an integer) of the cell that contains the direction n, of any length. If n
  /// is within a few roundings of a cell's edge, the index may be that of the neighbouring cell.
  /// NaN gets any cell.
  template <class W>
  W cell_of(const Vec3<W>& n) const {
    using std::abs;
    using T = Lane<W>;
    const W x = abs(n.x()), y = abs(n.y()), z = abs(n.z());
    const Mask<W> along_x = (x >= y) & (x >= z), along_y = (!along_x) & (y >= z);
    const auto by_axis = [&](const W& if_x, const W& if_y, const W& if_z) {
      return select(along_x, if_x, select(along_y, if_y, if_z));
    };
    const W largest = by_axis(n.x(), n.y(), n.z()), size = abs(largest);
    const W side = W(static_cast<T>(resolution_)), last = side - W(1);
    const auto index = [&](const W& component) {
      W scaled = (component / size + W(1)) * (W(T(0.5)) * side);
      scaled = select(scaled > W(0), scaled, W(0));  // this order of operands turns NaN into 0
      return whole(select(scaled < last, scaled, last));
    };
    const W face = by_axis(W(0), W(2), W(4)) + select(largest < W(0), W(1), W(0));
    return (face * side + index(by_axis(n.y(), n.z(), n.x()))) * side +
           index(by_axis(n.z(), n.x(), n.y()));
  }

 private:
  static constexpr double most_cells = 0x1p23;
  std::size_t resolution_;
};

}  // namespace minkray
