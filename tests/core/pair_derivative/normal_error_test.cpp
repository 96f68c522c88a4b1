// SPDX-License-Identifier: MIT
// Errors of normals at known points of simple cores.
#include <gtest/gtest.h>

#include "core/pair/contact_shape.h"
#include "core/pair_derivative/normal_error.h"
#include "core/shape/shape.h"

namespace minkray::testing {
namespace {

const Vec3<double> x_axis(1, 0, 0);

double error_at(const Shape& shape, const Vec3<double>& point, const Vec3<double>& n, double off) {
  return normal_error_at(ContactShape(shape).core(), point, n, off);
}

TEST(NormalError, is_what_curvature_and_the_normal_itself_allow) {
  const double off = 1e-9, small = 1e-13;
  EXPECT_NEAR(error_at(Sphere{2}, {2, 0, 0}, x_axis, off), off / 2, small);
  EXPECT_NEAR(error_at(Box{{1, 1, 1}}, {1, 0.2, 0}, x_axis, off), 0, small);
  EXPECT_NEAR(error_at(Cylinder{2, 1}, {2, 0, 0.3}, x_axis, off), off / 2, small);
  EXPECT_NEAR(error_at(Cylinder{2, 1}, {0.5, 0, 1}, {0, 0, 1}, off), 0, small);
  // At the end of the longest axis curvature is a/c^2.
  EXPECT_NEAR(error_at(Ellipsoid{{2, 1, 1}}, {2, 0, 0}, x_axis, off), 2 * off, small);
  const Vec3<double> leaning = Vec3<double>(1, 1e-3, 0).normalized();
  EXPECT_NEAR(error_at(Sphere{2}, {2, 0, 0}, leaning, off), 1e-3, 1e-8);
  EXPECT_NEAR(error_at(Box{{1, 1, 1}}, {1, 0.2, 0}, leaning, off), 1e-3, 1e-8);
}

TEST(NormalError, of_hulls_is_that_of_the_part_below) {
  std::vector<Vec3<double>> corners;
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      for (const double z : {-1.0, 1.0}) corners.emplace_back(x, y, z);
  const Shape hull = Hull{PointCloud(corners)};
  const Shape grown = Rounded{0.5, hull};
  const double off = 1e-9, small = 1e-13;
  EXPECT_NEAR(error_at(hull, {1, 0.2, 0.1}, x_axis, off), 0, small);
  EXPECT_TRUE(std::isinf(error_at(hull, {1, 1, 0.1}, x_axis, off)));
  EXPECT_NEAR(error_at(grown, {1.5, 0.2, 0.1}, x_axis, off), 0, small);
  for (const Vec3<double>& way : {Vec3<double>(1, 1, 1), Vec3<double>(1, 1, 0)}) {
    const Vec3<double> n = way.normalized(), corner(1, 1, way.z() > 0 ? 1 : 0.3);
    EXPECT_NEAR(error_at(grown, corner + 0.5 * n, n, off), 2 * off, small);
  }
}

TEST(NormalError, is_not_known_on_edges) {
  EXPECT_TRUE(std::isinf(error_at(Box{{1, 1, 1}}, {1, 1, 0}, x_axis, 1e-9)));
  EXPECT_TRUE(std::isinf(error_at(Cylinder{2, 1}, {2, 0, 1}, x_axis, 1e-9)));
  EXPECT_TRUE(std::isinf(error_at(Sphere{2}, {2, 0, 0}, x_axis, 3)));
}

}  // namespace
}  // namespace minkray::testing
