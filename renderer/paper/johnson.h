// SPDX-License-Identifier: MIT
// Johnson's distance subalgorithm (van den Bergen, 2004, section 3): finds the simplex' point
// closest to the origin from determinants of its subsets. Differences of vertices are cached while
// both vertices are used. Determinants are computed again when x moves (section 4).
#pragma once

#include <limits>

#include "core/gjk/simplex.h"

namespace minkray {

/// For X a subset of the vertices Y, v(aff X) = sum of D_i(X)/D(X) y_i, with
///   D_i({i}) = 1,  D_j(X + {j}) = sum over i in X of D_i(X) (y_k - y_j).y_i  for any k in X,
/// and D(X) their sum. The smallest X whose convex hull contains v has D_i(X) > 0 for all i in X
/// and D_j(X + {j}) <= 0 for all others. If rounding has changed signs of determinants, there may
/// be no such X. The backup procedure of Gilbert, Johnson and Keerthi (1988) then takes the closest
/// v of all X with D_i(X) > 0.
template <class T, int Dim>
class JohnsonSubalgorithm : public Simplex<T, Dim> {
  using Base = Simplex<T, Dim>;

 public:
  /// Moves x: translates the vertices and computes the determinants again.
  void move(const Vec<T, Dim>& x) {
    Base::move(x);
    for (unsigned X = 1; X <= Base::all_slots; ++X)
      if ((X & ~this->used()) == 0) compute_determinants(X);
  }

  /// Adds a vertex and returns its slot.
  int add(const Vec<T, Dim>& p) {
    const int slot = Base::add(p);
    for (int j = 0; j < Base::slots; ++j) {
      if (j == slot || !this->uses(j)) continue;
      difference(slot, j) = this->p(j) - p;  // y_slot - y_j; exact for close points
      difference(j, slot) = -difference(slot, j);
    }
    const unsigned with_slot = 1u << slot;
    for (unsigned X = with_slot; X <= Base::all_slots; ++X)
      if ((X & with_slot) && (X & ~this->used()) == 0) compute_determinants(X);
    return slot;
  }

  /// The simplex' point closest to the origin; the vertices stay until keep().
  ClosestPoint<T, Dim> closest() const {
    for (unsigned X = 1; X <= Base::all_slots; ++X)
      if ((X & ~this->used()) == 0 && is_inside(X) && none_other_helps(X)) return answer_of(X);
    return backup();
  }

 private:
  Vec<T, Dim>& difference(int k, int j) {
    return differences_[static_cast<std::size_t>(k)][static_cast<std::size_t>(j)];
  }
  T& determinant(unsigned X, int i) { return determinants_[X][static_cast<std::size_t>(i)]; }
  T determinant(unsigned X, int i) const { return determinants_[X][static_cast<std::size_t>(i)]; }

  /// Computes D_j(X) for all j in X, from the determinants of the subsets with one vertex less.
  void compute_determinants(unsigned X) {
    for (int j = 0; j < Base::slots; ++j) {
      if (!(X & (1u << j))) continue;
      const unsigned rest = X & ~(1u << j);
      if (rest == 0) {
        determinant(X, j) = T(1);
        continue;
      }
      int k = 0;
      while (!(rest & (1u << k))) ++k;
      T sum = T(0);
      for (int i = 0; i < Base::slots; ++i)
        if (rest & (1u << i)) sum += determinant(rest, i) * difference(k, j).dot(this->y(i));
      determinant(X, j) = sum;
    }
  }

  /// First condition: v(aff X) lies in the interior of conv X.
  bool is_inside(unsigned X) const {
    for (int i = 0; i < Base::slots; ++i)
      if ((X & (1u << i)) && !(determinant(X, i) > T(0))) return false;
    return true;
  }

  /// Second condition: no other vertex lies on the origin's side of v(aff X).
  bool none_other_helps(unsigned X) const {
    for (int j = 0; j < Base::slots; ++j)
      if (this->uses(j) && !(X & (1u << j)) && !(determinant(X | (1u << j), j) <= T(0)))
        return false;
    return true;
  }

  ClosestPoint<T, Dim> answer_of(unsigned X) const {
    ClosestPoint<T, Dim> answer;
    answer.kept = X;
    T sum = T(0);
    for (int i = 0; i < Base::slots; ++i)
      if (X & (1u << i)) sum += determinant(X, i);
    for (int i = 0; i < Base::slots; ++i) {
      if (!(X & (1u << i))) continue;
      const T weight = determinant(X, i) / sum;
      answer.weights[static_cast<std::size_t>(i)] = weight;
      answer.v += weight * this->y(i);
    }
    return answer;
  }

  ClosestPoint<T, Dim> backup() const {
    ClosestPoint<T, Dim> best;
    T best_squared = std::numeric_limits<T>::infinity();
    for (unsigned X = 1; X <= Base::all_slots; ++X) {
      if ((X & ~this->used()) != 0 || !is_inside(X)) continue;
      const ClosestPoint<T, Dim> candidate = answer_of(X);
      const T squared = candidate.v.squaredNorm();
      if (!(squared < best_squared)) continue;
      best = candidate;
      best_squared = squared;
    }
    best.proper = false;
    return best;
  }

  std::array<std::array<Vec<T, Dim>, Base::slots>, Base::slots> differences_;
  std::array<std::array<T, Base::slots>, Base::all_slots + 1> determinants_;
};

}  // namespace minkray
