// SPDX-License-Identifier: MIT
// A shape that a program gives by its support function alone, the cylinder of FCL's issue 642, cut
// by two oblique planes: Embree agrees with its casts, and every result is certified.
#include <gtest/gtest.h>

#include <cmath>

#include "core/proof/certificate.h"
#include "core/proof/check_certificate.h"
#include "renderer/compare/sandwich_check.h"
#include "tests/support/random.h"

namespace minkray::testing {
namespace {

/// x^2 + y^2 <= 0.49 between the planes z = -0.5 + 0.2 x - 0.3 y and z = 0.6 - 0.5 x + 0.4 y.
class CutCylinderSupport final : public SupportSource {
  void support(std::size_t count, const Coordinates* directions,
               Coordinates* points) const override {
    for (std::size_t i = 0; i < count; ++i) {
      const Coordinates& n = directions[i];
      const auto rim = [&](double height, double slope_x, double slope_y) -> Coordinates {
        constexpr double radius = 0.7;
        const double x = n[0] + n[2] * slope_x, y = n[1] + n[2] * slope_y;
        const double length = std::hypot(x, y);
        const double px = length > 0 ? radius * x / length : radius;
        const double py = length > 0 ? radius * y / length : 0;
        return {px, py, height + slope_x * px + slope_y * py};
      };
      const Coordinates lower = rim(-0.5, 0.2, -0.3), upper = rim(0.6, -0.5, 0.4);
      const auto along = [&](const Coordinates& p) {
        return n[0] * p[0] + n[1] * p[1] + n[2] * p[2];
      };
      points[i] = along(upper) > along(lower) ? upper : lower;
    }
  }
};

const Shape cut_cylinder = Custom{std::make_shared<const CutCylinderSupport>()};
constexpr int ray_count = 100000;

TEST(CustomShapeSandwich, holds_for_a_cylinder_that_is_cut_obliquely) {
  CompareOptions options;
  options.rays = ray_count;
  const CompareReport report = compare_with_embree(cut_cylinder, options);
  EXPECT_EQ(report.total_violations(), 0);
  EXPECT_GT(report.inner_triangles, 1000u);
  EXPECT_GT(report.hit_rate(), 0.3);
  EXPECT_LT(report.hit_rate(), 0.7);
}

TEST(CustomShapeSandwich, certifies_every_answer) {
  const SandwichedShape sandwiched(cut_cylinder);
  const SupportFunction support = supports_of(cut_cylinder);
  Random random(642);
  int hits = 0, violations = 0, unproven = 0;
  for (int i = 0; i < ray_count; ++i) {
    const Vec3<float> origin = (3 * random.direction()).cast<float>();
    const Vec3<float> target = (0.9 * random.in_cube()).cast<float>();
    const Ray<float> ray{origin, (target - origin).normalized()};
    const Verdict verdict = sandwiched.judge(ray);
    hits += verdict.result.found();
    violations += verdict.violation.has_value();
    const Ray<double> asked = sandwiched.to_shape(ray);
    const Claim claim = claim_of(verdict.result);
    unproven += !check_certificate(support, asked, claim, certify(support, asked, claim)).holds;
  }
  EXPECT_EQ(violations, 0);
  EXPECT_EQ(unproven, 0);
  EXPECT_GT(hits, ray_count * 3 / 10);
  EXPECT_LT(hits, ray_count * 8 / 10);
}

}  // namespace
}  // namespace minkray::testing
