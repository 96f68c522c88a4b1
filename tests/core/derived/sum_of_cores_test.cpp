// SPDX-License-Identifier: MIT
// Sums of two operands as cores: compares their support functions with those of the shapes.
#include "core/derived/sum_of_cores.h"

#include <gtest/gtest.h>

#include "core/pair/core_support.h"
#include "tests/support/random.h"

namespace minkray::testing {
namespace {

Shape turned(const Shape& shape, std::uint64_t seed, const Vec3<double>& by = {0.5, -0.25, 2}) {
  return Transform{shape, AffineMap(Affine<double>{Random(seed).rotation(), by})};
}
Shape scaled(const Shape& shape, const Vec3<double>& scale) {
  return Transform{shape, AffineMap(Affine<double>{Mat3<double>(scale.asDiagonal()), {1, 2, 3}})};
}

/// Support function of a core in the shape's frame, without its middle.
double reach(const CoreAndRadius& of, const Vec3<double>& n) {
  const Vec3<double> d = of.turn.transpose() * n;
  return d.dot(support_of_core<CoreKind::other>(of.core, d).point) + of.core.radius * n.norm();
}

struct Operands {
  const char* name;
  Shape shape;
  CoreKind a, b;  ///< in the order of CoreKind
};

std::vector<Operands> operands() {
  const Shape rod = Cylinder{0.4, 1}, cone = Cone{0.7, 0.5}, box = Box{{0.3, 0.5, 0.2}},
              egg = Ellipsoid{{0.2, 0.6, 0.4}}, ball = Sphere{0.3}, spot = Point{{0.1, 0.7, -2}};
  constexpr auto disks = CoreKind::disks, boxes = CoreKind::box, eggs = CoreKind::ellipsoid;
  return {
      {"sum", MinkowskiSum{{rod, turned(cone, 1)}}, disks, disks},
      {"difference", MinkowskiDifference{turned(cone, 2), turned(box, 3)}, boxes, disks},
      {"balls_and_points", MinkowskiSum{{turned(rod, 4), ball, spot, turned(egg, 5)}}, disks, eggs},
      {"rounded_difference",
       Rounded{0.2, Shape(MinkowskiDifference{cone, turned(Capsule{0.1, 0.5}, 6)})},
       CoreKind::segment, disks},
      {"turned_twice", turned(turned(MinkowskiSum{{turned(cone, 7), box}}, 8), 9), boxes, disks},
      {"stretched_boxes", scaled(MinkowskiSum{{box, Shape(Box{{1, 2, 3}})}}, {2, 0.5, -1}), boxes,
       boxes},
      {"nested_differences",
       MinkowskiDifference{spot, Shape(MinkowskiDifference{turned(cone, 10), turned(egg, 11)})},
       disks, eggs},
      {"one_and_a_ball", Rounded{0.2, turned(cone, 12)}, CoreKind::point, disks},
  };
}

TEST(SumOfCores, has_the_support_function_of_the_shape) {
  for (const Operands& row : operands()) {
    const std::optional<SumOfCores> sum = sum_of_cores(row.shape);
    ASSERT_TRUE(sum) << row.name;
    EXPECT_EQ(sum->a.core.kind, row.a) << row.name;
    EXPECT_EQ(sum->b.core.kind, row.b) << row.name;
    Random random(5);
    for (int i = 0; i < 100; ++i) {
      const Vec3<double> n = random.direction();
      EXPECT_NEAR(n.dot(row.shape.support(n)),
                  n.dot(sum->middle) + reach(sum->a, n) + reach(sum->b, n), 1e-14)
          << row.name;
    }
  }
}

TEST(SumOfCores, is_refused_for_other_shapes) {
  const Shape rod = Cylinder{0.4, 1}, super = Superellipsoid{{1, 1, 1}, 4};
  EXPECT_FALSE(sum_of_cores(rod));
  EXPECT_FALSE(sum_of_cores(HullOf{{rod, turned(rod, 1)}}));
  EXPECT_FALSE(sum_of_cores(MinkowskiSum{{rod, super}}));
  EXPECT_FALSE(sum_of_cores(MinkowskiSum{{rod, turned(rod, 1), turned(rod, 2)}}));
  EXPECT_FALSE(sum_of_cores(scaled(MinkowskiSum{{rod, turned(rod, 1)}}, {1, 2, 3})));
  EXPECT_FALSE(sum_of_cores(MinkowskiSum{{rod}}));
}

}  // namespace
}  // namespace minkray::testing
