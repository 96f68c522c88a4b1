// SPDX-License-Identifier: MIT
#include "renderer/clearance/body_pair.h"

#include <algorithm>

#include "core/pair_motion/least_distance.h"
#include "core/parts/parts_distance.h"

namespace minkray {

SignedDistance distance_between(const ClearanceBody& a, const Mat3<double>& linear_a,
                                const ClearanceBody& b, const Mat3<double>& linear_b,
                                const Between& between, const SignedDistanceOptions& options) {
  if (!a.mesh && !b.mesh)
    return signed_distance(a.shape, linear_a, b.shape, linear_b, between, options, nullptr);
  const Vec3<double> middle_a = linear_a * a.own_middle(), middle_b = linear_b * b.own_middle();
  SignedDistance found = signed_distance(a.parts(), {linear_a, -middle_a}, b.parts(),
                                         {linear_b, between.x - middle_b}, options);
  const double loss =
      between.loss + core_rounding * (between.x.norm() + middle_a.norm() + middle_b.norm());
  found.lower = std::max(0.0, found.lower - loss);
  found.upper += loss;
  return found;
}

double gap_between(const ClearanceBody& a, const Mat3<double>& linear_a, const ClearanceBody& b,
                   const Mat3<double>& linear_b, const Between& between, const Vec3<double>& n) {
  if (!a.mesh && !b.mesh) return gap_along(a.shape, linear_a, b.shape, linear_b, between, n);
  return n.dot(between.x) - reach_along(a.parts(), linear_a, n) -
         reach_along(b.parts(), linear_b, -n) - core_rounding * between.x.norm() - between.loss;
}

}  // namespace minkray
