// SPDX-License-Identifier: MIT
// The flat sides that disks make, alone, swept and rounded: where they are hit is known.
#include <gtest/gtest.h>

#include "core/cast/cast.h"
#include "tests/support/random.h"

namespace minkray::testing {
namespace {

using S = Shape;

constexpr double radius = 0.7, rounding = 0.2;
const Vec3<double> reach(0.9, 0.4, 0);  ///< half of the segment that the disk is swept along

S turned(S shape, const Mat3<double>& rotation) {
  return Transform{std::move(shape), AffineMap(Affine<double>{rotation, {0, 0, 0}})};
}

/// Distance of (x, y) from the segment from -`half` to `half`.
double beside(const Vec3<double>& x, const Vec3<double>& half) {
  const double length = half.squaredNorm();
  const double share = length > 0 ? std::clamp(x.dot(half) / length, -1.0, 1.0) : 0;
  const Vec3<double> rest = x - half * share;
  return std::hypot(rest.x(), rest.y());
}

/// `shape` has a flat side at the height z that reaches `radius` around the segment.
void check_top(const S& shape, const Vec3<double>& half, double z, double eps) {
  Random random(11);
  for (const bool is_turned : {false, true}) {
    const Mat3<double> rotation = is_turned ? random.rotation() : Mat3<double>::Identity();
    const PreparedShape prepared(turned(shape, rotation));
    int on_top = 0;
    for (int i = 0; i < 2000; ++i) {
      Vec3<double> at = random.in_cube() * 2;
      at.z() = z;
      if (i % 2 == 0) {  // close to the rim
        const double off = beside(at, half);
        at += (at - half * std::clamp(at.dot(half) / std::max(half.squaredNorm(), 1e-9), -1.0, 1.0))
                  .cwiseProduct(Vec3<double>(1, 1, 0)) *
              (radius * (1 + random.uniform(-1e-2, 1e-2)) / off - 1);
      }
      const double inside = radius - beside(at, half);
      if (inside < 1e-4) continue;
      ++on_top;
      Vec3<double> d(random.uniform(-1, 1), random.uniform(-1, 1), -1);
      const Vec3<double> o = at - d * 3;
      const CastResult<double> result =
          cast_ray(prepared, Ray<double>{(rotation * o), (rotation * d)});
      ASSERT_EQ(result.status, Status::hit) << at.transpose();
      ASSERT_NEAR(double(result.t()), 3, eps) << at.transpose();
      ASSERT_NEAR(double(result.normal.dot((rotation * Vec3<double>(0, 0, 1)))), 1, 4 * eps);
    }
    EXPECT_GT(on_top, 500);
  }
}

void check(const S& shape, const Vec3<double>& half, double z) {
  check_top(shape, half, z, 1e-14);
}

const S disk = Disk{radius};
const S segment = Segment{{Vec3<double>(-reach), reach}};

TEST(FlatSides, of_disks) {
  check(disk, Vec3<double>::Zero(), 0);
}

TEST(FlatSides, of_rounded_disks) {
  check(Rounded{rounding, disk}, Vec3<double>::Zero(), rounding);
}

TEST(FlatSides, of_rounded_cylinders) {
  check(Rounded{rounding, S(Cylinder{radius, 1})}, Vec3<double>::Zero(), 1 + rounding);
}

TEST(FlatSides, of_swept_disks) {
  check(MinkowskiSum{{disk, segment}}, reach, 0);
}

TEST(FlatSides, of_swept_and_rounded_disks) {
  check(Rounded{rounding, S(MinkowskiSum{{disk, segment}})}, reach, rounding);
}

TEST(FlatSides, of_disks_swept_by_ellipsoids) {
  check(MinkowskiSum{{disk, segment, S(Ellipsoid{{0.3, 0.2, 0.5}})}}, reach, 0.5);
}

/// Two disks in one plane, but of different sizes: next to the smaller one nothing is hit early.
TEST(FlatSides, of_disks_of_two_sizes) {
  const S shape = Rounded{0.05, S(Frustum{{1, 0.3}, 0.4})};
  const PreparedShape prepared(shape);
  Random random(12);
  for (int i = 0; i < 4000; ++i) {
    const Vec3<double> at(random.uniform(-1.1, 1.1), random.uniform(-1.1, 1.1), 0);
    const CastResult<double> result =
        cast_ray(prepared, Ray<double>{at + Vec3<double>(0, 0, 3), {0, 0, -1}});
    const double off = std::hypot(at.x(), at.y());
    if (off > 1.05) {
      ASSERT_EQ(result.status, Status::miss);
      continue;
    }
    ASSERT_EQ(result.status, Status::hit);
    const double height = 3 - result.t();
    // A flat top, an arc around its rim, the slope that touches both rims' arcs, the lower rim's.
    const Vec3<double> n = Vec3<double>(0.8, 0, 0.7).normalized();
    const double arc_until = 0.3 + 0.05 * n.x(), slope_until = 1 + 0.05 * n.x();
    const double expected = off <= 0.3         ? 0.45
                            : off <= arc_until ? 0.4 + std::sqrt(0.0025 - (off - 0.3) * (off - 0.3))
                            : off <= slope_until
                                ? 0.4 + 0.05 * n.z() - (off - arc_until) * 0.8 / 0.7
                                : -0.4 + std::sqrt(std::max(0.0, 0.0025 - (off - 1) * (off - 1)));
    ASSERT_NEAR(height, expected, 1e-7) << off;
    if (off < 1) {
      ASSERT_NEAR(height, expected, 1e-13) << off;
    }
  }
}

}  // namespace
}  // namespace minkray::testing
