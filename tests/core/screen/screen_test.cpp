// SPDX-License-Identifier: MIT
// Results of float lanes for rays and shapes hold for the casts at them: where lanes report a
// miss, no cast meets; where they report an interval, casts meet within it.
#include "core/screen/screen.h"

#include <gtest/gtest.h>

#include <random>

#include "core/bvh/traverse.h"
#include "core/cast/cast.h"
#include "core/derived/shape_bounds.h"
#include "core/exact/box.h"

namespace minkray {
namespace {

class ScreenOf : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!has_avx2()) GTEST_SKIP() << "the lanes need AVX2";
  }

  double within(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Vec3<double> point(double size) {
    return {within(-size, size), within(-size, size), within(-size, size)};
  }
  /// Turned and moved; stretched and sheared where `is_affine`.
  Affine<double> pose(double size, double away, bool is_affine) {
    const Vec3<double> axis = point(1);
    Mat3<double> linear = rotation_matrix(axis.x(), axis.y(), axis.z(), within(-1, 1));
    if (is_affine)
      linear *= Vec3<double>(1, within(0.3, 3), within(0.3, 3)).asDiagonal() *
                rotation_matrix(axis.y(), axis.z(), axis.x(), within(-1, 1));
    return {(linear * size).cast<double>(), point(away).cast<double>()};
  }

  std::mt19937 random_{11};
};

struct Seen {
  int pairs = 0, misses = 0, sure = 0, wrong = 0;
};

InstancePlace place_of(const PreparedShape& shape, std::uint32_t body) {
  InstancePlace place;
  const Mat3<double> map =
      shape.linear_to_inner() ? *shape.linear_to_inner() : Mat3<double>::Identity();
  for (int axis = 0; axis < 3; ++axis) place.origin[axis] = shape.centre()[axis];
  for (int k = 0; k < 9; ++k) place.to_inner[k] = static_cast<float>(map.data()[k]);
  place.body = body;
  return place;
}

/// A pair in each lane, each of its own sizes, and the result of a cast.
void compare(const std::vector<PreparedShape>& shapes, const std::vector<Ray<double>>& rays,
             Seen& seen) {
  std::vector<InstancePlace> places;
  std::vector<Screen> screens;
  std::array<float, screen_lanes> limits;
  std::array<std::uint32_t, screen_lanes> number;
  for (std::uint32_t i = 0; i < screen_lanes; ++i) {
    screens.push_back(screen_of(shapes[i].definition(), Vec3<double>::Zero()));
    screens.back().first_equal = i;
    places.push_back(place_of(shapes[i], i));
    limits[i] = std::numeric_limits<float>::infinity();
    number[i] = i;
  }
  std::vector<Ray<double>> padded(rays);
  padded.push_back(rays[0]);  // one number is read beyond the last ray
  Screened answers;
  screen_avx2(screens[0].kind,
              {reinterpret_cast<const char*>(padded.data()), sizeof(Ray<double>), places.data(),
               screens.data(), limits.data()},
              number.data(), number.data(), screen_lanes, answers);
  for (std::size_t i = 0; i < screen_lanes; ++i) {
    const CastResult<double> cast = cast_ray(shapes[i], rays[i]);
    const auto t = static_cast<double>(cast.t());
    const double first = static_cast<double>(answers.first[i]),
                 last = static_cast<double>(answers.last[i]);
    ++seen.pairs;
    const bool misses = std::isinf(first), sure = screens[i].is_whole && std::isfinite(last);
    seen.misses += misses ? 1 : 0;
    seen.sure += sure ? 1 : 0;
    const bool in_range = rays[i].t_max >= double(last);
    const bool is_wrong = (cast.found() && !(first <= t)) ||
                          (sure && in_range && !(cast.found() && t <= last)) || std::isnan(first) ||
                          std::isnan(last);
    seen.wrong += is_wrong ? 1 : 0;
    EXPECT_FALSE(is_wrong) << "cast " << static_cast<int>(cast.status) << " at " << t << ", lanes "
                           << first << " to " << last;
  }
}

/// Shapes of one kind, with sizes drawn at random.
std::vector<std::function<Shape(const std::function<double()>&)>> kinds() {
  using Size = std::function<double()>;
  return {
      [](const Size& s) { return Shape(Sphere{s()}); },
      [](const Size& s) {
        return Shape(Ellipsoid{{s(), s(), s()}});
      },
      [](const Size& s) {
        return Shape(Box{{s(), s(), s()}});
      },
      [](const Size& s) {
        return Shape(Rounded{s() / 3, Shape(Box{{s(), s(), s()}})});
      },
      [](const Size& s) {
        return Shape(Capsule{s(), s()});
      },
      [](const Size& s) {
        return Shape(TaperedCapsule{s(), s(), 2 + s()});
      },
      [](const Size& s) {
        return Shape(Cylinder{s(), s()});
      },
      [](const Size& s) {
        return Shape(Cone{s(), s()});
      },
      [](const Size& s) {
        return Shape(Frustum{1 + s(), s() / 4, s()});
      },
  };
}

TEST_F(ScreenOf, says_of_casts_at_all_kinds_what_they_answer) {
  for (const auto& kind : kinds()) {
    Seen seen;
    for (int round = 0; round < 3000; ++round) {
      const double scale = std::exp2(within(-9, 9)), away = within(0, 1) < 0.3 ? 300 : 3;
      std::vector<PreparedShape> shapes;
      std::vector<Ray<double>> rays;
      FormKind first = FormKind::none;
      while (shapes.size() < screen_lanes) {
        const Shape shape = kind([&] { return static_cast<double>(std::exp2(within(-2, 1))); });
        const Affine<double> pose = this->pose(scale, away * scale, round % 3 == 0);
        PreparedShape prepared(shape, pose);
        const Screen screen = screen_of(prepared.definition(), Vec3<double>::Zero());
        if (!shapes.empty() && screen.kind != first) continue;  // a frustum with ends alike
        first = screen.kind;
        const Vec3<double> centre = prepared.centre().cast<double>();
        // Some go by the edge, some begin within, some lie in a plane of the axes.
        Vec3<double> from = centre + point(away * scale);
        const Vec3<double> aim = centre + point(1.2 * scale);
        if (round % 7 == 0) from = centre + point(0.3 * scale);
        Vec3<double> direction = (aim - from) * std::exp2(within(-3, 3)) / scale;
        if (round % 5 == 0) direction[round % 3] = 0;
        Ray<double> ray{from.cast<double>(), direction.cast<double>()};
        if (ray.direction.isZero(0)) continue;
        if (round % 11 == 0) ray.t_max = static_cast<double>(within(0, 2));
        shapes.push_back(std::move(prepared));
        rays.push_back(ray);
      }
      compare(shapes, rays, seen);
    }
    EXPECT_EQ(seen.wrong, 0);
    EXPECT_GT(seen.misses, seen.pairs / 20);
    EXPECT_GT(seen.sure, seen.pairs / 20);
  }
}

TEST_F(ScreenOf, is_seldom_undecided) {
  const PreparedShape shape{Shape(Rounded{0.1, Shape(Box{{0.5, 0.3, 0.2}})})};
  const std::vector<PreparedShape> shapes(screen_lanes, shape);
  Seen seen;
  for (int round = 0; round < 2000; ++round) {
    std::vector<Ray<double>> rays;
    for (int i = 0; i < screen_lanes; ++i) {
      const Vec3<double> from = unit<double>(point(1)) * 50.0, aim = point(0.7);
      rays.push_back({from.cast<double>(), (aim - from).cast<double>()});
    }
    compare(shapes, rays, seen);
  }
  EXPECT_EQ(seen.wrong, 0);
  EXPECT_LT(seen.pairs - seen.misses - seen.sure, seen.pairs / 500);
}

TEST_F(ScreenOf, shapes_without_a_form_have_a_box_around_them) {
  const Shape sum = MinkowskiSum{{Shape(Ellipsoid{{0.4, 0.3, 0.2}}), Shape(Cone{0.3, 0.5})}};
  const std::vector<PreparedShape> shapes(screen_lanes, PreparedShape{sum});
  const Screen screen = screen_of(shapes[0].definition(), Vec3<double>::Zero());
  EXPECT_EQ(screen.kind, exact::BoxForm::kind);
  EXPECT_FALSE(screen.is_whole);
  Seen seen;
  for (int round = 0; round < 2000; ++round) {
    std::vector<Ray<double>> rays;
    for (int i = 0; i < screen_lanes; ++i) {
      const Vec3<double> from = unit<double>(point(1)) * 5.0, aim = point(1);
      rays.push_back({from.cast<double>(), (aim - from).cast<double>()});
    }
    compare(shapes, rays, seen);
  }
  EXPECT_EQ(seen.wrong, 0);
  EXPECT_GT(seen.misses, seen.pairs / 20);
}

/// Result of the lanes for one pair.
struct Said {
  double first, last;
  bool misses() const { return std::isinf(first); }
  bool is_sure() const { return std::isfinite(last); }
  bool is_undecided() const { return first == 0 && !is_sure(); }
};

Said said_of(const Shape& shape, const Ray<double>& ray) {
  const PreparedShape prepared{shape};
  const Screen screen = screen_of(prepared.definition(), Vec3<double>::Zero());
  const InstancePlace place = place_of(prepared, 0);
  const std::array<Ray<double>, 2> rays = {ray, ray};
  const float limit = std::numeric_limits<float>::infinity();
  const std::array<std::uint32_t, screen_lanes> first = {};
  Screened answers;
  screen_avx2(
      screen.kind,
      {reinterpret_cast<const char*>(rays.data()), sizeof(Ray<double>), &place, &screen, &limit},
      first.data(), first.data(), 1, answers);
  return {static_cast<double>(answers.first[0]), static_cast<double>(answers.last[0])};
}

class ScreenBounds : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!has_avx2()) GTEST_SKIP() << "the lanes need AVX2";
  }
};

// A ball of radius 1 is known to E = 2^-19 * (3 sqrt(2) + 1) = 1e-5, and rays are decided that pass
// its surface by more than 2 E (docs/forms.md, section 13).
TEST_F(ScreenBounds, rays_are_undecided_that_pass_by_less_than_rounding) {
  const Shape ball = Sphere{1};
  const auto beside = [&](double distance) {
    return said_of(ball, {{-3, 1 + distance, 0}, {1, 0, 0}});
  };
  EXPECT_TRUE(beside(1.2e-5).is_undecided());
  EXPECT_TRUE(beside(-1.2e-5).is_undecided());
  EXPECT_TRUE(beside(6e-5).misses());
  EXPECT_TRUE(beside(-6e-5).is_sure());
}

// E of this box is 8e-6: 1/30 of the one radius, 1/270 of the other.
TEST_F(ScreenBounds, radii_that_rounding_nearly_reaches_are_undecided) {
  const auto at_edge = [](double radius) {
    const Shape box = Rounded{radius, Shape(Box{{0.5, 0.5, 0.5}})};
    return said_of(box, {{-3, 0.1, 0.2}, {1, 0.01, 0.02}});
  };
  EXPECT_TRUE(at_edge(2.5e-4).is_undecided());
  EXPECT_TRUE(at_edge(2.2e-3).is_sure());
}

// t is a sum of floats.
TEST_F(ScreenBounds, parameters_are_known_to_their_own_rounding) {
  const double t = 1e4;
  const Said said = said_of(Sphere{0.01}, {{-t, 0, 0}, {1, 0, 0}});
  ASSERT_TRUE(said.is_sure());
  EXPECT_GT(said.last - said.first, 0x1p-23 * t);
  EXPECT_LT(said.last - said.first, 3e-6 * t);
}

// Squares of numbers beyond would leave float's range.
TEST_F(ScreenBounds, directions_of_unusual_length_and_shapes_of_unusual_size_are_undecided) {
  const auto along = [](double length) {
    return said_of(Sphere{1}, {{-3, 0.1, 0}, {length, 0, 0}});
  };
  EXPECT_TRUE(along(0.7e-4).is_undecided());
  EXPECT_TRUE(along(1.5e-4).is_sure());
  EXPECT_TRUE(along(0.7e4).is_sure());
  EXPECT_TRUE(along(1.5e4).is_undecided());
  const auto kind = [](double radius) {
    return screen_of(ShapeDefinition(Shape(Sphere{radius})), Vec3<double>::Zero()).kind;
  };
  EXPECT_EQ(kind(0.7e-7), FormKind::none);
  EXPECT_EQ(kind(1.5e-7), exact::BallForm::kind);
  EXPECT_EQ(kind(0.7e7), exact::BallForm::kind);
  EXPECT_EQ(kind(1.5e7), FormKind::none);
}

// Solvers may take a ray for a hit that passes by as much as they tolerate.
TEST_F(ScreenBounds, boxes_around_shapes_without_a_form_are_a_little_wider) {
  const Shape sum = MinkowskiSum{{Shape(Ellipsoid{{0.4, 0.3, 0.2}}), Shape(Cone{0.3, 0.5})}};
  const double edge = bounds_of(sum).upper.x(), R = ShapeDefinition(sum).inner_ball().radius;
  const auto beside = [&](double share) {
    return said_of(sum, {{edge + share * R, 0, -3}, {0, 0, 1}});
  };
  EXPECT_FALSE(beside(0.6e-4).misses());
  EXPECT_TRUE(beside(3e-4).misses());
}

}  // namespace
}  // namespace minkray
