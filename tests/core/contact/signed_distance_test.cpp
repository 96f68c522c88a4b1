// SPDX-License-Identifier: MIT
// Signed distances are judged by planes and points: of the shapes' own support mappings, which the
// solvers do not use, and by oracles that share nothing with them.
#include "core/contact/signed_distance.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/oracle/wolfe.h"

namespace minkray {
namespace {

using Long = long double;

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double in(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Vec3<double> direction() {
    std::normal_distribution<double> normal;
    return Vec3<double>(normal(engine_), normal(engine_), normal(engine_)).normalized();
  }
  Mat3<double> turn() { return rotation_matrix(in(-1, 1), in(-1, 1), in(-1, 1), in(-1, 1)); }
  Shape<double> hull(int count, double size) {
    std::vector<Vec3<double>> points;
    for (int i = 0; i < count; ++i) points.push_back(size * direction());
    return Hull<double>{PointCloud<double>(points)};
  }

 private:
  std::mt19937 engine_;
};

constexpr int kinds = 17;

Shape<double> random_shape(int kind, double s, Random& random) {
  const auto size = [&](double low, double high) { return s * random.in(low, high); };
  const auto sizes = [&]() -> Vec3<double> { return {size(0.1, 1), size(0.1, 1), size(0.1, 1)}; };
  switch (kind) {
    case 0:
      return Point<double>{s * random.direction()};
    case 1:
      return Segment<double>{{s * random.direction(), s * random.direction()}};
    case 2:
      return Triangle<double>{
          {s * random.direction(), s * random.direction(), s * random.direction()}};
    case 3:
      return Sphere<double>{size(0.2, 1)};
    case 4:
      return Ellipsoid<double>{sizes()};
    case 5:
      return Box<double>{sizes()};
    case 6:
      return Disk<double>{size(0.2, 1)};
    case 7:
      return Cylinder<double>{size(0.2, 1), size(0.1, 1)};
    case 8:
      return Cone<double>{size(0.2, 1), size(0.1, 1)};
    case 9:
      return Capsule<double>{size(0.1, 0.5), size(0.1, 1)};
    case 10:
      return Frustum<double>{{size(0.1, 1), size(0.1, 1)}, size(0.1, 1)};
    case 11:
      return random.hull(12, s);
    case 12:
      return random.hull(64, s);
    case 13:
      return Rounded<double>{size(0.05, 0.3), Nested<double>(Shape<double>(Box<double>{sizes()}))};
    case 14:
      return Rounded<double>{size(0.05, 0.3), Nested<double>(random_shape(7, s, random))};
    case 15:
      return TaperedCapsule<double>{{size(0.1, 0.5), size(0.1, 0.5)}, size(0.1, 1)};
    default:
      return Transform<double>{
          Nested<double>(random_shape(4, 1, random)),
          Affine<double>{Mat3<double>(random.turn() * Vec3<double>(s, 2 * s, s / 2).asDiagonal() *
                                      random.turn()),
                         s * random.direction()}};
  }
}

struct Body {
  Shape<double> shape;
  ContactShape ready;
  Affine<double> pose;

  Body(Shape<double> of, const Affine<double>& at) : shape(of), ready(of), pose(at) {}
  Vec3<double> in_body(const Vec3<double>& n) const { return pose.linear.transpose() * n; }
  /// How far it reaches along n from a point in the world that is near it.
  Long reach(const Vec3<double>& n, const Vec3<double>& from) const {
    const Vec3<double> s = shape.support(in_body(n));
    return n.cast<Long>().dot(pose.linear.cast<Long>() * s.cast<Long>() +
                              (pose.translation.cast<Long>() - from.cast<Long>())) /
           n.cast<Long>().norm();
  }
};

/// The gap between planes with normal n.
double gap(const Body& a, const Body& b, const Vec3<double>& n) {
  const Vec3<double> from = a.pose.translation;
  return static_cast<double>(-b.reach(-n, from) - a.reach(n, from));
}

/// The largest gap that a search at random finds.
double best_gap(const Body& a, const Body& b, Random& random) {
  Vec3<double> best = random.direction();
  double largest = gap(a, b, best), step = 0.3;
  for (int i = 0; i < 100; ++i) {
    const Vec3<double> n =
        i < 40 ? random.direction() : Vec3<double>((best + step * random.direction()).normalized());
    const double found = gap(a, b, n);
    if (found > largest) {
      largest = found;
      best = n;
    } else if (i >= 40) {
      step *= 0.8;
    }
  }
  return largest;
}

/// How far a point is outside of a body, as far as some directions tell.
double outside(const Body& body, const Vec3<double>& point, const Vec3<double>& normal,
               Random& random) {
  double most = 0;
  for (int i = 0; i < 12; ++i) {
    Vec3<double> n = normal;
    if (i >= 8) n = random.direction();
    if (i > 0 && i < 8) n += 1e-3 * random.direction();
    most = std::max(most, static_cast<double>(-body.reach(n, point)));
  }
  return most;
}

struct Seen {
  int separated = 0, overlapping = 0, touching = 0, all = 0;
};

void expect_proven(const Body& a, const Body& b, const SignedDistance& result, Random& random,
                   Seen& seen) {
  const double size = a.ready.reach() + b.ready.reach();
  const double reaches = size + a.ready.middle().norm() + b.ready.middle().norm() +
                         (b.pose.translation - a.pose.translation).norm();
  const double rounding = 16 * tolerance::epsilon<double> * reaches;
  EXPECT_NE(result.status, SignedStatus::undecided);
  EXPECT_LE(result.lower, result.value);
  EXPECT_LE(result.value, result.upper);
  EXPECT_LE(result.upper - result.lower, 1e-9 * size + 4 * rounding);
  // The plane proves the lower bound, and no plane is better than the upper one.
  EXPECT_NEAR(result.normal.norm(), 1, 1e-14);
  EXPECT_LE(result.lower, gap(a, b, result.normal) + rounding);
  EXPECT_GE(result.upper, best_gap(a, b, random) - rounding);
  // The points are of the shapes, and as far from each other.
  const double far = rounding + 4 * tolerance::epsilon<double> * a.pose.translation.norm();
  const double near = (result.status == SignedStatus::separated ? 1e-11 : 1e-8) * size + far;
  EXPECT_LE(((result.point_b - result.point_a) - result.value * result.normal).norm(),
            3e-6 * size + far);
  EXPECT_LE(outside(a, result.point_a, result.normal, random), near);
  EXPECT_LE(outside(b, result.point_b, -result.normal, random), near);
  seen.separated += result.status == SignedStatus::separated;
  seen.overlapping += result.status == SignedStatus::overlapping;
  seen.touching += result.status == SignedStatus::touching;
  ++seen.all;
}

TEST(SignedDistance, random_pairs_of_all_kinds_are_proven_by_planes_and_points) {
  Random random(31);
  Seen seen;
  for (int i = 0; i < kinds; ++i)
    for (int j = 0; j < kinds; ++j)
      for (int k = 0; k < 24; ++k) {
        // Scales of all sizes, and far origins.
        const double scale = k % 6 == 5 ? std::pow(10, random.in(-3, 3)) : 1;
        const double other = k % 8 == 7 ? scale * std::pow(10, random.in(-2, 2)) : scale;
        const Vec3<double> origin =
            k % 5 == 4 ? 1e4 * scale * random.direction() : Vec3<double>(Vec3<double>::Zero());
        const Body a(random_shape(i, scale, random), {random.turn(), origin});
        Body b(random_shape(j, other, random), {random.turn(), origin});
        const double size = a.ready.reach() + b.ready.reach() + scale;
        b.pose.translation += random.in(0, 1.3) * size * random.direction();
        if (k % 3 == 2) {
          // To touching, or nearly.
          const SignedDistance first = signed_distance(a.ready, a.pose, b.ready, b.pose);
          const double left = k % 2 == 0 ? 0 : std::pow(10, random.in(-14, -3)) * size;
          b.pose.translation -= (first.value - left * (k % 4 < 2 ? 1 : -1)) * first.normal;
        }
        const SignedDistance result = signed_distance(a.ready, a.pose, b.ready, b.pose);
        expect_proven(a, b, result, random, seen);
        if (HasFailure())
          FAIL() << "kinds " << i << " and " << j << ", " << k << ": value " << result.value
                 << " in [" << result.lower << ", " << result.upper << "]";
      }
  EXPECT_GT(seen.separated, seen.all / 4);
  EXPECT_GT(seen.overlapping, seen.all / 4);
  EXPECT_GT(seen.touching, seen.all / 100);
}

/// The distance of two segments in long double.
double distance_of_segments(const std::array<Vec3<double>, 2>& a,
                            const std::array<Vec3<double>, 2>& b) {
  std::vector<oracle::Column<3>> differences;
  for (const Vec3<double>& p : a)
    for (const Vec3<double>& q : b) differences.push_back(q.cast<Long>() - p.cast<Long>());
  return static_cast<double>(oracle::nearest_to_origin<3>(differences).norm());
}

TEST(SignedDistance, spheres_capsules_and_boxes_have_closed_forms) {
  Random random(7);
  for (int k = 0; k < 20000; ++k) {
    const double size = std::pow(10, random.in(-3, 3));
    const Vec3<double> p = size * random.direction(), q = size * random.direction(),
                       r = size * random.direction() * random.in(0, 2),
                       s = size * random.direction();
    const double r1 = size * random.in(0.01, 1), r2 = size * random.in(0.01, 1);
    const auto round = [](double radius, const Shape<double>& core) {
      return ContactShape(Rounded<double>{radius, Nested<double>(core)});
    };
    const SignedDistance capsules =
        signed_distance(round(r1, Segment<double>{{p, q}}), round(r2, Segment<double>{{r, s}}));
    const double exact = distance_of_segments({p, q}, {r, s}) - r1 - r2;
    ASSERT_NEAR(capsules.value, exact, 1e-14 * 4 * size) << k;
    ASSERT_LE(capsules.lower, exact);
    ASSERT_GE(capsules.upper, exact);

    const SignedDistance balls = signed_distance(
        ContactShape(Transform<double>{Nested<double>(Shape<double>(Sphere<double>{r1})),
                                       Affine<double>{Mat3<double>::Identity(), p}}),
        round(r2, Point<double>{q}));
    ASSERT_NEAR(balls.value, double((q.cast<Long>() - p.cast<Long>()).norm() - Long(r1) - Long(r2)),
                1e-14 * 4 * size);

    const Vec3<double> h = size * Vec3<double>(random.in(0, 1), random.in(0, 1), random.in(0, 1));
    const Vec3<Long> beyond = r.cast<Long>().cwiseAbs() - h.cast<Long>();
    const Long deepest = std::min(beyond.maxCoeff(), Long(0));
    const Vec3<Long> aside = beyond.cwiseMax(Vec3<Long>::Zero());
    const SignedDistance box =
        signed_distance(ContactShape(Box<double>{h}), round(r1, Point<double>{r}));
    ASSERT_NEAR(box.value, double(aside.norm() + deepest - Long(r1)), 1e-14 * 4 * size) << k;
  }
}

TEST(SignedDistance, hulls_are_as_deep_in_each_other_as_the_nearest_facet_of_their_difference) {
  Random random(5);
  int overlapping = 0;
  for (int k = 0; k < 1000; ++k) {
    const bool are_boxes = k % 4 == 0;
    const Body a(are_boxes ? random_shape(5, 1, random) : random.hull(4 + k % 20, 1),
                 {random.turn(), Vec3<double>::Zero()});
    const Body b(are_boxes ? random_shape(5, 1, random) : random.hull(4 + k % 13, 1),
                 {random.turn(), random.in(0, 1) * random.direction()});
    const SignedDistance result = signed_distance(a.ready, a.pose, b.ready, b.pose);
    if (result.status != SignedStatus::overlapping) continue;
    ++overlapping;
    const auto corners = [](const Body& body) {
      std::vector<Vec3<double>> points;
      if (const auto* hull = std::get_if<Hull<double>>(&body.shape.kind)) {
        for (const Vec3<double>& p : hull->points.points()) points.push_back(body.pose(p));
      } else {
        for (int i = 0; i < 8; ++i)
          points.push_back(body.pose(body.shape.support(
              Vec3<double>((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1))));
      }
      return points;
    };
    std::vector<Vec3<double>> differences;
    for (const Vec3<double>& p : corners(a))
      for (const Vec3<double>& q : corners(b)) differences.push_back(q - p);
    const PointCloud<double> difference(differences);
    ASSERT_NE(difference.facets(), nullptr);
    double depth = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < difference.facets()->size(); ++i) {
      const auto& facet = (*difference.facets())[i];
      if (facet.normal().isZero(0)) continue;
      depth = std::min(depth, facet.normal().dot(difference.support(facet.normal())));
    }
    ASSERT_NEAR(result.value, -depth, 1e-13) << k;
    ASSERT_LE(result.upper - result.lower, 1e-9 * (a.ready.reach() + b.ready.reach())) << k;
  }
  EXPECT_GT(overlapping, 500);
}

TEST(SignedDistance, the_order_of_the_two_turns_the_normal_and_nothing_else) {
  Random random(11);
  for (int k = 0; k < 2000; ++k) {
    const Body a(random_shape(k % kinds, 1, random), {random.turn(), Vec3<double>::Zero()});
    const Body b(random_shape(k / kinds % kinds, 1, random),
                 {random.turn(), random.in(0, 3) * random.direction()});
    const SignedDistance one = signed_distance(a.ready, a.pose, b.ready, b.pose),
                         two = signed_distance(b.ready, b.pose, a.ready, a.pose);
    ASSERT_LE(one.lower, two.upper) << k;
    ASSERT_LE(two.lower, one.upper) << k;
    const double size = a.ready.reach() + b.ready.reach();
    ASSERT_NEAR(one.value, two.value, 1e-9 * size + 1e-14) << k;
  }
}

TEST(SignedDistance, early_answers_agree_with_whole_ones) {
  Random random(13);
  int apart = 0, overlapping = 0;
  for (int k = 0; k < 2000; ++k) {
    const Body a(random_shape(k % kinds, 1, random), {random.turn(), Vec3<double>::Zero()});
    const Body b(random_shape(k / kinds % kinds, 1, random),
                 {random.turn(), random.in(0, 3) * random.direction()});
    const SignedDistance whole = signed_distance(a.ready, a.pose, b.ready, b.pose);
    SignedDistanceOptions near;
    near.at_most = 0.3;
    const SignedDistance bounded = signed_distance(a.ready, a.pose, b.ready, b.pose, near);
    if (whole.lower > 0.3 + 1e-9) {
      ++apart;
      ASSERT_GT(bounded.lower, 0.3) << k;
    }
    if (whole.upper < 0.3 - 1e-9) {
      ASSERT_NEAR(bounded.value, whole.value, 1e-9) << k;
    }
    ASSERT_LE(bounded.lower, whole.upper) << k;
    ASSERT_GE(bounded.upper, whole.lower) << k;
    SignedDistanceOptions sign;
    sign.only_sign = true;
    const SignedDistance signs = signed_distance(a.ready, a.pose, b.ready, b.pose, sign);
    if (std::abs(whole.value) > 1e-9) {
      ASSERT_EQ(signs.status, whole.status) << k;
    }
    overlapping += whole.status == SignedStatus::overlapping;
  }
  EXPECT_GT(apart, 300);
  EXPECT_GT(overlapping, 300);
}

TEST(SignedDistance, shapes_in_the_middle_of_each_other_are_as_deep_as_their_thinnest_sum) {
  // Every direction is as good as any other here, or a circle of them is.
  const ContactShape ball(Sphere<double>{2}), inner(Sphere<double>{1});
  EXPECT_NEAR(signed_distance(ball, inner).value, -3, 1e-14);
  const ContactShape rod(Cylinder<double>{1, 5}), thin(Cylinder<double>{0.25, 5});
  SignedDistanceOptions coarse;
  coarse.tolerance = 1e-5;
  const SignedDistance coaxial = signed_distance(rod, {}, thin, {}, coarse);
  EXPECT_NEAR(coaxial.value, -1.25, 1e-4);
  EXPECT_LE(coaxial.lower, -1.25);
  EXPECT_GE(coaxial.upper, -1.25);
  const ContactShape cube(Box<double>{{1, 1, 1}});
  EXPECT_NEAR(signed_distance(cube, cube).value, -2, 1e-14);
}

}  // namespace
}  // namespace minkray
