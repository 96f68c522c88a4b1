// SPDX-License-Identifier: MIT
#include "renderer/library/handles/pair_answers.h"

#include <cmath>
#include <string>

#include "renderer/library/handles/call.h"

namespace minkray {

SignedDistanceOptions distance_options(const minkray_distance_options* given) {
  SignedDistanceOptions options;
  if (!given) return options;
  if (given->size < sizeof(minkray_distance_options))
    wrong_use("options.size: must be sizeof(minkray_distance_options)");
  if (!(given->tolerance >= 0) || !(given->tolerance < 1))
    wrong_use("options.tolerance: must be >= 0 and < 1 (got " + std::to_string(given->tolerance) +
              ")");
  if (!(given->at_most >= 0))
    wrong_use("options.at_most: must be >= 0 (got " + std::to_string(given->at_most) + ")");
  if (given->tolerance > 0) options.tolerance = given->tolerance;
  if (given->at_most > 0) options.at_most = given->at_most;
  options.only_sign = given->only_sign != 0;
  return options;
}

minkray_distance_status code_of(SignedStatus status) {
  switch (status) {
    case SignedStatus::separated:
      return MINKRAY_SEPARATED;
    case SignedStatus::touching:
      return MINKRAY_TOUCHING;
    case SignedStatus::overlapping:
      return MINKRAY_OVERLAPPING;
    case SignedStatus::undecided:
      break;
  }
  return MINKRAY_UNDECIDED;
}

minkray_impact_status code_of(ImpactStatus status) {
  switch (status) {
    case ImpactStatus::hit:
      return MINKRAY_IMPACT;
    case ImpactStatus::miss:
      return MINKRAY_NO_IMPACT;
    case ImpactStatus::inside:
      return MINKRAY_BEGINS_INSIDE;
    case ImpactStatus::undecided:
      break;
  }
  return MINKRAY_IMPACT_UNDECIDED;
}

minkray_distance plain_distance(const SignedDistance& found) {
  minkray_distance plain;
  plain.value = found.value;
  plain.lower = found.lower;
  plain.upper = found.upper;
  put(found.point_a, plain.point_a);
  put(found.point_b, plain.point_b);
  put(found.normal, plain.normal);
  plain.status = code_of(found.status);
  plain.supports = found.supports;
  return plain;
}

minkray_impact plain_impact(const Impact& found) {
  minkray_impact plain;
  plain.t_lo = found.t_lo;
  plain.t_hi = end_of(found);
  plain.distance = found.distance;
  put(found.point_a, plain.point_a);
  put(found.point_b, plain.point_b);
  put(found.normal, plain.normal);
  plain.status = code_of(found.status);
  plain.steps = found.steps;
  return plain;
}

minkray_manifold plain_manifold(const SignedDistance& nearest, const ContactManifold& found) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  minkray_manifold plain;
  put(found.normal, plain.normal);
  for (int i = 0; i < 4; ++i) {
    const ContactPoint& point = found.points[static_cast<std::size_t>(i)];
    const bool is_there = i < found.count;
    const Vec3<double> nans(nan, nan, nan);
    put(is_there ? point.point_a : nans, plain.points_a[i]);
    put(is_there ? point.point_b : nans, plain.points_b[i]);
    plain.gaps[i] = is_there ? point.distance : nan;
  }
  plain.value = nearest.value;
  plain.lower = nearest.lower;
  plain.upper = nearest.upper;
  plain.count = found.count;
  plain.status = code_of(nearest.status);
  return plain;
}

void check_ends(const double* t_max, std::size_t have, std::size_t pairs) {
  if (have != pairs && have != 1)
    wrong_use("t_max: must be one, or as many as pairs, " + std::to_string(pairs) + " (got " +
              std::to_string(have) + ")");
  if (have > 0) require(t_max, "t_max");
  for (std::size_t i = 0; i < have; ++i)
    if (!std::isfinite(t_max[i]) || !(t_max[i] >= 0))
      wrong_use("t_max[" + std::to_string(i) + "]: must be finite and >= 0 (got " +
                std::to_string(t_max[i]) + ")");
}

}  // namespace minkray
