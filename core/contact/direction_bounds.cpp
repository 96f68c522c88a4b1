// SPDX-License-Identifier: MIT
#include "core/contact/direction_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/math/affine.h"

namespace minkray {
namespace {

/// Relative to the sizes, support points and products with them are rounded by no more.
constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();

/// A direction and its support point.
struct Sample {
  Vec3<double> n = Vec3<double>::Zero(), c = Vec3<double>::Zero();
};

/// Directions between three, and support points that bound g there: those of the corners, and of
/// directions where the bound was largest.
struct Cell {
  Cell() { points.fill(Vec3<double>::Zero()); }

  static constexpr int most_points = 8;
  std::array<Sample, 3> corners;  ///< counter-clockwise from outside
  std::array<Vec3<double>, most_points> points;
  int count = 0;
  double bound = std::numeric_limits<double>::infinity();

  bool is_below(const Cell& other) const { return bound < other.bound; }
  double longest_side() const {
    double squared = 0;
    for (std::size_t i = 0; i < 3; ++i)
      squared = std::max(squared, (corners[(i + 1) % 3].n - corners[i].n).squaredNorm());
    return std::sqrt(squared);
  }
  void add_point(const Vec3<double>& c) {
    for (int i = 0; i < count; ++i)
      if (points[static_cast<std::size_t>(i)] == c) return;
    points[static_cast<std::size_t>(count++)] = c;
  }
};

/// The largest u(n) over a cell, by its candidates, and where it is.
class CellBound {
 public:
  CellBound(const Cell& cell, double size) : cell_(cell), size_(size) {
    for (const Sample& sample : cell.corners) try_direction(sample.n, u(sample.n));
    for (int i = 0; i < cell.count; ++i)
      for (int j = i + 1; j < cell.count; ++j) {
        try_pair(point(i), point(j));
        for (int k = j + 1; k < cell.count; ++k) try_triple(point(i), point(j), point(k));
      }
  }

  const Vec3<double>& direction() const { return direction_; }

  double value() const {
    const double allowed = highest_ + rounding * size_;
    // On the flat triangle, which is nearer to the origin than the sphere, u is concave: no larger
    // than at the candidates. There and on the sphere it differs by factors between these two.
    const auto& corners = cell_.corners;
    const Vec3<double> normal = (corners[1].n - corners[0].n).cross(corners[2].n - corners[0].n);
    const double nearest = std::abs(normal.dot(corners[0].n)) / normal.norm();
    return allowed > 0 ? allowed / nearest : allowed * nearest;
  }

 private:
  const Vec3<double>& point(int i) const { return cell_.points[static_cast<std::size_t>(i)]; }

  double u(const Vec3<double>& n) const {
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < cell_.count; ++i) least = std::min(least, n.dot(point(i)));
    return least;
  }

  void try_direction(const Vec3<double>& n, double value) {
    if (!(value > highest_)) return;
    highest_ = value;
    direction_ = n;
  }

  /// Where n.p = n.q on the cell's sides.
  void try_pair(const Vec3<double>& p, const Vec3<double>& q) {
    for (std::size_t side = 0; side < 3; ++side) {
      const Vec3<double>&from = cell_.corners[side].n, &to = cell_.corners[(side + 1) % 3].n;
      const double at_from = from.dot(p - q), at_to = to.dot(p - q);
      if ((at_from < 0) == (at_to < 0)) continue;
      const double t = at_from / (at_from - at_to);
      const Vec3<double> n = (from + t * (to - from)).normalized();
      try_direction(n, u(n));
    }
  }

  /// Where n.p = n.q = n.r, if that is in the cell or just beside it. Of points in a line the one
  /// between the others bounds nothing. Of slivers rounding turns n much: it matters where the foot
  /// of their plane is in the triangle (elsewhere u is larger at another candidate), and that is no
  /// further along n than the furthest of the three, nor is the plane but for the square of the
  /// turn.
  void try_triple(const Vec3<double>& p, const Vec3<double>& q, const Vec3<double>& r) {
    constexpr double in_line = 1e-12, beside = 1e-3;
    // A cross product is rounded by so much of its factors' lengths.
    constexpr double in_rounding = 8 * std::numeric_limits<double>::epsilon();
    const Vec3<double> e1 = q - p, e2 = r - p;
    Vec3<double> n = e1.cross(e2);
    const double length = n.norm();
    if (!(length > in_line * e1.norm() * e2.norm())) return;
    const auto& corners = cell_.corners;
    n *= (n.dot(corners[0].n + corners[1].n + corners[2].n) < 0 ? -1 : 1) / length;
    for (std::size_t side = 0; side < 3; ++side) {
      const Vec3<double> inward = corners[side].n.cross(corners[(side + 1) % 3].n);
      if (n.dot(inward) < -beside * inward.squaredNorm()) return;
    }
    const double at_p = n.dot(p), at_q = n.dot(q), at_r = n.dot(r);
    const double turn = in_rounding * e1.norm() * e2.norm() / length;
    const double value = u(n) + (std::max({at_p, at_q, at_r}) - std::min({at_p, at_q, at_r}));
    try_direction(n, value + std::abs(value) * turn * turn);
  }

  const Cell& cell_;
  double size_;
  double highest_ = -std::numeric_limits<double>::infinity();
  Vec3<double> direction_ = Vec3<double>::Zero();
};

class Search {
 public:
  Search(const CorePair& pair, const CoreDistance& known, const DirectionSearch& search)
      : pair_(pair), search_(search), best_(known) {
    size_ = pair.size() + pair.x.norm();
    best_.upper = std::numeric_limits<double>::infinity();
    best_.status = CoreStatus::unsettled;
  }

  CoreDistance run() {
    // Askew: the directions that matter are often along the axes of a shape, and a cell with one of
    // them at its corner would have to be cut for ever.
    const Mat3<double> start = rotation_matrix(0.31, 0.47, 0.59, 0.58);
    for (int octant = 0; octant < 8; ++octant) {
      const auto corner = [&](int axis) {
        return sample(start.col(axis) * ((octant >> axis & 1) != 0 ? -1.0 : 1.0));
      };
      const bool is_mirrored = ((octant ^ octant >> 1 ^ octant >> 2) & 1) != 0;
      Cell cell;
      cell.corners = {corner(0), corner(is_mirrored ? 2 : 1), corner(is_mirrored ? 1 : 2)};
      add(cell);
    }
    double settled = -std::numeric_limits<double>::infinity();
    bool is_signed = false;
    while (!cells_.empty()) {
      const Cell top = cells_.front();
      best_.upper = std::max(top.bound, settled);
      is_signed = search_.only_sign && (best_.upper < 0 || best_.lower > 0);
      if (is_near(top.bound) || is_signed || !may_ask()) break;
      std::pop_heap(cells_.begin(), cells_.end(), later);
      cells_.pop_back();
      if (!split(top)) settled = std::max(settled, top.bound);
      if (cells_.empty()) best_.upper = settled;
    }
    best_.is_exhausted = !is_signed && !is_near(best_.upper);
    if (best_.lower > 0) best_.status = CoreStatus::separated;
    if (best_.upper < 0) best_.status = CoreStatus::overlapping;
    return best_;
  }

 private:
  bool is_near(double bound) const { return bound - best_.lower <= search_.gap * size_; }
  bool may_ask() const { return best_.supports < search_.max_supports; }

  static bool later(const Cell& a, const Cell& b) { return a.is_below(b); }

  Sample sample(const Vec3<double>& n) {
    ++best_.supports;
    const Sample found{n, nearest_along(pair_, n).c};
    best_.raise_lower(n.dot(found.c), n);
    return found;
  }

  void add(Cell cell) {
    for (const Sample& corner : cell.corners) cell.add_point(corner.c);
    for (;;) {
      const CellBound bound(cell, size_);
      cell.bound = std::min(cell.bound, bound.value());
      if (is_near(cell.bound) || !may_ask()) break;
      // Large cells are cut before they are looked at more closely.
      constexpr double large = 0.5;
      const int most = cell.longest_side() > large ? 4 : Cell::most_points;
      if (cell.count >= most) break;
      const int before = cell.count;
      cell.add_point(sample(bound.direction()).c);
      if (cell.count == before) break;
    }
    cells_.push_back(cell);
    std::push_heap(cells_.begin(), cells_.end(), later);
  }

  /// Halves the longest side. Not of cells that are too small for their corners' digits.
  bool split(const Cell& cell) {
    constexpr double smallest = 1e-7;
    if (cell.longest_side() < smallest) return false;
    std::size_t longest = 0;
    double length = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double side = (cell.corners[(i + 1) % 3].n - cell.corners[i].n).squaredNorm();
      if (side > length) {
        length = side;
        longest = i;
      }
    }
    const Sample &from = cell.corners[longest], &to = cell.corners[(longest + 1) % 3],
                 &opposite = cell.corners[(longest + 2) % 3];
    const Sample middle = sample((from.n + to.n).normalized());
    Cell half;
    half.bound = cell.bound;
    // The points that were found last are nearest to where the bound is largest.
    for (int i = cell.count - 1; i >= std::max(3, cell.count - 2); --i)
      half.add_point(cell.points[static_cast<std::size_t>(i)]);
    half.corners = {from, middle, opposite};
    add(half);
    half.corners = {middle, to, opposite};
    add(half);
    return true;
  }

  const CorePair& pair_;
  const DirectionSearch& search_;
  double size_;
  CoreDistance best_;
  std::vector<Cell> cells_;
};

}  // namespace

CoreDistance bound_by_directions(const CorePair& pair, const CoreDistance& known,
                                 const DirectionSearch& search) {
  return Search(pair, known, search).run();
}

}  // namespace minkray
