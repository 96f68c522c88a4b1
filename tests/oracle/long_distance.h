// SPDX-License-Identifier: MIT
// Signed distances in long double from support points alone: apart by a plain GJK whose bounds are
// a plane and a point of B - A; overlapping by climbing to the depth's directions, again and again
// by that GJK, with B moved out. Independent of the engine's solvers.
#pragma once

#include <array>
#include <vector>

#include "tests/oracle/long_support.h"

namespace minkray::testing {

struct LongBody {
  const Shape* shape;
  Affine<long double> pose;

  Real3 support(const Real3& n) const {
    return pose(long_support(*shape, pose.linear.transpose() * n));
  }
};

/// A shape without the radius that it is grown by: distances of the smaller ones
/// are convex where those of the grown ones may be depths.
struct WithoutRadius {
  Shape shape;
  long double radius = 0;
};
inline WithoutRadius without_radius(const Shape& shape) {
  if (const auto* ball = std::get_if<Sphere>(&shape.kind)) return {Point(), ball->radius};
  if (const auto* capsule = std::get_if<Capsule>(&shape.kind)) {
    const Vec3<double> end(0, 0, capsule->half_height);
    return {Segment{{-end, end}}, capsule->radius};
  }
  if (const auto* rounded = std::get_if<Rounded>(&shape.kind)) {
    WithoutRadius inner = without_radius(*rounded->shape);
    inner.radius += rounded->radius;
    return inner;
  }
  return {shape};
}

/// Moves the body by step times a twist: exactly, along a screw's tangent and by a rotation about
/// the origin of its frame.
inline LongBody twisted(LongBody body, const Real3& velocity, const Real3& turn, long double step) {
  body.pose.translation += step * velocity;
  const long double angle = turn.norm();
  if (angle > 0)
    body.pose.linear =
        Eigen::AngleAxis<long double>(step * angle, turn / angle).toRotationMatrix() *
        body.pose.linear;
  return body;
}

/// The signed distance is in [lower, upper]; a depth's upper bound is not known, and infinite.
struct LongDistance {
  long double lower = -std::numeric_limits<long double>::infinity();
  long double upper = std::numeric_limits<long double>::infinity();
  Real3 normal = Real3::Zero();
  bool overlaps = false;
  int turns = 0;
};

/// The point of the hull of up to four points that is nearest to the origin. Keeps in `points`
/// those that it is made of. Zero, if the origin is within.
inline Real3 nearest_of_simplex(std::array<Real3, 4>& points, int& count) {
  using Long = long double;
  Long best = std::numeric_limits<Long>::infinity();
  Real3 nearest = Real3::Zero();
  int kept = 0;
  const auto consider = [&](const Real3& v, int mask) {
    const Long squared = v.squaredNorm();
    if (!(squared < best)) return;
    best = squared;
    nearest = v;
    kept = mask;
  };
  for (int i = 0; i < count; ++i) consider(points[i], 1 << i);
  for (int i = 0; i < count; ++i)
    for (int j = i + 1; j < count; ++j) {
      const Real3 e = points[j] - points[i];
      const Long ee = e.squaredNorm(), t = -points[i].dot(e);
      if (!(t > 0 && t < ee)) continue;
      consider(points[i] + (t / ee) * e, 1 << i | 1 << j);
    }
  for (int i = 0; i < count; ++i)
    for (int j = i + 1; j < count; ++j)
      for (int k = j + 1; k < count; ++k) {
        Real3 p = points[i], q = points[j], r = points[k];
        // Slim triangles have a precise normal by their shortest side and another one.
        if ((q - r).squaredNorm() < std::min((p - q).squaredNorm(), (p - r).squaredNorm()))
          std::swap(p, q);
        const Real3 n = (q - p).cross(r - p);
        const Long nn = n.squaredNorm();
        if (!(nn > 0)) continue;
        const Real3 foot = (n.dot(p) / nn) * n;
        const Real3 a = p - foot, b = q - foot, c = r - foot;
        if (n.dot(a.cross(b)) > 0 && n.dot(b.cross(c)) > 0 && n.dot(c.cross(a)) > 0)
          consider(foot, 1 << i | 1 << j | 1 << k);
      }
  if (count == 4) {
    bool within = true;
    for (int i = 0; i < 4; ++i) {
      const Real3 &p = points[i], &q = points[(i + 1) % 4], &r = points[(i + 2) % 4],
                  &s = points[(i + 3) % 4];
      const Real3 n = (q - p).cross(r - p);
      within = within && -n.dot(p) * n.dot(s - p) > 0;
    }
    if (within) return Real3::Zero();
  }
  int next = 0;
  for (int i = 0; i < count; ++i)
    if ((kept >> i & 1) != 0) points[next++] = points[i];
  count = next;
  return nearest;
}

/// Apart: both bounds, to a few units in the last place of long double. `moved` is added to B.
inline LongDistance long_distance(const LongBody& a, const LongBody& b, const Real3& start,
                                  const Real3& moved = Real3::Zero()) {
  using Long = long double;
  const auto point_along = [&](const Real3& n) -> Real3 {
    return b.support(-n) + moved - a.support(n);
  };
  LongDistance found;
  std::array<Real3, 4> points = {point_along(start)};
  int count = 1;
  Real3 v = points[0];
  Long scale = v.norm();
  constexpr int most_turns = 400;
  int stalls = 0;
  constexpr int most_stalls = 4;
  for (; found.turns < most_turns; ++found.turns) {
    const Long length = v.norm();
    stalls = length < found.upper ? 0 : stalls + 1;
    if (stalls > most_stalls) break;
    if (!(length > 1e-16L * scale)) {
      found.overlaps = true;
      return found;
    }
    const Real3 n = v / length;
    const Real3 next = point_along(n);
    scale = std::max(scale, next.norm());
    const Long height = n.dot(next);
    if (height > found.lower) {
      found.lower = height;
      found.normal = n;
    }
    found.upper = std::min(found.upper, length);
    if (found.upper - found.lower <= 2e-19L * scale) break;
    bool is_known = false;
    for (int i = 0; i < count; ++i) is_known = is_known || points[i] == next;
    if (is_known) break;
    points[count++] = next;
    v = nearest_of_simplex(points, count);
    if (v.isZero(0)) {
      found.overlaps = true;
      return found;
    }
  }
  return found;
}

inline long double gap_along(const LongBody& a, const LongBody& b, const Real3& n) {
  return n.dot(b.support(-n) - a.support(n));
}

/// Overlapping: climbs from a direction to one where the gap between parallel planes is the largest
/// around. `unsure` is infinite unless it got there.
struct LongDepth {
  long double value;
  Real3 normal;
  long double unsure = std::numeric_limits<long double>::infinity();
};
inline LongDepth climb(const LongBody& a, const LongBody& b, Real3 n, long double size,
                       int most_turns = 200) {
  using Long = long double;
  LongDepth depth{gap_along(a, b, n), n};
  const Long apart = 0.02L * size, settled = 1e-19L * size;
  int small_gains = 0;
  for (int i = 0; i < most_turns; ++i) {
    const LongDistance out = long_distance(a, b, n, (apart - depth.value) * n);
    if (out.overlaps || !out.normal.allFinite()) return depth;
    const Long value = gap_along(a, b, out.normal);
    small_gains = value - depth.value > settled ? 0 : small_gains + 1;
    if (value >= depth.value) {
      depth.value = value;
      depth.normal = out.normal;
    }
    n = out.normal;
    if (small_gains > 5) {
      depth.unsure = std::max(out.upper - out.lower, Long(0)) + 20 * settled;
      return depth;
    }
  }
  return depth;
}

}  // namespace minkray::testing
