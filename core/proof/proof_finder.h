// SPDX-License-Identifier: MIT
// Finds the proof of a result (certificate.h), with the GJK ray cast and the GJK distance of van
// den Bergen (2004). Both end with a convex combination of support points, the "spanned" point.
// Points are relative to NearSegment::centre.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "core/proof/spanned_point.h"
#include "core/query/near_segment.h"
#include "core/query/tolerances.h"

namespace minkray::proof {

/// Limit of support points per search. Touching ellipsoids of 1:1000 took 160.
inline constexpr int most_supports = 400;

/// Angles of tilted directions. The first is the square root of the machine epsilon. The larger
/// angles are for less certain normals, and for hit points further from a corner.
inline constexpr std::array tilts = {0x1p-26, 0x1p-24, 0x1p-21, 0x1p-14};
inline constexpr int tilt_directions = 6;  ///< number of directions around n to tilt towards
inline constexpr int refinements = 24;     ///< maximum number of rounds of refine()

/// Number of steps of the secant method, which near the solution converges like Newton's method.
inline constexpr int secant_steps = 16;
/// After a step that does not change the support point, such as within a corner's normals, the next
/// step is longer by this factor.
inline constexpr double longer_step = 16;

/// Finds points of one shape near one ray.
class Finder {
 public:
  using Long = long double;

  Finder(const SupportFunction& support, const Ray<double>& ray)
      : support_(support), near_(near_segment(support, ray)) {
    rounding_ = std::numeric_limits<double>::epsilon() * near_.size;
  }
  const NearSegment& near() const { return near_; }
  double rounding() const { return rounding_; }

  Vec3<double> support(const Vec3<double>& n) {
    ++certificate.supports;
    return support_(n) - near_.centre;
  }

  /// Casts the ray, starting at lambda. Finds the ray's first point in the shape, the spanned point
  /// nearest to this point, and the last plane that clipped the ray. Sets lambda to the first
  /// point. Returns the distance between the two points; infinite for a miss.
  double enter(Vec3<double> n, double& lambda) {
    Vec3<double> x = near_.at(lambda);
    SpannedPoint spanned(x.cast<Long>());
    for (int i = 0; i < most_supports; ++i) {
      const Vec3<double> p = support(n);
      const double above = n.dot(x - p), slope = n.dot(near_.r);
      bool moved = false;
      if (above > 0) {
        if (!(slope < 0)) return std::numeric_limits<double>::infinity();
        const double clipped = lambda - above / slope;
        if (clipped > near_.end) return std::numeric_limits<double>::infinity();
        if (clipped > lambda) {
          lambda = clipped;
          certificate.plane = n;
          x = near_.at(lambda);
          spanned.move(x.cast<Long>());
          moved = true;
        }
      }
      if (!spanned.add(p.cast<Long>(), n) && !moved) break;
      if (spanned.full() || spanned.v().norm() <= tolerance::proof_on_the_spot * rounding_) break;
      n = spanned.v().cast<double>().normalized();
    }
    spanned.balance();
    spanned.write_to(certificate);
    return spanned.off();
  }

  /// Finds the nearest points of the shape and of the ray's part from lambda = a to lambda = b. The
  /// shape's point is a spanned point. Returns the distance of the two points; `separating` is the
  /// normal of a plane between them.
  double nearest(double a, double b, Vec3<double> n, Vec3<double>& separating) {
    SpannedPoint spanned(Vec3<Long>::Zero());
    double widest = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < most_supports; ++i) {
      const Vec3<double> p = support(n);
      const Vec3<Long> y = near_.at(n.dot(near_.r) > 0 ? a : b).cast<Long>() - p.cast<Long>();
      if (const double margin = n.dot(y.cast<double>()); margin > widest) {
        widest = margin;
        separating = n;
      }
      if (!spanned.add(-y, n)) break;
      const auto distance = static_cast<double>(spanned.v().norm());
      if (spanned.full() || distance <= tolerance::proof_on_the_spot * rounding_) break;
      if (distance - widest <= rounding_) break;
      n = spanned.v().cast<double>() / distance;
    }
    spanned.balance();
    spanned.write_to(certificate);
    return spanned.off();
  }

  /// Finds a spanned point near x(lambda), the ray's point at lambda, where the normal is about n.
  /// Tries triangles of support points in directions tilted slightly from n. On a face with rounded
  /// edges, or a patch with radius of curvature rho, tilts by delta give points at a distance rho *
  /// delta around the hit point, and only rho * delta^2 below it. Returns the distance of the best
  /// point from x(lambda). Uses long double: a point between a sliver's corners loses digits in
  /// proportion to the sliver's thinness.
  double refine(double lambda, const Vec3<double>& n) {
    const Vec3<Long> x = near_.s.cast<Long>() + Long(lambda) * near_.r.cast<Long>();
    std::vector<Seen> seen;
    const auto see = [&](const Vec3<double>& direction) {
      const Vec3<Long> y = x - support(direction).cast<Long>();
      for (const Seen& other : seen)
        if (other.y == y) return false;
      seen.push_back({y, direction});
      return true;
    };
    for (const WeightedSupport& term : certificate.spanning)
      if (term.weight > 0) see(term.direction);
    see(n);
    for (const double delta : tilts)
      for (int i = 0; i < tilt_directions; ++i) see(n + delta * around(n, i));
    // Finds the nearest triangle. If it is not near enough, adds support points near this triangle.
    ClosestPoint<Long, 3> best;
    Long best_squared = std::numeric_limits<Long>::infinity();
    std::array<std::size_t, 3> corners{};
    // A triangle can be nearer than the best point only if a corner lies before the plane through
    // the best point.
    const auto is_before = [&](std::size_t i) { return seen[i].y.dot(best.v) < best_squared; };
    const auto try_triangle = [&](std::size_t i, std::size_t j, std::size_t k) {
      if (!is_before(k) && !is_before(j) && !is_before(i)) return;
      const SimplexPoints<Long> triangle = {seen[i].y, seen[j].y, seen[k].y};
      const ClosestPoint<Long, 3> closest = closest_point(triangle, 0b111);
      const Long squared = closest.v.squaredNorm();
      if (!(squared < best_squared)) return;
      best = closest;
      best_squared = squared;
      corners = {i, j, k};
    };
    const auto try_with_last = [&] {
      const std::size_t k = seen.size() - 1;
      for (std::size_t i = 0; i < k; ++i)
        for (std::size_t j = i; j < k; ++j) try_triangle(i, j, k);
    };
    for (std::size_t k = 0; k < seen.size(); ++k)
      for (std::size_t i = 0; i <= k; ++i)
        for (std::size_t j = i; j <= k; ++j) try_triangle(i, j, k);
    const auto is_near_enough = [&] {
      return std::sqrt(best_squared) <= Long(tolerance::proof_on_the_spot * rounding_);
    };
    // Searches from n, and from the direction of x, which is one of the normals at most edges.
    for (const Vec3<double>& from : {n, unit<double>(x.cast<double>())})
      if (!is_near_enough() && !from.isZero(0) && see(towards(x, from))) try_with_last();
    for (int round = 0; round < refinements && !is_near_enough(); ++round) {
      // Searches beyond the triangle's side that is nearest to x: tilts n towards this side by
      // small and large angles.
      const Vec3<double> v = (best.v / std::sqrt(best_squared)).cast<double>(),
                         aside = unit<double>(v - n.dot(v) * n);
      bool found = false;
      const auto look = [&](const Vec3<double>& direction) {
        if (!see(direction)) return;
        found = true;
        try_with_last();
      };
      const Long before = best_squared;
      for (const double delta : tilts) look(n + delta * aside);
      look(v);
      // If v is the normal of an edge, the support point may be the edge's other end.
      if (best_squared > before / 4)
        for (int i = 0; i < tilt_directions; ++i) look(v + tilts.front() * around(v, i));
      if (!found) break;
    }
    certificate.spanning = {};
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const bool kept = best.kept & (1u << i);
      certificate.spanning[i] = {seen[corners[i]].direction,
                                 kept ? double(std::max(best.weights[i], Long(0))) : 0};
    }
    return double(std::sqrt(best_squared));
  }

  Certificate certificate;

 private:
  struct Seen {
    Vec3<Long> y;
    Vec3<double> direction;
  };

  /// Returns the i-th of the directions perpendicular to n towards which n is tilted.
  static Vec3<double> around(const Vec3<double>& n, int i) {
    const Vec3<double> a = n.unitOrthogonal(), b = n.cross(a);
    const double angle = 2 * std::numbers::pi * i / tilt_directions;
    return std::cos(angle) * a + std::sin(angle) * b;
  }

  /// Returns a direction whose support point is nearer to x than that of n. Succeeds if the surface
  /// bends, as along a rim, so that the support point moves with the direction. Uses the secant
  /// method.
  Vec3<double> towards(const Vec3<Long>& x, Vec3<double> n) {
    if (!(near_.size > 0)) return n;
    double step = 1 / near_.size;
    Vec3<Long> y = x - support(n).cast<Long>();
    for (int i = 0; i < secant_steps && y.norm() > Long(tolerance::proof_on_the_spot * rounding_);
         ++i) {
      const Vec3<double> turned = unit<double>(n + step * y.cast<double>());
      if (!turned.allFinite() || turned.isZero(0)) break;
      const Vec3<Long> left = x - support(turned).cast<Long>();
      const auto share = static_cast<double>((y - left).dot(y) / y.squaredNorm());
      step *= share > 0 ? 1 / share : longer_step;
      if (!(left.squaredNorm() < y.squaredNorm())) continue;
      n = turned;
      y = left;
    }
    return n;
  }

  const SupportFunction& support_;
  NearSegment near_;
  double rounding_ = 0;
};

}  // namespace minkray::proof
