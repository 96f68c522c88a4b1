// SPDX-License-Identifier: MIT
#include "core/pair_derivative/pair_derivative_error.h"

#include <algorithm>
#include <cmath>

#include "core/pair/flat_part.h"
#include "core/pair_derivative/normal_error.h"

namespace minkray {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Bounds the position of a core's true nearest point, if the true normal leans by at most `tilt`.
struct Slide {
  double any = infinity;  ///< largest distance from the support point
  FlatPart flat;          ///< an edge that the point lies on, up to `beside`
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
  constexpr double rounding = 1e-12;  // rounding of directions rotated to the body's frame
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

/// Error of n as the direction from a core to a point, both in the core's frame: as the normal of
/// the core grown by `length`.
double tilt_over(ShapeCore core, const Vec3<double>& point, const Vec3<double>& n, double length,
                 double off) {
  core.radius = length;
  return normal_error_at(core, point, n, off);
}

/// Two edges that cross: bounds of the distances of the true nearest points from `to_a` and `to_b`.
struct Crossing {
  double a = infinity, b = infinity;
};
Crossing on_edges(const Vec3<double>& u, const Vec3<double>& to_a, double beside_a,
                  const Vec3<double>& v, const Vec3<double>& to_b, double beside_b,
                  const Vec3<double>& between, double unsure, const Drift& drift) {
  const double sine = u.cross(v).norm() - 2 * drift.turn;
  if (!(sine > 0)) return {};
  const Vec3<double> on_a = u.dot(to_a) * u, on_b = v.dot(to_b) * v;
  const double turned = drift.turn * (on_a.norm() + on_b.norm());
  const double off =
      (between + on_b - on_a).norm() + unsure + drift.way + turned + beside_a + beside_b;
  const double slide = std::sqrt(2.0) * off / sine + drift.way + turned;
  return {(to_a - on_a).norm() + slide + beside_a, (to_b - on_b).norm() + slide + beside_b};
}

/// True if the nearest point is between the ends of a straight edge. The support point is one of
/// the ends, but a hull's edge may continue beyond it.
bool is_between_ends(const ShapeCore& core, const Slide& slide, double at, double off) {
  if (core.kind != CoreKind::hull && core.kind != CoreKind::other) at = std::abs(at);
  return slide.beside == 0 && at > off && at < slide.flat.length - off;
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
  const double height = n.dot(c);
  double low = height - rounding - drift.way, high = found.upper + radii + drift.way;
  double tilt = depth_tilt, aside = infinity;
  if (low > 0) {
    // The distance is between that of a plane and that of two points. `aside` bounds the distance
    // of the true c from height * n: projections onto a convex body are no further apart than the
    // points that are projected.
    high = std::max(high, low);
    aside = (c - height * n).norm() + rounding + drift.way + slide_by_drift(cores.a, down_a) +
            slide_by_drift(cores.b, down_b);
    tilt = std::min(std::sqrt(2 * (high - low) / high), 1.5 * aside / low);
  } else if (high < 0) {
    low = found.lower + radii;
  }
  PairDerivativeError error;
  if (!(tilt < 0.5)) return error;
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  const Slide a = slide_of(cores.a, down_a, tilt + 8 * epsilon + drift.turn);
  const Slide b = slide_of(cores.b, down_b, tilt + 8 * epsilon + drift.turn);
  const Vec3<double> point_b = contact.a + contact.c;
  const Vec3<double> to_a = contact.a - s_a, to_b = point_b - s_b;
  if (low > 0) {
    // If a core touches with a corner, the normal is that of the other core at this corner.
    const double moved = high - low + rounding + drift.way + drift.turn * high;
    if (b.any == 0)
      tilt = std::min(tilt, drift.turn + tilt_over(cores.a, cores.turn_a.transpose() * s_b, down_a,
                                                   height, moved));
    if (a.any == 0)
      tilt = std::min(
          tilt, drift.turn + tilt_over(cores.b, cores.turn_b.transpose() * (s_a - cores.between.x),
                                       down_b, height, moved));
  }
  // Bounds the distance of the true c from height * n.
  const auto off_by = [&](double lean) {
    if (low > 0) return std::min(aside, high - low + high * lean) + drift.way;
    return std::max(std::abs(high - height), std::abs(low - height)) + std::abs(low) * lean;
  };
  Crossing crossing;
  if (a.flat.dimension == 1 && b.flat.dimension == 1) {
    const Vec3<double> u = cores.turn_a * a.flat.along, v = cores.turn_b * b.flat.along;
    const auto cross = [&] {
      return on_edges(u, to_a, a.beside, v, to_b, b.beside, c - height * n, off_by(tilt), drift);
    };
    crossing = cross();
    // If both nearest points are between the ends of their edges, the normal is perpendicular to
    // both.
    if (low > 0 && is_between_ends(cores.a, a, u.dot(to_a), crossing.a) &&
        is_between_ends(cores.b, b, v.dot(to_b), crossing.b)) {
      const Vec3<double> across = u.cross(v);
      const double sine = across.norm();
      const double lean = std::min((across / sine - n).norm(), (across / sine + n).norm());
      tilt = std::min(tilt, lean + (2 * drift.turn + 16 * epsilon) / (sine - 2 * drift.turn));
      crossing = cross();
    }
  }
  tilt += 8 * epsilon;
  const double off = off_by(tilt);
  double of_a = to_a.norm() + a.any, of_b = to_b.norm() + b.any;
  // A bound for the point of one body gives a bound for that of the other.
  of_a = std::min({of_a, (contact.a - (s_b - height * n)).norm() + b.any + off, crossing.a});
  of_b = std::min({of_b, (point_b - (s_a + height * n)).norm() + a.any + off, crossing.b});
  const double far =
      rounding + drift.way + 4 * epsilon * std::max(origin_a.norm(), origin_b.norm());
  error.a = {tilt, of_a + far + tilt * (contact.a - origin_a).norm()};
  error.b = {tilt, of_b + far + tilt * (point_b - origin_b).norm()};
  return error;
}

PairDerivativeError error_at_half_space(const ShapeCore& core_b, const Vec3<double>& down,
                                        double tilt, const SignedDistance& found,
                                        const Vec3<double>& origin_a, const Vec3<double>& origin_b,
                                        const Drift& drift) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  tilt += drift.turn;
  // The radius is along the normal, and does not change the arm perpendicular to the normal.
  const double slide = slide_of(core_b, down, tilt).any;
  const double rounding =
      core_rounding * core_b.ball +
      16 * epsilon *
          (found.point_a.norm() + found.point_b.norm() + origin_a.norm() + origin_b.norm());
  const auto of_turn = [&](const Vec3<double>& arm) {
    return slide + rounding + drift.way + tilt * arm.norm();
  };
  return {{tilt, of_turn(found.point_a - origin_a)}, {tilt, of_turn(found.point_b - origin_b)}};
}

}  // namespace minkray
