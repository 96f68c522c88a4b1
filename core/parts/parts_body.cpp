// SPDX-License-Identifier: MIT
#include "core/parts/parts_body.h"

#include "core/pair/core_support.h"

namespace minkray {

Bounds<double> bounds_of(const PartsBody& body, const Affine<double>& pose) {
  constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
  if (body.mesh()) {
    const Bounds<double>& own = body.mesh()->bounds();
    const Vec3<double> middle = pose(own.centre());
    const Vec3<double> reach = pose.linear.cwiseAbs() * own.reach_of_centre();
    const Vec3<double> around =
        reach + rounding * (middle.cwiseAbs() + Vec3<double>::Constant(body.mesh()->reach()));
    return {middle - around, middle + around};
  }
  if (const Compound* const compound = body.compound()) {
    Bounds<double> bounds;
    for (std::size_t i = 0; i < compound->size(); ++i)
      bounds.extend(bounds_of(PartsBody(compound->contact(i)), pose));
    return bounds;
  }
  const PlacedCore frame = placed(*body.shape(), pose);
  const ShapeCore& core = body.shape()->core();
  Bounds<double> bounds;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3<double> d = frame.turn.row(axis).transpose();
    const double allowed =
        rounding * (core.ball + core.radius + std::abs(frame.middle[axis])) + core.rounding;
    const auto reach = [&](const Vec3<double>& along) {
      return along.dot(support_of_core<CoreKind::other>(core, along).point) + core.radius + allowed;
    };
    bounds.lower[axis] = frame.middle[axis] - reach(-d);
    bounds.upper[axis] = frame.middle[axis] + reach(d);
  }
  return bounds;
}

double reach_of(const PartsBody& body) {
  if (body.mesh()) return body.mesh()->reach();
  if (body.compound()) return body.compound()->reach();
  return body.shape()->ball_radius() + body.shape()->offset() + body.shape()->core().rounding;
}

Vec3<double> middle_of(const PartsBody& body) {
  return body.mesh()       ? body.mesh()->bounds().centre()
         : body.compound() ? body.compound()->bounds().centre()
                           : body.shape()->middle();
}

}  // namespace minkray
