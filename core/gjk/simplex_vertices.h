// SPDX-License-Identifier: MIT
// The vertices of a simplex as the distance subalgorithms store them, and their result. A vertex
// keeps its slot, so that data cached for the slot stay valid. In the paper's letters, x is a
// point, p a support point of the object C, y = x - p a vertex of the simplex in {x} - C, and v the
// simplex' point closest to the origin. When x moves in a ray cast, all y move by the same vector.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

#include "core/math/vec.h"

namespace minkray {

/// Result of every distance subalgorithm.
template <class T, int Dim>
struct SubalgorithmAnswer {
  Vec<T, Dim> v = Vec<T, Dim>::Zero();  ///< the simplex' point closest to the origin
  std::array<T, Dim + 1> weights = {};  ///< by slot: v = sum of weights[i] * y[i]
  unsigned kept = 0;                    ///< bit i is set if v needs the vertex in slot i
  bool proper = true;                   ///< false: found by the backup procedure, due to rounding
};

/// Slots of the vertices; base of the subalgorithms. If all Dim + 1 slots are used, the simplex has
/// an interior.
template <class T, int Dim>
class SimplexVertices {
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

 protected:
  void clear(const Vec<T, Dim>& x) {
    used_ = 0;
    x_ = x;
  }

  void translate(const Vec<T, Dim>& x) {
    x_ = x;
    for (std::size_t i = 0; i < slots; ++i)
      if (uses(static_cast<int>(i))) y_[i] = x - p_[i];
  }

  /// Adds the vertex for the support point p and returns its slot. Requires a free slot.
  int insert(const Vec<T, Dim>& p) {
    int slot = 0;
    while (uses(slot)) ++slot;
    p_[static_cast<std::size_t>(slot)] = p;
    y_[static_cast<std::size_t>(slot)] = x_ - p;
    used_ |= 1u << slot;
    return slot;
  }

 private:
  std::array<Vec<T, Dim>, slots> p_;
  std::array<Vec<T, Dim>, slots> y_;
  Vec<T, Dim> x_ = Vec<T, Dim>::Zero();
  unsigned used_ = 0;
};

}  // namespace minkray
