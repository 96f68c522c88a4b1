// SPDX-License-Identifier: MIT
// Distance subalgorithm by projections (core/gjk/closest_point.h): the default of the solvers. A
// simplex in 2D is treated as a flat simplex in 3D, without loss of precision.
#pragma once

#include "core/gjk/closest_point.h"
#include "core/gjk/simplex_vertices.h"

namespace minkray {

template <class T, int Dim>
class ProjectionSubalgorithm : public SimplexVertices<T, Dim> {
  using Base = SimplexVertices<T, Dim>;

 public:
  static constexpr std::string_view name = "projection";

  void begin(const Vec<T, Dim>& x) { Base::clear(x); }
  void move(const Vec<T, Dim>& x) { Base::translate(x); }
  int add(const Vec<T, Dim>& p) { return Base::insert(p); }

  SubalgorithmAnswer<T, Dim> closest() const {
    SimplexPoints<T> simplex;
    std::array<std::size_t, Dim + 1> slot{};
    for (int i = 0; i < Base::slots; ++i) {
      if (!this->uses(i)) continue;
      const auto at = static_cast<std::size_t>(simplex.size++);
      simplex.y[at].setZero();
      simplex.y[at].template head<Dim>() = this->y(i);
      slot[at] = static_cast<std::size_t>(i);
    }
    const ClosestPoint<T> closest = closest_point(simplex);
    SubalgorithmAnswer<T, Dim> answer;
    answer.v = closest.v.template head<Dim>();
    for (std::size_t i = 0; i < static_cast<std::size_t>(simplex.size); ++i) {
      answer.weights[slot[i]] = closest.weights[i];
      if (closest.kept & (1u << i)) answer.kept |= 1u << slot[i];
    }
    return answer;
  }
};

}  // namespace minkray
