// SPDX-License-Identifier: MIT
// A cell: a triangle of directions, the support points that bound g(n) = min n.c in it, and the
// bound (direction_bounds.h). Branch and bound makes tens of thousands of cells. Cells are
// therefore plain numbers, and a new point only adds its own candidates.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/math/vec.h"

namespace minkray {

/// Rounding error bound of support points and of products with them, relative to the sizes.
inline constexpr double direction_rounding = 16 * std::numeric_limits<double>::epsilon();

struct PlainVector {
  double x = 0, y = 0, z = 0;

  PlainVector() = default;
  PlainVector(double of_x, double of_y, double of_z) : x(of_x), y(of_y), z(of_z) {}
  explicit PlainVector(const Vec3<double>& v) : x(v.x()), y(v.y()), z(v.z()) {}

  Vec3<double> vector() const { return {x, y, z}; }
  [[gnu::always_inline]] double dot(const PlainVector& v) const {
    return x * v.x + y * v.y + z * v.z;
  }
  [[gnu::always_inline]] PlainVector cross(const PlainVector& v) const {
    return {y * v.z - z * v.y, z * v.x - x * v.z, x * v.y - y * v.x};
  }
  [[gnu::always_inline]] PlainVector operator-(const PlainVector& v) const {
    return {x - v.x, y - v.y, z - v.z};
  }
  [[gnu::always_inline]] PlainVector operator+(const PlainVector& v) const {
    return {x + v.x, y + v.y, z + v.z};
  }
  [[gnu::always_inline]] PlainVector operator*(double k) const { return {k * x, k * y, k * z}; }
  bool operator==(const PlainVector&) const = default;
  double norm() const { return std::sqrt(dot(*this)); }
};

/// A direction and its support point.
struct DirectionSample {
  PlainVector n, c;
};

/// All directions between three corners, and the support points that bound g there: those in the
/// directions of the corners, and in directions where the bound was largest.
struct DirectionCell {
  static constexpr int most_points = 8;
  std::array<DirectionSample, 3> corners;  ///< counter-clockwise from outside
  std::array<PlainVector, most_points> points;
  int count = 0;
  double bound = std::numeric_limits<double>::infinity();

  const PlainVector& corner(int k) const { return corners[static_cast<std::size_t>(k % 3)].n; }
  const PlainVector& point(int i) const { return points[static_cast<std::size_t>(i)]; }
  double squared_side(int k) const {
    const PlainVector side = corner(k + 1) - corner(k);
    return side.dot(side);
  }
  int longest_side() const {
    int longest = 0;
    for (int k = 1; k < 3; ++k)
      if (squared_side(k) > squared_side(longest)) longest = k;
    return longest;
  }
  double length() const { return std::sqrt(squared_side(longest_side())); }
  /// Adds a point. Returns true if the cell did not have the point yet.
  bool add_point(const PlainVector& c) {
    for (int i = 0; i < count; ++i)
      if (point(i) == c) return false;
    points[static_cast<std::size_t>(count++)] = c;
    return true;
  }
};

/// Finds the maximum over a cell of u(n) = min n.c (c: the cell's points), and its direction, by
/// testing candidates.
class DirectionCellBound {
 public:
  DirectionCellBound(const DirectionCell& cell, double size) : cell_(cell), size_(size) {
    for (int k = 0; k < 3; ++k) {
      inward_[at(k)] = cell.corner(k).cross(cell.corner(k + 1));
      squared_inward_[at(k)] = inward_[at(k)].dot(inward_[at(k)]);
      add(cell.corner(k), 0, 0);
    }
    middle_ = cell.corner(0) + cell.corner(1) + cell.corner(2);
    take_points();
  }

  /// Takes into account the points that were added to the cell since the last call.
  void take_points() {
    for (; taken_ < cell_.count; ++taken_) {
      const PlainVector& p = cell_.point(taken_);
      for (int i = 0; i < count_; ++i) {
        Candidate& candidate = candidates_[at(i)];
        candidate.u = std::min(candidate.u, candidate.n.dot(p));
      }
      for (int i = 0; i < taken_; ++i) {
        add_pair(cell_.point(i), p);
        for (int j = i + 1; j < taken_; ++j) add_triple(cell_.point(i), cell_.point(j), p);
      }
    }
    highest_ = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < count_; ++i) {
      const Candidate& candidate = candidates_[at(i)];
      const double value = candidate.value();
      if (!(value > highest_)) continue;
      highest_ = value;
      direction_ = candidate.n;
    }
  }

  const PlainVector& direction() const { return direction_; }

  double value() const {
    const double allowed = highest_ + direction_rounding * size_;
    // On the flat triangle, which is nearer to the origin than the sphere, u is concave, so u is
    // largest at a candidate. From a point of the triangle to the sphere, u changes by a factor of
    // 1 to 1 / nearest.
    const PlainVector normal =
        (cell_.corner(1) - cell_.corner(0)).cross(cell_.corner(2) - cell_.corner(0));
    const double nearest = std::abs(normal.dot(cell_.corner(0))) / normal.norm();
    return allowed > 0 ? allowed / nearest : allowed * nearest;
  }

 private:
  struct Candidate {
    PlainVector n;
    double u;      ///< min n.c over the points taken so far
    double apart;  ///< largest difference of n.c between the points that define the candidate
    double turn;   ///< squared angle by which rounding may have turned n

    double value() const {
      const double most = u + apart;
      return most + std::abs(most) * turn;
    }
  };
  // At corners three candidates; on sides two for each pair of points (signs change twice around a
  // triangle, or not at all); one for each three points.
  static constexpr int most_candidates = 3 + 2 * 28 + 56;

  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  /// Adds a candidate, bounded by all points up to the current one.
  void add(const PlainVector& n, double apart, double turn) {
    double least = std::numeric_limits<double>::infinity();
    const int points = std::min(taken_ + 1, cell_.count);
    for (int i = 0; i < points; ++i) least = std::min(least, n.dot(cell_.point(i)));
    candidates_[at(count_++)] = {n, least, apart, turn};
  }

  /// Adds the candidates on the cell's sides where n.p = n.q.
  void add_pair(const PlainVector& p, const PlainVector& q) {
    const PlainVector between = p - q;
    const double along[] = {cell_.corner(0).dot(between), cell_.corner(1).dot(between),
                            cell_.corner(2).dot(between)};
    for (int side = 0; side < 3; ++side) {
      const double at_from = along[side], at_to = along[(side + 1) % 3];
      if ((at_from < 0) == (at_to < 0)) continue;
      const double t = at_from / (at_from - at_to);
      const PlainVector &from = cell_.corner(side), &to = cell_.corner(side + 1);
      const PlainVector n = from + (to - from) * t;
      add(n * (1 / n.norm()), 0, 0);
    }
  }

  /// Adds the candidate where n.p = n.q = n.r, if it is in the cell or just outside. If the points
  /// are collinear, the middle point bounds nothing. For slivers, rounding turns n considerably.
  /// This only matters if the foot of the origin on the points' plane is in their triangle;
  /// otherwise u is larger at another candidate. Along n, the foot reaches no further than the
  /// furthest of the three points; so does the plane, up to the square of the turn.
  void add_triple(const PlainVector& p, const PlainVector& q, const PlainVector& r) {
    constexpr double in_line = 1e-12, beside = 1e-3;
    // Rounding of a cross product, relative to the product of its factors' lengths.
    constexpr double in_rounding = 8 * std::numeric_limits<double>::epsilon();
    const PlainVector e1 = q - p, e2 = r - p;
    PlainVector n = e1.cross(e2);
    const double length = n.norm();
    const double upright = n.dot(middle_) < 0 ? -1 : 1;
    for (int side = 0; side < 3; ++side)
      if (upright * n.dot(inward_[at(side)]) < -beside * squared_inward_[at(side)] * length) return;
    const double sides = std::sqrt(e1.dot(e1) * e2.dot(e2));
    if (!(length > in_line * sides)) return;
    n = n * (upright / length);
    const double at_p = n.dot(p), at_q = n.dot(q), at_r = n.dot(r);
    const double turn = in_rounding * sides / length;
    add(n, std::max({at_p, at_q, at_r}) - std::min({at_p, at_q, at_r}), turn * turn);
  }

  const DirectionCell& cell_;
  double size_;
  double highest_ = -std::numeric_limits<double>::infinity();
  PlainVector direction_, middle_;
  std::array<PlainVector, 3> inward_;
  std::array<double, 3> squared_inward_;
  int taken_ = 0, count_ = 0;
  std::array<Candidate, most_candidates> candidates_;
};

}  // namespace minkray
