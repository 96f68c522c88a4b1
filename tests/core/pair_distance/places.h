// SPDX-License-Identifier: MIT
// Pairs near the origin, and the same pairs moved by vectors that doubles hold exactly; and what
// capsules' distances are in quadruple precision.
#pragma once

#include <array>
#include <sstream>
#include <string>

#include "tests/core/pair_distance/random_bodies.h"
#include "tests/oracle/quad.h"
#include "tests/support/sample_shapes.h"
#include "tests/support/shifted.h"

namespace minkray::testing {

inline constexpr std::array places = {10.0, 100.0, 1e4, 1e6, 1e9};

/// Numbers with so few digits that they stay exact 10^9 away.
inline Vec3<double> coarse(const Vec3<double>& v) {
  return (v * 0x1p20).array().round().matrix() / 0x1p20;
}
inline Vec3<double> place_at(double distance, RandomShapes& random) {
  return (distance * random.direction()).array().round().matrix();
}

inline Affine<double> moved(const Affine<double>& pose, const Vec3<double>& way) {
  return {pose.linear, pose.translation + way};
}
inline Shape under(const Shape& shape, const Affine<double>& map) {
  return Transform{shape, map};
}
inline Shape moved(const Shape& shape, const Vec3<double>& way) {
  return under(shape, shifted_by(way));
}

inline Quad limited(Quad t) {
  return t < 0 ? Quad(0) : t > 1 ? Quad(1) : t;
}

struct QuadCapsule {
  QuadVec from, way;
  Quad radius;
};

/// The capsule's ends in exact arithmetic of the pose's numbers.
inline QuadCapsule capsule(const Affine<double>& pose, double radius, double half) {
  const QuadVec at = quad(pose.translation), end = pose.linear.cast<Quad>() * QuadVec(0, 0, half);
  return {at - end, 2 * end, radius};
}

inline Quad signed_distance_of(const QuadCapsule& a, const QuadCapsule& b) {
  const QuadVec x = b.from - a.from;
  const Quad aa = a.way.squaredNorm(), bb = b.way.squaredNorm(), ab = a.way.dot(b.way),
             ax = a.way.dot(x), bx = b.way.dot(x), area = aa * bb - ab * ab;
  Quad least = -1;
  const auto add = [&](Quad s, Quad t) {
    const Quad squared = (x + t * b.way - s * a.way).squaredNorm();
    if (least < 0 || squared < least) least = squared;
  };
  for (const Quad end : {Quad(0), Quad(1)}) {
    add(limited(aa > 0 ? (ax + end * ab) / aa : 0), end);
    add(end, limited(bb > 0 ? (end * ab - bx) / bb : 0));
  }
  if (area > aa * bb * Quad(1e-25)) {
    const Quad s = (ax * bb - bx * ab) / area, t = (ax * ab - bx * aa) / area;
    if (s > 0 && s < 1 && t > 0 && t < 1) add(s, t);
  }
  return root(least) - a.radius - b.radius;
}

/// Empty if the true distance is within the bounds and the status is true.
inline std::string complaint_of(const SignedDistance& found, Quad truth) {
  std::ostringstream text;
  text.precision(17);
  text << name_of(found.status) << " in [" << found.lower << ", " << found.upper << "], truth "
       << static_cast<double>(truth) << ", off by "
       << static_cast<double>(truth < found.lower ? truth - found.lower : truth - found.upper);
  if (truth < found.lower || truth > found.upper) return text.str();
  if (found.status == SignedStatus::separated && !(truth > 0)) return text.str();
  if (found.status == SignedStatus::overlapping && !(truth < 0)) return text.str();
  return "";
}

/// Empty if two answers to the same question may both be true, and the second is about as sharp:
/// searches end with bounds 1e-12 of the size apart, or 1e-10 where they overlap, one here and the
/// other there.
inline std::string complaint_of(const SignedDistance& near, const SignedDistance& far,
                                double size) {
  std::ostringstream text;
  text.precision(17);
  text << name_of(near.status) << " in [" << near.lower << ", " << near.upper << "], far away "
       << name_of(far.status) << " in [" << far.lower << ", " << far.upper << "]";
  const double rounding = (near.lower > 0 ? 2e-11 : 5e-10) * size;
  if (near.lower > far.upper || far.lower > near.upper) return text.str();
  if (far.upper - far.lower > 4 * (near.upper - near.lower) + rounding) return text.str();
  if (near.status == SignedStatus::separated && far.status == SignedStatus::overlapping)
    return text.str();
  if (near.status == SignedStatus::overlapping && far.status == SignedStatus::separated)
    return text.str();
  if (far.value < far.lower || far.value > far.upper) return text.str();
  return "";
}

/// A gap that rounding hides or nearly so, of both signs, or none.
inline double slight_gap(int k, RandomShapes& random) {
  const double gap = std::pow(10, random.in(-17, -11));
  return k % 3 == 0 ? 0 : k % 3 == 1 ? gap : -gap;
}

/// All kinds, some within others.
inline Shape any_shape(int k, RandomShapes& random) {
  static const std::vector<SampleShape> samples = sample_shapes();
  const std::size_t count = samples.size();
  switch (k % 3) {
    case 0:
      return random_shape(k / 3 % kinds_of_bodies, 1, random);
    case 1:
      return samples[static_cast<std::size_t>(k / 3) % count].shape;
    default:
      return random_nesting(static_cast<std::uint64_t>(k), 3);
  }
}

struct PosedShapes {
  Shape a, b;
  Affine<double> pose_a, pose_b;
  double size = 0;

  SignedDistance distance() const {
    return signed_distance(ContactShape(a), pose_a, ContactShape(b), pose_b);
  }
};

/// Apart, overlapping, or next to touching.
inline PosedShapes any_pair(int k, RandomShapes& random) {
  PosedShapes pair{any_shape(k, random), any_shape(7 * k + 1, random), {random.turn(), {}}, {}};
  const ContactShape a(pair.a), b(pair.b);
  pair.size = a.ball_radius() + b.ball_radius() + a.offset() + b.offset();
  pair.pose_a.translation = coarse(pair.size * random.direction());
  pair.pose_b = {random.turn(), coarse(random.in(0, 2) * pair.size * random.direction())};
  if (k % 2 == 0) return pair;
  const double gap = pair.distance().value;
  if (gap > 0 && gap < 10 * pair.size)
    pair.a = Rounded{gap + pair.size * slight_gap(k / 2, random), Nested(pair.a)};
  return pair;
}

}  // namespace minkray::testing
