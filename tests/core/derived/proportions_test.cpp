// SPDX-License-Identifier: MIT
// Selection of the shapes that count as extreme.
#include "core/derived/proportions.h"

#include <gtest/gtest.h>

#include "tests/support/random.h"
#include "tests/support/sample_shapes.h"

namespace minkray::testing {
namespace {

using P = Vec3<double>;

bool is_extreme(const Shape& shape) {
  return has_extreme_proportions(shape);
}

Shape hull(std::vector<Vec3<double>> points) {
  return Hull{PointCloud(std::move(points))};
}

TEST(Proportions, sample_shapes_are_ordinary) {
  for (const SampleShape& sample : sample_shapes()) {
    EXPECT_FALSE(has_extreme_proportions(sample.shape)) << sample.name;
  }
}

TEST(Proportions, do_not_depend_on_the_size) {
  for (const double size : {1e-30, 1.0, 1e30}) {
    EXPECT_FALSE(is_extreme(Box{Vec3<double>(1, 1, 1e-5) * size})) << size;
    EXPECT_TRUE(is_extreme(Box{Vec3<double>(1, 1, 1e-7) * size})) << size;
  }
}

TEST(Proportions, needles_with_slanted_ends_lie_askew) {
  EXPECT_TRUE(is_extreme(CutCylinder{1e-5, {0, 1}, {0.5, 0}, {5e4, 0}}));
  EXPECT_FALSE(is_extreme(CutCylinder{1e-3, {0, 1}, {0.5, 0}, {0.5, 0}}));
  EXPECT_FALSE(is_extreme(Cylinder{1e-5, 1}));
}

TEST(Proportions, slanted_plates_are_as_thin_as_their_planes_are_apart) {
  const auto plate = [](double apart) {
    return CutCylinder{0.05, {0.2, 0.2 + apart}, {0.7, -0.9}, {0.7, -0.9}};
  };
  EXPECT_TRUE(is_extreme(plate(3e-10)));
  EXPECT_FALSE(is_extreme(plate(1e-3)));
  EXPECT_FALSE(is_extreme(plate(0)));  // an ellipse
  EXPECT_TRUE(is_extreme(CutCylinder{1, {0, 1e-4}, {0, 0.5}, {0, 0.5 + 1e-5}}));
  EXPECT_FALSE(is_extreme(CutCylinder{1, {0, 0.1}, {0, 0}, {0, 0.1}}));  // a wedge
}

/// Half of the least number is rounded to nothing: capsules and cylinders of that radius counted as
/// segments, and were missed by rays that met them.
TEST(Proportions, the_least_number_is_a_length) {
  const double least = std::numeric_limits<double>::denorm_min();
  EXPECT_TRUE(is_extreme(Capsule{least, 0.5}));
  EXPECT_TRUE(is_extreme(Cylinder{least, 0.5}));
  EXPECT_TRUE(is_extreme(Cylinder{1, least}));
  EXPECT_TRUE(is_extreme(CutCylinder{1, {0, least}}));
  EXPECT_TRUE(is_extreme(Box{{1, 2, least}}));
  EXPECT_FALSE(is_extreme(Box{{least, least, least}}));
}

/// Products of such a thickness have few digits: planes through three corners leaned by 3e-4.
TEST(Proportions, what_is_flat_but_for_a_number_without_digits_is_thin) {
  const auto plate = [](double size, double thickness) {
    const double half = thickness / 2;
    return hull({P(size, -half, -size), P(size, half, size), P(-size, -half, size)});
  };
  for (const double size : {1e-20, 1.0, 1e20})
    for (const double thickness : {1e-320, 1e-300}) {
      EXPECT_EQ(is_extreme(plate(size, thickness)), thickness < 1e-292 * size) << size;
      EXPECT_FALSE(is_extreme(plate(size, 0))) << size;
    }
  EXPECT_TRUE(is_extreme(Rounded{1, plate(1, 1e-320)}));
}

TEST(Proportions, what_is_flat_is_not_thin) {
  EXPECT_FALSE(is_extreme(Box{{1, 2, 0}}));
  EXPECT_FALSE(is_extreme(Disk{1}));
  EXPECT_FALSE(is_extreme(Segment{{Vec3<double>(1, 2, 3), Vec3<double>(-4, 5, 0.1)}}));
  EXPECT_FALSE(is_extreme(Point{{1e-9, 1, 1e9}}));
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Vec3<double> a = random.direction(), b = a.unitOrthogonal();
    EXPECT_FALSE(is_extreme(hull({a, b, -a, -b, 0.3 * a + 0.3 * b}))) << i;
  }
}

TEST(Proportions, needles_thinner_than_rounding_are_no_segments) {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const Vec3<double> a = random.direction();
    for (const double thickness : {1e-10, 1e-14}) {
      const Vec3<double> beside = 0.3 * a + thickness * a.unitOrthogonal();
      EXPECT_TRUE(is_extreme(Triangle{{a, -a, beside}})) << i << ": " << thickness;
    }
    EXPECT_FALSE(is_extreme(Triangle{{a, -a, a}})) << i;
  }
  EXPECT_FALSE(is_extreme(Triangle{{P(0, 0, 0), P(1, 2, 3), P(2, 4, 6)}}));
}

/// A shape whose coordinates are coarse compared with it is rounded, not thin.
TEST(Proportions, what_is_far_from_its_frames_origin_is_ordinary) {
  for (const double distance : {1e4, 1e6, 1e8}) {
    const P o(distance, -distance, distance);
    const Shape triangle = Triangle{{o, P(o + P(1, 0, 0)), P(o + P(0, 0.05, 0.3))}};
    EXPECT_FALSE(is_extreme(triangle)) << distance;
  }
}

TEST(Proportions, slivers_are_found_however_they_lie) {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const Mat3<double> turn = random.rotation();
    const auto box = [&](double x, double y, double z) {
      std::vector<Vec3<double>> points;
      for (int corner = 0; corner < 8; ++corner)
        points.push_back(
            turn * Vec3<double>(corner & 1 ? x : -x, corner & 2 ? y : -y, corner & 4 ? z : -z));
      return hull(points);
    };
    EXPECT_TRUE(is_extreme(box(1, 1, 1e-4))) << i;
    EXPECT_TRUE(is_extreme(box(1, 1e-4, 1e-5))) << i;
    EXPECT_FALSE(is_extreme(box(1, 1, 1e-3))) << i;
    const Vec3<double> a = turn.col(0), b = turn.col(1);
    EXPECT_TRUE(is_extreme(Triangle{{a, -a, 1e-4 * b}})) << i;
    EXPECT_FALSE(is_extreme(Triangle{{a, -a, b}})) << i;
  }
}

TEST(Proportions, superellipsoids_with_nearly_sharp_edges_are_extreme) {
  const auto with = [](double exponent) -> Shape { return Superellipsoid{{1, 2, 3}, exponent}; };
  const Shape ball = Sphere{1};
  for (const double beyond : {0x1p-40, 0x1p-20, 0x1p-11}) {
    EXPECT_TRUE(is_extreme(with(1 + beyond)));
    EXPECT_TRUE(is_extreme(Shape(Rounded{1, with(1 + beyond)})));
    EXPECT_TRUE(is_extreme(Shape(MinkowskiSum{{ball, with(1 + beyond)}})));
  }
  for (const double exponent : {1.0, 1.001, 2.0, 1e3}) EXPECT_FALSE(is_extreme(with(exponent)));
}

TEST(Proportions, parts_and_the_maps_around_them_count) {
  const Nested ball = Shape(Sphere{1});
  const auto squeezed = [&](double by) -> Shape {
    return Transform{ball, Affine<double>{Vec3<double>(1, by, 1).asDiagonal(), {0, 0, 0}}};
  };
  EXPECT_FALSE(is_extreme(squeezed(1e-5)));
  EXPECT_TRUE(is_extreme(squeezed(1e-7)));
  EXPECT_TRUE(is_extreme(MinkowskiSum{{ball, squeezed(1e-7)}}));
  EXPECT_TRUE(is_extreme(MinkowskiDifference{ball, Shape(Sphere{1e-7})}));
  EXPECT_TRUE(is_extreme(HullOf{{ball, Shape(Disk{1e17})}}));
  EXPECT_TRUE(is_extreme(Rounded{1e-7, ball}));
  EXPECT_FALSE(is_extreme(Rounded{1e-5, ball}));
  EXPECT_FALSE(is_extreme(Rounded{0.1, squeezed(1e-7)}));
}

}  // namespace
}  // namespace minkray::testing
