// SPDX-License-Identifier: MIT
#include "core/pair_distance/half_space_distance.h"

#include <cmath>

#include "core/math/length.h"

namespace minkray {

SignedDistance distance_to_half_space(const Vec3<double>& normal, double offset,
                                      const ContactShape& shape, const Affine<double>& pose) {
  // Near the origin, twice the digits are not worth their time.
  constexpr double nearby = 4;
  const double far = nearby * shape.ball_radius();
  if (!shape.is_far_out() && std::abs(offset) <= far &&
      pose.translation.cwiseAbs().maxCoeff() <= far) {
    const Vec3<double> at = middle_in_world(shape, pose);
    const double rounded = core_rounding * (length_of(at) + std::abs(offset));
    SignedDistance found = distance_to_half_space(
        normal, normal.dot(at) - offset, rounded + shape.core().rounding, shape, pose.linear);
    if (found.is_unknown()) return found;
    found.point_a += at;
    found.point_b += at;
    return found;
  }
  const PlacedMiddle middle = placed_middle(shape, pose);
  TwoFold<double> height{-offset, 0};
  for (int i = 0; i < 3; ++i)
    if (normal[i] != 0) height = height + TwoFold<double>{normal[i], 0} * middle.at[i];
  SignedDistance found =
      distance_to_half_space(normal, height.high, middle.loss, shape, pose.linear);
  if (found.is_unknown()) return found;
  found.point_a += middle.at.high;
  found.point_b += middle.at.high;
  return found;
}

PlacedPlane PlacedPlane::of(const Vec3<double>& normal, double offset, const Affine<double>& map) {
  TwoFoldVec3<double> foot;
  for (int i = 0; i < 3; ++i) foot.set(i, two_product(offset, normal[i]));
  return {unit<double>(inverse_of(map.linear).transpose() * normal), image_of(map, foot)};
}

SignedDistance distance_to_half_space(const PlacedPlane& plane, const ContactShape& shape,
                                      const Mat3<double>& linear, const PlacedMiddle& middle) {
  const Vec3<double> x = (middle.at - plane.point).rounded();
  // A normal along an axis is exact; rounding turns all other normals.
  constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
  const bool is_exact = (plane.normal.array() != 0).count() == 1;
  const double loss = middle.loss + (is_exact ? 0 : rounding * length_of(x));
  SignedDistance found =
      distance_to_half_space(plane.normal, plane.normal.dot(x), loss, shape, linear);
  if (found.is_unknown()) return found;
  found.point_a += middle.at.high;
  found.point_b += middle.at.high;
  return found;
}

SignedDistance distance_to_half_space(const Vec3<double>& normal, double height, double loss,
                                      const ContactShape& shape, const Mat3<double>& linear) {
  const Mat3<double> turn = turn_in_world(shape, linear);
  const ShapeCore& core = shape.core();
  const Vec3<double> down = turn.transpose() * -normal;
  const Vec3<double> lowest = turn * support_of_core<CoreKind::other>(core, down).point;
  SignedDistance result;
  result.supports = 1;
  const double value = height + normal.dot(lowest) - core.radius;
  const double allowed = core_rounding * (core.ball + core.radius + std::abs(height)) + loss;
  if (!std::isfinite(value) || !std::isfinite(allowed)) return result;  // unknown
  result.normal = normal;
  result.value = value;
  result.lower = result.value - allowed;
  result.upper = result.value + allowed;
  result.status = result.lower > 0   ? SignedStatus::separated
                  : result.upper < 0 ? SignedStatus::overlapping
                                     : SignedStatus::touching;
  result.point_b = lowest - core.radius * normal;
  result.point_a = result.point_b - result.value * normal;
  return result;
}

}  // namespace minkray
