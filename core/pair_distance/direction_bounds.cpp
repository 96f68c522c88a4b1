// SPDX-License-Identifier: MIT
#include "core/pair_distance/direction_bounds.h"

#include <algorithm>
#include <vector>

#include "core/math/affine.h"
#include "core/pair_distance/direction_cell.h"

namespace minkray {
namespace {

class Search {
 public:
  Search(const CorePair& pair, const CoreDistance& known, const DirectionSearch& search)
      : pair_(pair), search_(search), best_(known) {
    size_ = pair.size() + pair.x.norm();
    best_.upper = std::numeric_limits<double>::infinity();
    best_.status = CoreStatus::unsettled;
  }

  CoreDistance run() {
    // Rotates the first cells. The directions that matter are often axes of a shape, and cells with
    // such a direction at a corner would be halved again and again.
    const Mat3<double> start = rotation_matrix(0.31, 0.47, 0.59, 0.58);
    for (int octant = 0; octant < 8; ++octant) {
      const auto corner = [&](int axis) {
        return sample(start.col(axis) * ((octant >> axis & 1) != 0 ? -1.0 : 1.0));
      };
      const bool is_mirrored = ((octant ^ octant >> 1 ^ octant >> 2) & 1) != 0;
      DirectionCell cell;
      cell.corners = {corner(0), corner(is_mirrored ? 2 : 1), corner(is_mirrored ? 1 : 2)};
      add(cell);
    }
    double settled = -std::numeric_limits<double>::infinity();
    bool is_signed = false;
    while (!order_.empty()) {
      const Entry top = order_.front();
      best_.upper = std::max(top.bound, settled);
      is_signed = search_.only_sign && (best_.upper < 0 || best_.lower > 0);
      if (is_near(top.bound) || is_signed || !may_ask()) break;
      std::pop_heap(order_.begin(), order_.end());
      order_.pop_back();
      if (!split(top.cell)) settled = std::max(settled, top.bound);
      if (order_.empty()) best_.upper = settled;
    }
    best_.is_exhausted = !is_signed && !is_near(best_.upper);
    if (best_.lower > 0) best_.status = CoreStatus::separated;
    if (best_.upper < 0) best_.status = CoreStatus::overlapping;
    return best_;
  }

 private:
  bool is_near(double bound) const { return bound - best_.lower <= search_.gap * size_; }
  bool may_ask() const { return best_.supports < search_.max_supports; }

  DirectionSample sample(const Vec3<double>& n) {
    ++best_.supports;
    const Vec3<double> c = nearest_along(pair_, n).c;
    best_.raise_lower(n.dot(c), n);
    return {PlainVector(n), PlainVector(c)};
  }

  void add(DirectionCell& cell) {
    for (const DirectionSample& corner : cell.corners) cell.add_point(corner.c);
    // Halves large cells before more points are added.
    constexpr double large = 0.5;
    const int most = cell.length() > large ? 4 : DirectionCell::most_points;
    DirectionCellBound bound(cell, size_);
    for (;;) {
      cell.bound = std::min(cell.bound, bound.value());
      if (is_near(cell.bound) || !may_ask() || cell.count >= most) break;
      if (!cell.add_point(sample(bound.direction().vector()).c)) break;
      bound.take_points();
    }
    order_.push_back({cell.bound, cells_.size()});
    std::push_heap(order_.begin(), order_.end());
    cells_.push_back(cell);
  }

  /// Halves the longest side. Returns false if the cell is too small for the digits of its corners.
  bool split(std::size_t index) {
    constexpr double smallest = 1e-7;
    const DirectionCell cell = cells_[index];
    if (cell.length() < smallest) return false;
    const auto longest = static_cast<std::size_t>(cell.longest_side());
    const DirectionSample &from = cell.corners[longest], &to = cell.corners[(longest + 1) % 3],
                          &opposite = cell.corners[(longest + 2) % 3];
    const DirectionSample middle = sample((from.n + to.n).vector().normalized());
    for (const bool is_first : {true, false}) {
      DirectionCell half;
      half.bound = cell.bound;
      // The last points are closest to the direction with the largest bound.
      for (int i = cell.count - 1; i >= std::max(3, cell.count - 2); --i)
        half.add_point(cell.point(i));
      if (is_first)
        half.corners = {from, middle, opposite};
      else
        half.corners = {middle, to, opposite};
      add(half);
    }
    return true;
  }

  /// A cell in the heap; the cell with the largest bound is on top.
  struct Entry {
    double bound;
    std::size_t cell;
    bool operator<(const Entry& other) const { return bound < other.bound; }
  };

  const CorePair& pair_;
  const DirectionSearch& search_;
  double size_;
  CoreDistance best_;
  std::vector<DirectionCell> cells_;
  std::vector<Entry> order_;
};

}  // namespace

CoreDistance bound_by_directions(const CorePair& pair, const CoreDistance& known,
                                 const DirectionSearch& search) {
  return Search(pair, known, search).run();
}

}  // namespace minkray
