// SPDX-License-Identifier: MIT
#include "core/pair_derivative/pair_derivative_error.h"

#include <algorithm>
#include <cmath>

#include "core/pair/flat_part.h"
#include "core/pair_derivative/normal_error.h"

namespace minkray {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Place of a core's true nearest point, if the true normal leans by `tilt` at most.
struct Slide {
  double any = infinity;  ///< distance from the support point at most
  FlatPart flat;          ///< an edge on which it is, but for `beside`
  double beside = infinity;
};

Slide slide_of(const ShapeCore& core, const Vec3<double>& d, double tilt) {
  Slide slide;
  const auto by_curvature = [&](double most, double least) {
    return least > 0 ? tilt * most / least : infinity;
  };
  if (core.kind == CoreKind::other || !(tilt < 0.5)) return slide;
  if (core.kind == CoreKind::point) {
    slide.any = 0;
    return slide;
  }
  if (core.kind == CoreKind::ellipsoid) {
    const double largest = core.size.maxCoeff();
    slide.any = by_curvature(largest * largest, core.size.cwiseProduct(d).norm() - tilt * largest);
    return slide;
  }
  constexpr double rounding = 1e-12;  // of directions that were turned to the body's frame
  slide.flat = flat_part(core, d, tilt + rounding);
  double around = 0;
  if (core.kind == CoreKind::disks) {
    const double across = std::hypot(d.x(), d.y());
    const double rim = std::max(core.size.x(), core.size.y());
    around = by_curvature(rim, across - tilt);
    if (slide.flat.dimension == 0) {
      const double own = support_of_core<CoreKind::disks>(core, d).point.head<2>().norm();
      slide.any = own > 0 ? by_curvature(own, across - tilt) : 0;
    }
  } else if (slide.flat.dimension == 0) {
    slide.any = 0;
  }
  if (slide.flat.dimension == 1) slide.beside = around;
  return slide;
}

/// Error of the direction from a core to a point, both in the core's frame: the normal of the core
/// grown by the distance.
double tilt_over(ShapeCore core, const Vec3<double>& point, const Vec3<double>& n, double length,
                 double off) {
  core.radius = length;
  return normal_error_at(core, point, n, off);
}

/// Two edges that cross: how far the points that are nearest may be from those along them that lead
/// to `to_a` and `to_b`.
struct Crossing {
  double a = infinity, b = infinity;
};
Crossing on_edges(const Vec3<double>& u, const Vec3<double>& to_a, double beside_a,
                  const Vec3<double>& v, const Vec3<double>& to_b, double beside_b,
                  const Vec3<double>& between, double unsure) {
  const double sine = u.cross(v).norm();
  const Vec3<double> on_a = u.dot(to_a) * u, on_b = v.dot(to_b) * v;
  const double off = (between + on_b - on_a).norm() + unsure + beside_a + beside_b;
  const double slide = std::sqrt(2.0) * off / sine;
  return {(to_a - on_a).norm() + slide + beside_a, (to_b - on_b).norm() + slide + beside_b};
}

}  // namespace

PairDerivativeError error_of(const CoresInWorld& cores, const CoreContact& contact,
                             const SignedDistance& found, double depth_tilt,
                             const Vec3<double>& origin_a, const Vec3<double>& origin_b,
                             const Drift& drift) {
  const double radii = cores.a.radius + cores.b.radius, rounding = cores.rounding();
  const Vec3<double>& n = contact.normal;
  const Vec3<double> s_a = cores.support_a(n), s_b = cores.support_b(-n), c = s_b - s_a;
  const Vec3<double> down_a = cores.turn_a.transpose() * n, down_b = cores.turn_b.transpose() * -n;
  const auto slide_by_drift = [&](const ShapeCore& core, const Vec3<double>& d) {
    return drift.turn > 0 ? slide_of(core, d, drift.turn).any : 0;
  };
  double height = n.dot(c);
  double low = height - rounding - drift.way, high = found.upper + radii + drift.way;
  double tilt = depth_tilt;
  double off = infinity;  ///< the true c is no further from `height` times n
  if (low > 0) {
    // Between a plane and a point, and by how much the support point is aside: projections onto a
    // convex body are no further apart than what is projected.
    const double aside = (c - height * n).norm() + rounding + drift.way +
                         slide_by_drift(cores.a, down_a) + slide_by_drift(cores.b, down_b);
    const double lens = std::sqrt(2 * std::max(high - low, 0.0) / high);
    tilt = std::min(lens, 1.5 * aside / low);
    const double moved = std::max(high - low, 0.0) + rounding + drift.way + drift.turn * high;
    if (cores.b.kind == CoreKind::point)
      tilt = std::min(tilt, drift.turn + tilt_over(cores.a, cores.turn_a.transpose() * s_b, down_a,
                                                   height, moved));
    if (cores.a.kind == CoreKind::point)
      tilt = std::min(
          tilt, drift.turn + tilt_over(cores.b, cores.turn_b.transpose() * (s_a - cores.between.x),
                                       down_b, height, moved));
    off = std::min(aside, std::max(high - low, 0.0) + high * tilt) + drift.way;
  } else if (high < 0) {
    low = found.lower + radii;
    off = std::max(std::abs(high - height), std::abs(low - height)) + std::abs(low) * tilt;
  }
  PairDerivativeError error;
  if (!(tilt < 0.5)) return error;
  tilt += 8 * std::numeric_limits<double>::epsilon();
  const Slide a = slide_of(cores.a, down_a, tilt + drift.turn);
  const Slide b = slide_of(cores.b, down_b, tilt + drift.turn);
  const Vec3<double> point_b = contact.a + contact.c;
  const Vec3<double> to_a = contact.a - s_a, to_b = point_b - s_b;
  double of_a = to_a.norm() + a.any, of_b = to_b.norm() + b.any;
  // One of them leads to the other.
  of_a = std::min(of_a, (contact.a - (s_b - height * n)).norm() + b.any + off);
  of_b = std::min(of_b, (point_b - (s_a + height * n)).norm() + a.any + off);
  if (a.flat.dimension == 1 && b.flat.dimension == 1 && !(drift.turn > 0)) {
    const Crossing crossing =
        on_edges(cores.turn_a * a.flat.along, to_a, a.beside, cores.turn_b * b.flat.along, to_b,
                 b.beside, c - height * n, off + 2 * drift.way);
    of_a = std::min(of_a, crossing.a);
    of_b = std::min(of_b, crossing.b);
  }
  const double far =
      rounding + drift.way +
      4 * std::numeric_limits<double>::epsilon() * std::max(origin_a.norm(), origin_b.norm());
  error.a = {tilt, of_a + far + tilt * (contact.a - origin_a).norm()};
  error.b = {tilt, of_b + far + tilt * (point_b - origin_b).norm()};
  return error;
}

}  // namespace minkray
