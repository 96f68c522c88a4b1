// SPDX-License-Identifier: MIT
#include "core/pair_distance/meridian_bounds.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace minkray {
namespace {

/// Rounding error bound of support points and of products with them, relative to the sizes.
constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();

/// An axis through a core's middle: the core's points are within `off` of a solid of revolution
/// about this axis.
struct Revolution {
  bool is_there = false;
  bool is_any = false;  ///< a point: any axis
  Vec3<double> axis = Vec3<double>::UnitZ();
  double off = 0;
};

Revolution revolution_of(const ShapeCore& core) {
  using enum CoreKind;
  Revolution found;
  found.is_any = core.kind == point;
  found.is_there = found.is_any || core.kind == segment || core.kind == disks || core.is_round;
  if (core.kind == ellipsoid) {
    found.is_there = true;
    found.off = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
      const double between = std::abs(core.size[(k + 1) % 3] - core.size[(k + 2) % 3]);
      if (!(between < found.off)) continue;
      found.off = between;
      found.axis = Vec3<double>::Unit(k);
    }
  }
  return found;
}

/// A half plane in A's frame, bounded by the direction of a common axis. `off` is the largest error
/// of n.c if the cores' axes are replaced by axes in that direction.
struct HalfPlane {
  Vec3<double> along, across;
  double off;
};

std::optional<HalfPlane> meridian_of(const CorePair& pair) {
  const Revolution a = revolution_of(pair.a), b = revolution_of(pair.b);
  if (!a.is_there || !b.is_there) return {};
  const Vec3<double> axis_b = unit<double>(pair.turn * b.axis);
  HalfPlane plane{a.is_any ? axis_b : a.axis, Vec3<double>::Zero(), a.off + b.off};
  const Vec3<double>& e = plane.along;
  // Error of turning B about its middle until its axis is parallel to A's; the angle is at most
  // twice its sine.
  if (!a.is_any && !b.is_any) plane.off += 2 * e.cross(axis_b).norm() * pair.b.ball;
  plane.across = unit<double>(pair.x - e.dot(pair.x) * e);
  // If the middles lie along the axis to within rounding, any half plane may be used.
  const double aslant = std::abs(plane.across.dot(e));
  if (!(aslant < 0.5) || plane.across.isZero(0)) {
    plane.off += 2 * (pair.x - e.dot(pair.x) * e).norm();
    plane.across = e.unitOrthogonal();
  } else {
    plane.across = unit<double>(plane.across - plane.across.dot(e) * e);
  }
  return plane;
}

/// A direction in the half plane, its support point (which gives n.c as a sinusoid of the angle),
/// and g(n).
struct Sample {
  double angle = 0;
  double across = 0, along = 0;  ///< the support point
  double g = 0;

  double at(double other) const { return across * std::cos(other) + along * std::sin(other); }
  /// Largest n.c between two angles.
  double most(double from, double to) const {
    const double peak = std::atan2(along, across);
    if (from < peak && peak < to) return std::hypot(across, along);
    return std::max(at(from), at(to));
  }
};

struct Arc {
  Sample from, to;
  double bound = 0;   ///< upper bound of g between the two
  double middle = 0;  ///< direction where both bounds are equal, or halfway

  Arc(const Sample& first, const Sample& last) : from(first), to(last) {
    const double across = to.across - from.across, along = to.along - from.along;
    middle = std::atan2(-across, along);
    if (middle <= from.angle || middle >= to.angle)
      middle += middle <= from.angle ? std::numbers::pi : -std::numbers::pi;
    if (middle > from.angle && middle < to.angle) {
      bound = std::max(from.most(from.angle, middle), to.most(middle, to.angle));
    } else {
      middle = from.angle + (to.angle - from.angle) / 2;
      bound = std::min(from.most(from.angle, to.angle), to.most(from.angle, to.angle));
    }
  }
  bool operator<(const Arc& other) const { return bound < other.bound; }
};

class MeridianSearch {
 public:
  MeridianSearch(const CorePair& pair, const CoreDistance& known, const HalfPlane& plane)
      : pair_(pair), best_(known), axis_(plane.along), across_(plane.across) {}

  /// Returns true once the largest bound is within `gap` of `lower`.
  bool run(double gap) {
    constexpr int arcs = 4;
    Sample from = sample(-std::numbers::pi / 2);
    for (int i = 1; i <= arcs; ++i) {
      const Sample to = sample(std::numbers::pi * (double(i) / arcs - 0.5));
      add({from, to});
      from = to;
    }
    constexpr int most_supports = 400;
    for (int left = most_supports; left > 0; --left) {
      const Arc top = arcs_.front();
      best_.upper = top.bound;
      if (top.bound - best_.lower <= gap) return true;
      std::pop_heap(arcs_.begin(), arcs_.end());
      arcs_.pop_back();
      const Sample between = sample(top.middle);
      add({top.from, between});
      add({between, top.to});
    }
    return false;
  }

  const CoreDistance& found() const { return best_; }

 private:
  Sample sample(double angle) {
    ++best_.supports;
    const Vec3<double> n = unit<double>(std::cos(angle) * across_ + std::sin(angle) * axis_);
    const Vec3<double> c = nearest_along(pair_, n).c;
    best_.raise_lower(n.dot(c), n);
    return {angle, across_.dot(c), axis_.dot(c), n.dot(c)};
  }

  void add(const Arc& arc) {
    arcs_.push_back(arc);
    std::push_heap(arcs_.begin(), arcs_.end());
  }

  const CorePair& pair_;
  CoreDistance best_;
  Vec3<double> axis_, across_;
  std::vector<Arc> arcs_;
};

}  // namespace

std::optional<CoreDistance> bound_along_meridian(const CorePair& pair, const CoreDistance& known,
                                                 double gap) {
  const std::optional<HalfPlane> plane = meridian_of(pair);
  if (!plane) return {};
  // g of the cores and g of the cores of revolution differ by at most `off`; the gap includes this
  // twice.
  const double size = pair.size() + pair.x.norm(), allowed = 2 * plane->off + rounding * size;
  constexpr double hardly = 1e-6;
  if (!(allowed <= hardly * size)) return {};
  const bool is_exhausted = !(allowed <= gap * size / 2);
  MeridianSearch search(pair, known, *plane);
  if (!search.run(is_exhausted ? allowed : gap * size - allowed)) return {};
  CoreDistance found = search.found();
  found.upper += allowed;
  found.is_exhausted = is_exhausted;
  found.status = CoreStatus::unsettled;
  if (found.lower > 0) found.status = CoreStatus::separated;
  if (found.upper < 0) found.status = CoreStatus::overlapping;
  return found;
}

}  // namespace minkray
