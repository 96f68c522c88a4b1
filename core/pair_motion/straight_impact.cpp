// SPDX-License-Identifier: MIT
#include "core/pair_motion/straight_impact.h"

#include <algorithm>
#include <cmath>

#include "core/math/outward_sum.h"
#include "core/math/two_fold.h"

namespace minkray {
namespace {

/// Time by which bodies that are far apart have come near each other: rounding is then relative to
/// their sizes, not to their distance at the start. 0 if they are not far apart or do not approach.
double time_near(const Vec3<double>& x, const Vec3<double>& velocity, double size, double t_max) {
  constexpr double far = 1024, near = 8;  // distances in units of the sizes
  if (!(x.squaredNorm() > far * far * size * size)) return 0;
  const double speed = length_of(velocity), time = (-x.dot(velocity) / speed - near * size) / speed;
  return time > 0 && std::isfinite(time) ? std::min(time, t_max) : 0;
}

/// Vector between the middles at a time. The bodies' positions are rounded once, near each other.
Between between_at(double t, const ContactShape& a, const RigidMotion& motion_a,
                   const ContactShape& b, const RigidMotion& motion_b) {
  Affine<double> at_a = motion_a.pose, at_b = motion_b.pose;
  for (int axis = 0; axis < 3; ++axis) {
    const TwoFold<double> way =
        two_product(t, motion_b.velocity[axis]) + two_product(-t, motion_a.velocity[axis]);
    at_b.translation[axis] = (two_sum(at_b.translation[axis], -at_a.translation[axis]) + way).high;
  }
  at_a.translation.setZero();
  return between_middles(a, at_a, b, at_b);
}

}  // namespace

SweptStatus straight_impact(const ContactShape& a, const RigidMotion& motion_a,
                            const ContactShape& b, const RigidMotion& motion_b, double t_max,
                            const ImpactOptions& options, PairMemory* memory, Impact& result) {
  // Solvers are compiled for only one order of two kinds.
  const bool is_turned = a.core().kind > b.core().kind;
  const ContactShape &first = is_turned ? b : a, &second = is_turned ? a : b;
  const RigidMotion &of_first = is_turned ? motion_b : motion_a,
                    &of_second = is_turned ? motion_a : motion_b;
  const Vec3<double> velocity = of_second.velocity - of_first.velocity;
  const double size = a.ball_radius() + b.ball_radius(), touching = options.touching * size;
  Between between = between_middles(first, of_first.pose, second, of_second.pose);
  double begin = time_near(between.x, velocity, size, t_max);
  if (begin > 0) {
    const Between then = between_at(begin, first, of_first, second, of_second);
    // Times may have too few digits to be that exact.
    if (then.x.norm() > 2 * size && then.x.dot(velocity) < 0)
      between = then;
    else
      begin = 0;
  }
  const double end = begin > 0 ? sum_or_more(t_max, -begin) : t_max;
  const auto finish = [&](const SweptTime& swept, const auto& to_world) {
    if (swept.status == SweptStatus::open) return SweptStatus::open;
    const Vec3<double> axis = to_world(swept.axis);
    result.normal = unit<double>(is_turned ? Vec3<double>(-axis) : axis);
    if (swept.status == SweptStatus::miss) return SweptStatus::miss;
    if ((begin + swept.t_lo) * length_of(velocity) <= touching || swept.t_lo > end)
      return SweptStatus::open;
    const double last = std::max(swept.t_lo, swept.t_hi);
    result.status = ImpactStatus::hit;
    result.normal_error = swept.axis_error;
    result.t_lo = sum_or_less(begin, swept.t_lo);
    result.t_hi = sum_or_more(begin, last);
    // The point belongs to both bodies at t_hi. At t_lo, the second body is behind it by `back`.
    const Vec3<double> back = (last - swept.t_lo) * velocity;
    result.point_a = result.point_b =
        middle_in_world(first, of_first.pose) + to_world(swept.a) + result.t_lo * of_first.velocity;
    (is_turned ? result.point_a : result.point_b) -= back;
    result.distance = is_turned ? result.normal.dot(back) : -result.normal.dot(back);
    return SweptStatus::hit;
  };
  if (second.core().kind == CoreKind::point) {  // balls, which have no frame
    const Mat3<double> no_turn = Mat3<double>::Identity();
    const CorePair pair{first.core(), second.core(), no_turn, between.x, between.loss};
    return finish(swept_time(pair, velocity, end, touching, memory, options.is_for_derivatives),
                  [](const Vec3<double>& v) -> const Vec3<double>& { return v; });
  }
  const Mat3<double> frame = turn_in_world(first, of_first.pose);
  const CorePair pair =
      pair_of(first, frame, second, turn_in_world(second, of_second.pose), between);
  return finish(swept_time(pair, frame.transpose() * velocity, end, touching, memory,
                           options.is_for_derivatives),
                [&](const Vec3<double>& v) -> Vec3<double> { return frame * v; });
}

}  // namespace minkray
