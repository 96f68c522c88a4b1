// SPDX-License-Identifier: MIT
#include "core/contact/half_space_distance.h"

#include <cmath>

#include "core/contact/closed_answer.h"

namespace minkray {

SignedDistance distance_to_half_space(const Vec3<double>& normal, double offset,
                                      const ContactShape& shape, const Affine<double>& pose) {
  constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
  const PlacedCore frame = placed(shape, pose);
  const ShapeCore& core = shape.core();
  const Vec3<double> down = frame.turn.transpose() * -normal;
  const Vec3<double> lowest = frame.turn * support_of_core<CoreKind::other>(core, down).point;
  SignedDistance result;
  result.supports = 1;
  const double value = normal.dot(frame.middle) - offset + normal.dot(lowest) - core.radius;
  const double allowed =
      rounding * (core.ball + core.radius + length_of(frame.middle) + std::abs(offset));
  if (!std::isfinite(value) || !std::isfinite(allowed)) return result;  // nothing is known
  result.normal = normal;
  result.value = value;
  result.lower = result.value - allowed;
  result.upper = result.value + allowed;
  result.status = result.lower > 0   ? SignedStatus::separated
                  : result.upper < 0 ? SignedStatus::overlapping
                                     : SignedStatus::touching;
  result.point_b = frame.middle + (lowest - core.radius * normal);
  result.point_a = result.point_b - result.value * normal;
  return result;
}

}  // namespace minkray
