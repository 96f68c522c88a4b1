// SPDX-License-Identifier: MIT
#include "core/pair_motion/swept_time.h"

#include <cmath>

#include "core/pair/core_kinds.h"
#include "core/pair/searchable.h"
#include "core/pair_motion/swept_boxes.h"
#include "core/pair_motion/swept_closed.h"
#include "core/pair_motion/swept_portal.h"

namespace minkray {

namespace {

/// Two balls: the first solution of |x + t v| = r, with error bounds.
SweptTime of_balls(const CorePair& pair, const Vec3<double>& velocity, double t_max, double near) {
  SweptTime result;
  const double radius = pair.a.radius + pair.b.radius, squared = velocity.squaredNorm(),
               towards = -pair.x.dot(velocity);
  const Vec3<double> aside = pair.x + (towards / squared) * velocity;
  const double distance = towards > 0 ? aside.norm() : pair.x.norm();
  const double rounding = pair.rounding();
  if (!(squared > 0) || std::abs(distance - radius) <= near + rounding) return result;
  const auto miss = [&](const Vec3<double>& axis) {
    result.status = SweptStatus::miss;
    result.axis = unit<double>(axis);
    return result;
  };
  if (distance > radius) return miss(towards > 0 ? aside : pair.x);
  const double deep = (radius - distance) * (radius + distance) / squared;
  const double t = towards / squared - std::sqrt(deep);
  const Vec3<double> there = pair.x + t * velocity;
  const double speed = std::sqrt(squared), approach = -there.dot(velocity) / there.norm();
  // Error of the distance at that time, divided by its rate of change.
  const double off = std::abs(there.norm() - radius) + rounding;
  if (!(t * speed > near) || !(approach > 0)) return result;
  if ((t - t_max) * approach > near + off) return miss(pair.x + t_max * velocity);
  result.status = SweptStatus::hit;
  result.t_lo = t - off / approach;
  result.t_hi = t + off / approach;
  result.axis = unit<double>(there);
  result.a = pair.a.radius * result.axis;
  if (!have_met(result.t_hi - result.t_lo, speed, near, rounding, [&] { return approach; }))
    result.status = SweptStatus::open;
  return result;
}

/// Requires speeds whose squares are normal numbers.
SweptTime of_ordinary_speeds(const CorePair& pair, const Vec3<double>& velocity, double t_max,
                             double near, PairMemory* memory, bool is_for_derivatives) {
  if (pair.a.kind == CoreKind::point && pair.b.kind == CoreKind::point)
    return of_balls(pair, velocity, t_max, near);
  SweptTime swept;
  const bool are_boxes = pair.a.kind == CoreKind::box && pair.b.kind == CoreKind::box;
  if (has_swept_closed(pair))
    swept = swept_closed(pair, velocity, t_max, near);
  else if (are_boxes && pair.a.radius + pair.b.radius == 0)
    swept = swept_boxes(pair, velocity, t_max, near);
  if (swept.status != SweptStatus::open) return swept;
  swept = with_core_kinds(pair, [&]<CoreKind A, CoreKind B>() {
    return SweptPortal<A, B>(pair, velocity, t_max, near, is_for_derivatives).run(memory);
  });
  if (memory && !swept.axis.isZero(0)) memory->axis = swept.axis;
  return swept;
}

/// Returns t * 2^power, rounded towards `outward` if it is not representable.
double rescaled(double t, int power, double outward) {
  const double scaled = std::ldexp(t, power);
  return std::ldexp(scaled, -power) == t ? scaled : std::nextafter(scaled, outward);
}

}  // namespace

SweptTime swept_time(const CorePair& pair, const Vec3<double>& velocity, double t_max, double near,
                     PairMemory* memory, bool is_for_derivatives) {
  const double size = pair.size() + pair.a.radius + pair.b.radius;
  if (!are_searchable(size, pair.x.cwiseAbs().maxCoeff())) return {};
  // Beyond these limits, squares of speeds approach the range of double, 2^-1074 to 2^1024.
  constexpr double slowest = 0x1p-400, fastest = 0x1p400;
  const double most = velocity.cwiseAbs().maxCoeff();
  if (most > slowest && most < fastest)
    return of_ordinary_speeds(pair, velocity, t_max, near, memory, is_for_derivatives);
  if (!(most > 0) || !velocity.allFinite()) return {};
  // The unit of time is a power of two, so that speeds are not rounded.
  constexpr double infinity = std::numeric_limits<double>::infinity();
  int power = 0;
  std::frexp(most, &power);
  const Vec3<double> slower =
      velocity.unaryExpr([power](double speed) { return std::ldexp(speed, -power); });
  SweptTime swept = of_ordinary_speeds(pair, slower, rescaled(t_max, power, infinity), near, memory,
                                       is_for_derivatives);
  swept.t_lo = rescaled(swept.t_lo, -power, -infinity);
  swept.t_hi = rescaled(swept.t_hi, -power, infinity);
  const bool is_late = swept.status == SweptStatus::hit && !std::isfinite(swept.t_hi);
  if (is_late) swept.status = SweptStatus::open;  // at a time that is not representable
  return swept;
}

}  // namespace minkray
