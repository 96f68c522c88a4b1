// SPDX-License-Identifier: MIT
// A simplex of GJK. In the letters of van den Bergen (2004), x is a point, p a support point of the
// object C, y = x - p a vertex of the simplex in {x} - C, and v the simplex' point closest to the
// origin. When x moves in a ray cast, all y move by the same vector. A vertex keeps its slot, so
// that data cached for the slot stay valid.
#pragma once

#include <algorithm>
#include <array>

#include "core/gjk/closest_point.h"

namespace minkray {

/// If all Dim + 1 slots are used, the simplex has an interior. Base of the distance subalgorithms
/// that find the closest point in another way.
template <class T, int Dim>
class Simplex {
 public:
  using Scalar = T;
  static constexpr int dimension = Dim;
  static constexpr int slots = Dim + 1;
  static constexpr unsigned all_slots = (1u << slots) - 1;

  unsigned used() const { return used_; }
  bool uses(int slot) const { return (used_ >> slot) & 1u; }
  bool full() const { return used_ == all_slots; }
  const Vec<T, Dim>& p(int slot) const { return p_[static_cast<std::size_t>(slot)]; }
  const Vec<T, Dim>& y(int slot) const { return y_[static_cast<std::size_t>(slot)]; }

  /// True if p is exactly equal to a vertex.
  bool holds(const Vec<T, Dim>& p) const {
    for (int i = 0; i < slots; ++i)
      if (uses(i) && this->p(i) == p) return true;
    return false;
  }

  /// Maximum of |y|^2 over the vertices. The paper's termination test is relative to this value.
  T furthest_squared() const {
    T furthest = T(0);
    for (int i = 0; i < slots; ++i)
      if (uses(i)) furthest = std::max(furthest, y(i).squaredNorm());
    return furthest;
  }

  /// Removes the vertices whose bits are not set, which v does not need.
  void keep(unsigned kept) { used_ &= kept; }

  /// Removes all vertices.
  void begin(const Vec<T, Dim>& x) {
    used_ = 0;
    x_ = x;
  }

  void move(const Vec<T, Dim>& x) {
    x_ = x;
    for (std::size_t i = 0; i < slots; ++i)
      if (uses(static_cast<int>(i))) y_[i] = x - p_[i];
  }

  /// Adds the vertex for the support point p and returns its slot. Requires a free slot.
  int add(const Vec<T, Dim>& p) {
    int slot = 0;
    while (uses(slot)) ++slot;
    p_[static_cast<std::size_t>(slot)] = p;
    y_[static_cast<std::size_t>(slot)] = x_ - p;
    used_ |= 1u << slot;
    return slot;
  }

  /// A simplex in 2D is treated as a flat simplex in 3D, without loss of precision.
  ClosestPoint<T, Dim> closest() const {
    if constexpr (Dim == 3) {
      return closest_point(y_, used_);
    } else {
      SimplexPoints<T> y;
      for (std::size_t i = 0; i < slots; ++i) y[i] << y_[i], T(0);
      const ClosestPoint<T, 3> in_3d = closest_point(y, used_);
      ClosestPoint<T, Dim> result{in_3d.v.template head<Dim>(), {}, in_3d.kept};
      std::copy_n(in_3d.weights.begin(), slots, result.weights.begin());
      return result;
    }
  }

 private:
  std::array<Vec<T, Dim>, slots> p_, y_;
  Vec<T, Dim> x_ = Vec<T, Dim>::Zero();
  unsigned used_ = 0;
};

}  // namespace minkray
