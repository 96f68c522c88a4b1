// SPDX-License-Identifier: MIT
#include "core/contact/distance.h"

#include <gtest/gtest.h>

#include <random>

#include "core/derived/convert.h"
#include "tests/oracle/wolfe.h"

namespace minkray {
namespace {

constexpr std::array all_kinds = {SubalgorithmKind::projection, SubalgorithmKind::johnson,
                                  SubalgorithmKind::signed_volumes};

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double in(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Vec3<double> in_cube(double half) { return {in(-half, half), in(-half, half), in(-half, half)}; }
  Affine<double> pose(double spread) {
    return {rotation_matrix(in(-1, 1), in(-1, 1), in(-1, 1), in(-1, 1)), in_cube(spread)};
  }
  std::vector<Vec3<double>> points(int count, bool flat) {
    std::vector<Vec3<double>> result;
    for (int i = 0; i < count; ++i) {
      result.push_back(in_cube(1));
      if (flat) result.back().z() = 0;
    }
    return result;
  }

 private:
  std::mt19937 engine_;
};

template <int Dim>
double wolfe_distance(const std::vector<Vec3<double>>& a, const std::vector<Vec3<double>>& b,
                      const Vec3<double>& shift) {
  std::vector<oracle::Column<Dim>> differences;
  for (const Vec3<double>& p : a)
    for (const Vec3<double>& q : b) {
      const oracle::Column<3> d =
          p.cast<long double>() - q.cast<long double>() - shift.cast<long double>();
      differences.push_back(d.template head<Dim>());
    }
  return static_cast<double>(oracle::nearest_to_origin<Dim>(differences).norm());
}

template <class T>
CentredShape<T> place(const Shape<double>& shape, const Affine<double>& pose = {}) {
  return centred<T>(convert<T>(shape), pose.template cast<T>());
}

Affine<double> at(double x, double y, double z) {
  return {Mat3<double>::Identity(), Vec3<double>(x, y, z)};
}

/// The answer proves itself: the points are in the shapes' slabs, the planes between them.
template <int Dim, class T>
void expect_certified(const CentredShape<T>& a, const CentredShape<T>& b,
                      const DistanceResult<T, Dim>& result, T size) {
  const T rounding = T(64) * tolerance::epsilon<T> * size;
  if (result.status != DistanceStatus::separated) return;
  Vec3<T> axis = Vec3<T>::Zero();
  axis.template head<Dim>() = result.axis;
  const T top_of_a = axis.dot(a.about_centre.support(axis) + a.centre);
  const T foot_of_b = axis.dot(b.about_centre.support(Vec3<T>(-axis)) + b.centre);
  EXPECT_GE(foot_of_b - top_of_a, result.lower - rounding);
  EXPECT_NEAR((result.point_b - result.point_a).norm(), result.distance, rounding);
  EXPECT_LE(result.distance - result.lower, rounding);
  EXPECT_LE(result.axis.dot(result.point_a), top_of_a + rounding);
  EXPECT_GE(result.axis.dot(result.point_b), foot_of_b - rounding);
}

// Johnson's determinants lose digits on slivers; what remains is measured by `minkray paper`.
double slack(SubalgorithmKind kind) {
  return kind == SubalgorithmKind::johnson ? 1e-9 : 1e-14;
}

TEST(Distance, of_random_hulls_is_that_of_wolfes_method) {
  Random random(1);
  int overlapping = 0;
  constexpr int pairs = 400;
  for (int i = 0; i < pairs; ++i) {
    const auto a = random.points(12, false), b = random.points(9, false);
    const Vec3<double> shift = random.in_cube(1.6);
    const double expected = wolfe_distance<3>(a, b, shift);
    const auto A = place<double>(Hull<double>{PointCloud<double>(a)});
    const auto B =
        place<double>(Hull<double>{PointCloud<double>(b)}, {Mat3<double>::Identity(), shift});
    for (const SubalgorithmKind kind : all_kinds) {
      const DistanceResult<double, 3> result = distance_between(A, B, {}, kind);
      EXPECT_NE(result.status, DistanceStatus::exhausted) << i;
      EXPECT_NEAR(result.distance, expected, 4 * slack(kind)) << i << " " << int(kind);
    }
    expect_certified(A, B, distance_between(A, B), 4.0);
    const auto in_float = distance_between(
        place<float>(Hull<double>{PointCloud<double>(a)}),
        place<float>(Hull<double>{PointCloud<double>(b)}, {Mat3<double>::Identity(), shift}));
    EXPECT_NEAR(in_float.distance, expected, 4e-6) << i;
    overlapping += expected < 1e-12;
  }
  EXPECT_GT(overlapping, pairs * 3 / 10);
  EXPECT_LT(overlapping, pairs * 7 / 10);
}

TEST(Distance, in_the_plane_is_wolfes_and_that_of_flat_shapes_in_space) {
  Random random(2);
  int overlapping = 0;
  constexpr int pairs = 400;
  for (int i = 0; i < pairs; ++i) {
    const auto a = random.points(7, true), b = random.points(5, true);
    Vec3<double> shift = random.in_cube(1.8);
    shift.z() = 0;
    const double expected = wolfe_distance<2>(a, b, shift);
    const auto A = place<double>(Hull<double>{PointCloud<double>(a)});
    const auto B =
        place<double>(Hull<double>{PointCloud<double>(b)}, {Mat3<double>::Identity(), shift});
    for (const SubalgorithmKind kind : all_kinds)
      EXPECT_NEAR(distance_in_plane(A, B, {}, kind).distance, expected, 4 * slack(kind)) << i;
    EXPECT_NEAR(distance_between(A, B).distance, expected, 1e-13) << i;
    expect_certified(A, B, distance_in_plane(A, B), 4.0);
    overlapping += expected < 1e-12;
  }
  EXPECT_GT(overlapping, pairs * 3 / 10);
  EXPECT_LT(overlapping, pairs * 7 / 10);
}

TEST(Distance, has_the_closed_form_of_balls_boxes_and_capsules) {
  Random random(3);
  for (int i = 0; i < 300; ++i) {
    const Vec3<double> h = random.in_cube(1).cwiseAbs() + Vec3<double>::Constant(0.1);
    const Vec3<double> g = random.in_cube(1).cwiseAbs() + Vec3<double>::Constant(0.1);
    const Vec3<double> c = random.in_cube(5);
    const double r = random.in(0.1, 1), q = random.in(0.1, 1);
    const auto check = [&](const Shape<double>& a, const Shape<double>& b, double expected) {
      const auto A = place<double>(a), B = place<double>(b, {Mat3<double>::Identity(), c});
      const auto result = distance_between(A, B);
      EXPECT_NEAR(result.distance, std::max(expected, 0.0), 4e-14) << i;
      expect_certified(A, B, result, 10.0);
      EXPECT_NEAR(distance_between(place<float>(a), place<float>(b, {Mat3<double>::Identity(), c}))
                      .distance,
                  std::max(expected, 0.0), 1e-5)
          << i;
    };
    const Vec3<double> zero = Vec3<double>::Zero();
    check(Sphere<double>{r}, Sphere<double>{q}, c.norm() - r - q);
    check(Box<double>{h}, Box<double>{g}, (c.cwiseAbs() - h - g).cwiseMax(zero).norm());
    check(Box<double>{h}, Sphere<double>{q}, (c.cwiseAbs() - h).cwiseMax(zero).norm() - q);
    const Vec3<double> from_axis(c.x(), c.y(), std::max(std::abs(c.z()) - h.z() - g.z(), 0.0));
    check(Capsule<double>{r, h.z()}, Capsule<double>{q, g.z()}, from_axis.norm() - r - q);
  }
}

TEST(Distance, of_deep_overlap_is_zero_and_says_so) {
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    const Affine<double> pose = random.pose(0.3);
    const auto ball = place<double>(Ellipsoid<double>{{1, 0.7, 0.5}}, pose);
    const auto box = place<double>(Box<double>{{1, 2, 0.5}});
    for (const SubalgorithmKind kind : all_kinds) {
      const auto result = distance_between(box, ball, {}, kind);
      EXPECT_EQ(result.status, DistanceStatus::overlapping) << i;
      EXPECT_EQ(result.distance, 0.0);
      EXPECT_EQ(result.certificate, 0.0);
      // The point that it names is common to both.
      EXPECT_NEAR((result.point_a - result.point_b).norm(), 0.0, 1e-12);
      EXPECT_TRUE(
          (result.point_a.cwiseAbs().array() <= Vec3<double>(1, 2, 0.5).array() + 1e-12).all());
      const Vec3<double> local = pose.inverse()(result.point_b);
      EXPECT_LE(local.cwiseQuotient(Vec3<double>(1, 0.7, 0.5)).norm(), 1 + 1e-12);
    }
  }
}

TEST(Distance, does_not_depend_on_where_in_the_world_the_two_are) {
  const Shape<double> cone = Cone<double>{0.5, 1}, box = Box<double>{{0.25, 0.5, 1}};
  const double near =
      distance_between(place<double>(cone), place<double>(box, at(2, 0.5, 1))).distance;
  const double far = distance_between(place<double>(cone, at(1048576, -2097152, 4194304)),
                                      place<double>(box, at(1048578, -2097151.5, 4194305)))
                         .distance;
  EXPECT_EQ(near, far);
}

TEST(Distance, scales_with_the_world) {
  Random random(5);
  for (const double scale : {1e-6, 1e-3, 1e3, 1e6}) {
    for (int i = 0; i < 40; ++i) {
      Affine<double> pose = random.pose(2);
      const Shape<double> cylinder = Cylinder<double>{1, 0.5}, cone = Cone<double>{0.5, 1};
      const auto unit_sized = distance_between(place<double>(cylinder), place<double>(cone, pose));
      pose.linear *= scale;
      pose.translation *= scale;
      const Affine<double> scaled{Mat3<double>::Identity() * scale, Vec3<double>::Zero()};
      const auto result =
          distance_between(place<double>(cylinder, scaled), place<double>(cone, pose));
      EXPECT_EQ(result.status, unit_sized.status);
      EXPECT_NEAR(result.distance / scale, unit_sized.distance, 1e-13);
    }
  }
}

/// Squares of lengths beyond the range of numbers made overlaps of shapes far apart.
template <class T>
void expect_scales_to(int least_power, int greatest_power) {
  for (int power = least_power; power <= greatest_power; ++power) {
    const T size = static_cast<T>(std::pow(10.0, power));
    const Affine<T> far{Mat3<T>::Identity(), {T(0), T(4) * size, T(0)}};
    const Shape<T> ball = Sphere<T>{size}, box = Box<T>{Vec3<T>::Constant(size)};
    for (const auto& [a, b] : {std::pair(ball, ball), std::pair(ball, box), std::pair(box, box)}) {
      const auto result = distance_between(centred<T>(a), centred<T>(b, far));
      ASSERT_EQ(name_of(result.status), name_of(DistanceStatus::separated)) << power;
      ASSERT_NEAR(double(result.distance / size), 2, 1e-5) << power;
      ASSERT_NEAR(double(result.point_b.y() / size), 3, 1e-5) << power;
      const Affine<T> near{Mat3<T>::Identity(), {T(0), size, T(0)}};
      ASSERT_EQ(name_of(distance_between(centred<T>(a), centred<T>(b, near)).status),
                name_of(DistanceStatus::overlapping))
          << power;
    }
  }
}

TEST(Distance, scales_to_the_ends_of_the_number_range) {
  expect_scales_to<float>(-30, 36);
  expect_scales_to<double>(-290, 300);
  const auto none = distance_between(
      centred<float>(Sphere<float>{1}),
      centred<float>(Sphere<float>{1},
                     {Mat3<float>::Identity(), {std::numeric_limits<float>::infinity(), 0, 0}}));
  EXPECT_EQ(none.status, DistanceStatus::exhausted);
}

/// Simplices on curved surfaces are slivers, with which the loop ended 1e-7 too early in double,
/// and 2e-3 in float. The bounds here are what more digits for the simplices leave.
template <class T>
void expect_precise(double allowed) {
  const auto error = [](const Shape<double>& a, const Shape<double>& b, const Vec3<double>& offset,
                        double exact) {
    const auto result =
        distance_between(centred<T>(convert<T>(a)),
                         centred<T>(convert<T>(b), {Mat3<T>::Identity(), offset.cast<T>()}));
    EXPECT_EQ(name_of(result.status), name_of(DistanceStatus::separated));
    EXPECT_LE(double(result.lower), exact * (1 + 4 * double(std::numeric_limits<T>::epsilon())));
    return std::abs(double(result.distance) - exact) / exact;
  };
  const Shape<double> triangle =
      Triangle<double>{{Vec3<double>(0, 0, 0), Vec3<double>(0.5, 0, 0), Vec3<double>(0, 0.5, 0)}};
  EXPECT_LE(error(Disk<double>{1}, Box<double>{{1, 1, 1}}, {1, 3, 0}, 1), allowed);
  EXPECT_LE(error(Sphere<double>{3}, Box<double>{{1, 1, 2}}, {-1, 4, 4}, std::sqrt(13.0) - 3),
            allowed);
  EXPECT_LE(error(triangle, Cylinder<double>{2, 3}, {0, 3, 3}, 0.5), allowed);
}

TEST(Distance, of_curved_shapes_is_precise) {
  expect_precise<float>(4e-6);  // a few epsilon of sizes eight times the distance
  expect_precise<double>(5e-9);
}

/// The rim of a cone's base touches a box's side.
TEST(Distance, of_a_touching_rim_is_overlap) {
  const auto result = distance_between(
      centred<double>(Box<double>{{3, 1, 1}}),
      centred<double>(Cone<double>{1, 3}, {Mat3<double>::Identity(), Vec3<double>(4, 0, 2)}));
  EXPECT_EQ(name_of(result.status), name_of(DistanceStatus::overlapping));
}

TEST(Distance, of_touching_boxes_is_zero_and_of_barely_parted_ones_the_gap) {
  const auto box = place<double>(Box<double>{{1, 1, 1}});
  EXPECT_EQ(distance_between(box, place<double>(Box<double>{{1, 1, 1}}, at(2, 0.5, 0.25))).status,
            DistanceStatus::overlapping);
  for (const double gap : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const auto result =
        distance_between(box, place<double>(Box<double>{{1, 1, 1}}, at(2 + gap, 0.5, 0.25)));
    EXPECT_EQ(result.status, DistanceStatus::separated) << gap;
    EXPECT_NEAR(result.distance, gap, 4e-16) << gap;
    EXPECT_NEAR(result.axis.x(), 1.0, 1e-12) << gap;
  }
}

TEST(Distance, begun_with_the_answers_axis_ends_at_once_and_separation_needs_one_support) {
  const auto box = place<double>(Box<double>{{1, 2, 3}});
  const auto cone =
      place<double>(Cone<double>{1, 1}, {rotation_matrix(0.1, 0.2, 0.3, 1.0), {3, 3, 4}});
  const auto cold = distance_between(box, cone);
  DistanceOptions<double, 3> options;
  options.v0 = cold.axis;
  const auto warm = distance_between(box, cone, options);
  EXPECT_LT(warm.iterations, cold.iterations);
  EXPECT_NEAR(warm.distance, cold.distance, 1e-14);
  options.only_separation = true;
  const auto separation = distance_between(box, cone, options);
  EXPECT_EQ(separation.status, DistanceStatus::separated);
  EXPECT_EQ(separation.iterations, 1);
}

template <class T>
class Subalgorithms : public ::testing::Test {};
using Kinds =
    ::testing::Types<JohnsonSubalgorithm<double, 3>, SignedVolumesSubalgorithm<double, 3>,
                     ProjectionSubalgorithm<double, 3>, JohnsonSubalgorithm<double, 2>,
                     SignedVolumesSubalgorithm<double, 2>, ProjectionSubalgorithm<double, 2>>;
TYPED_TEST_SUITE(Subalgorithms, Kinds);

TYPED_TEST(Subalgorithms, find_wolfes_point_of_random_simplices_and_after_translations) {
  constexpr int Dim = TypeParam::dimension;
  using Point = Vec<double, Dim>;
  std::mt19937 engine(6);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  const auto point = [&] {
    Point p;
    for (int i = 0; i < Dim; ++i) p[i] = coordinate(engine);
    return p;
  };
  int full = 0;
  for (int run = 0; run < 2000; ++run) {
    TypeParam simplex;
    const Point first = 0.5 * point();
    simplex.begin(first);
    std::vector<Point> vertices;
    const int size = 1 + run % (Dim + 1);
    for (int i = 0; i < size; ++i) {
      vertices.push_back(point());
      simplex.add(vertices.back());
    }
    for (const Point& x : {first, Point(0.5 * point())}) {
      simplex.move(x);
      std::vector<oracle::Column<Dim>> y;
      for (const Point& p : vertices) y.push_back((x - p).template cast<long double>());
      const Point expected = oracle::nearest_to_origin<Dim>(y).template cast<double>();
      const SubalgorithmAnswer<double, Dim> answer = simplex.closest();
      EXPECT_LT((answer.v - expected).norm(), 1e-10) << run;
      Point sum = Point::Zero();
      double weights = 0;
      for (int i = 0; i <= Dim; ++i) {
        const double weight = answer.weights[static_cast<std::size_t>(i)];
        EXPECT_EQ(weight > 0, ((answer.kept >> i) & 1u) == 1u);
        if (weight > 0) sum += weight * simplex.y(i);
        weights += weight;
      }
      EXPECT_NEAR(weights, 1, 1e-12);
      EXPECT_LT((sum - expected).norm(), 1e-10) << run;
      full += answer.kept == TypeParam::all_slots;
    }
  }
  EXPECT_GT(full, 40);
}

TYPED_TEST(Subalgorithms, answer_degenerate_simplices_with_a_point_of_them) {
  constexpr int Dim = TypeParam::dimension;
  using Point = Vec<double, Dim>;
  // Collinear and nearly coincident vertices, the origin beside them: the distance is 1.
  for (const double spread : {1.0, 1e-4, 1e-8}) {
    TypeParam simplex;
    simplex.begin(Point::Zero());
    for (int i = 0; i <= Dim; ++i) {
      Point p = Point::Zero();
      p[0] = 1;
      p[1] = spread * (i - 0.75);
      simplex.add(p);
    }
    EXPECT_NEAR(simplex.closest().v.norm(), 1.0, 1e-12) << spread;
  }
}

TEST(Johnson, discarded_vertices_free_their_slots_and_the_cache_forgets_them) {
  JohnsonSubalgorithm<double, 3> kept, fresh;
  const Vec3<double> x(0.1, 0.2, 0.3);
  const std::array<Vec3<double>, 5> p = {
      Vec3<double>(1, 0, 0), {0, 1, 0.5}, {-1, 0.25, 0}, {0.3, -1, 2}, {0.5, 0.5, -1}};
  kept.begin(x);
  for (std::size_t i = 0; i < 4; ++i) kept.add(p[i]);
  kept.keep(0b1010);
  kept.add(p[4]);
  fresh.begin(x);
  for (const std::size_t i : {4u, 1u, 3u}) fresh.add(p[i]);
  EXPECT_EQ((kept.closest().v - fresh.closest().v).norm(), 0.0);
}

}  // namespace
}  // namespace minkray
