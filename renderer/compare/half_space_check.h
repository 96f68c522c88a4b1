// SPDX-License-Identifier: MIT
// Compares half-spaces, which are unbounded and so have no mesh for Embree. A bisection of the
// height along the ray in long double checks the closed form.
#pragma once

#include "core/world/half_space.h"
#include "renderer/compare/sandwich_check.h"

namespace minkray {

class HalfSpaceCheck {
 public:
  explicit HalfSpaceCheck(const HalfSpaceBody<double>& in_world) : half_space_(in_world) {}

  /// Compares the cast with a bisection, whose bracket is t_outer and t_inner.
  Verdict judge(const Ray<double>& ray) const;

  /// Rays in all directions from above the plane; about half of them hit.
  CompareReport compare(const CompareOptions& options) const;

 private:
  HalfSpaceBody<double> half_space_;
};

}  // namespace minkray
