// SPDX-License-Identifier: MIT
#include "core/pair_motion/swept.h"

#include <numbers>

namespace minkray {

Shape swept(const Shape& shape, const Affine<double>& from, const Affine<double>& to,
            double acceleration) {
  // Allows for the rounding of the poses' numbers.
  constexpr double padding = 1 + 16 * std::numeric_limits<double>::epsilon();
  const HullOf ends{{Nested(Shape(Transform{shape, from})), Nested(Shape(Transform{shape, to}))}};
  const double bulge = padding * acceleration / 8;
  if (!(bulge > 0)) return ends;
  return Rounded{bulge, Nested(Shape(ends))};
}

Shape swept(const Shape& shape, const Affine<double>& from, const Affine<double>& to) {
  const Mat3<double> turn = to.linear * from.linear.transpose();
  const Eigen::AngleAxis<double> by(turn);
  const double angle = by.angle();
  if (!(angle > 0)) return swept(shape, from, to, 0);
  const Vec3<double> axis = from.linear.transpose() * by.axis();
  return swept(shape, from, to, distance_from_axis(shape, axis) * angle * angle);
}

double distance_from_axis(const Shape& shape, const Vec3<double>& axis) {
  const Vec3<double> u = axis.unitOrthogonal(), v = axis.cross(u);
  constexpr int directions = 24;
  double most = 0;
  for (int k = 0; k < directions; ++k) {
    const double angle = 2 * std::numbers::pi * k / directions;
    const Vec3<double> n = std::cos(angle) * u + std::sin(angle) * v;
    most = std::max(most, n.dot(shape.support(n)));
  }
  // The half-planes around the shape bound a polygon, whose corners are further out by this factor.
  return most / std::cos(std::numbers::pi / directions);
}

}  // namespace minkray
