// SPDX-License-Identifier: MIT
// Finds where a line meets the hull of few points grown by a radius: the union of the hull, of its
// facets' prisms, and of the capsules around its edges, in long double. Three points are a
// triangle with two facets, two are a segment.
#pragma once

#include "tests/oracle/closed_form.h"
#include "tests/oracle/half_spaces.h"

namespace minkray::testing {

class RoundedHull {
 public:
  RoundedHull(std::span<const Vec3<double>> points, Long radius) : planes_(points), r_(radius) {
    for (const Vec3<double>& p : points) points_.push_back(p.cast<Long>());
  }

  Interval line(const Vec3<Long>& o, const Vec3<Long>& d) const {
    Interval inside;
    const auto add = [&](const Interval& piece) {
      if (piece.empty()) return;
      inside.lower = std::min(inside.lower, piece.lower);
      inside.upper = std::max(inside.upper, piece.upper);
    };
    const HalfSpaces::Part hull = planes_.clip(o, d);
    if (points_.size() > 3 && !hull.empty()) add({hull.lower, hull.upper});
    for (const HalfSpaces::Plane& plane : planes_.planes()) {
      const auto corner = [&](std::size_t k) { return points_[plane.through[k % 3]]; };
      const bool turns = (corner(1) - corner(0)).cross(corner(2) - corner(0)).dot(plane.normal) > 0;
      Interval prism = all;
      cut(prism, o, d, plane.normal, plane.normal.dot(corner(0)) + r_);
      cut(prism, o, d, -plane.normal, -plane.normal.dot(corner(0)));
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3<Long> along = corner(k + 1) - corner(k);
        const Vec3<Long> outward = along.cross(plane.normal) * (turns ? 1 : -1);
        cut(prism, o, d, outward, outward.dot(corner(k)));
        add(capsule(o, d, corner(k), corner(k + 1)));
      }
      add(prism);
    }
    if (points_.size() == 2) add(capsule(o, d, points_[0], points_[1]));
    return inside;
  }

 private:
  static constexpr Interval all = {-std::numeric_limits<Long>::infinity(),
                                   std::numeric_limits<Long>::infinity()};

  /// Clips the interval to the part below a plane.
  static void cut(Interval& part, const Vec3<Long>& o, const Vec3<Long>& d,
                  const Vec3<Long>& normal, Long offset) {
    const Long slope = normal.dot(d), room = offset - normal.dot(o);
    if (slope > 0) part.upper = std::min(part.upper, room / slope);
    if (slope < 0) part.lower = std::max(part.lower, room / slope);
    if (slope == 0 && room < 0) part = {};
  }

  /// Interval within r of an axis that is `from` off the line and has the direction `way`.
  Interval within(const Vec3<Long>& from, const Vec3<Long>& way) const {
    const Long across = way.squaredNorm();
    if (across == 0) return from.squaredNorm() <= r_ * r_ ? all : Interval{};
    const Long k = -from.dot(way) / across, h2 = r_ * r_ - (from + way * k).squaredNorm();
    if (h2 < 0) return {};
    const Long half = std::sqrt(h2 / across);
    return {k - half, k + half};
  }

  Interval capsule(const Vec3<Long>& o, const Vec3<Long>& d, const Vec3<Long>& a,
                   const Vec3<Long>& b) const {
    const Vec3<Long> u = (b - a) / (b - a).norm(), s = o - a;
    Interval part = within(s - u * s.dot(u), d - u * d.dot(u));
    cut(part, o, d, u, u.dot(b));
    cut(part, o, d, -u, -u.dot(a));
    for (const Vec3<Long>& end : {a, b}) {
      const Interval ball = within(o - end, d);
      if (ball.empty()) continue;
      part = part.empty()
                 ? ball
                 : Interval{std::min(part.lower, ball.lower), std::max(part.upper, ball.upper)};
    }
    return part;
  }

  HalfSpaces planes_;
  Long r_;
  std::vector<Vec3<Long>> points_;
};

}  // namespace minkray::testing
