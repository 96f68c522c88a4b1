// SPDX-License-Identifier: MIT
// Claims about a half-space are judged by its plane alone: no wrong one holds, whatever the
// numbers are, and those of its cast do.
#include "renderer/audit/half_space_verdict.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "tests/support/random.h"

namespace minkray {
namespace {

constexpr double forever = std::numeric_limits<double>::infinity();

/// A ray towards the plane z = 1, from 2 above it: it meets it at t = 2.
struct Falling {
  HalfSpaceBody<double> ground{{0, 0, 1}, 1};
  Ray<double> ray{{0.5, -0.25, 3}, {0.5, 0, -1}};

  bool holds(Status status, double t, const Vec3<double>& normal = {0, 0, 1}) const {
    Claim claim;
    claim.status = status;
    claim.t_base = t;
    claim.normal = normal;
    return verdict_of(ground, ray, claim).holds;
  }
};

TEST(HalfSpaceVerdict, of_a_hit_is_that_of_its_time_its_normal_and_the_rays_ends) {
  Falling falling;
  EXPECT_TRUE(falling.holds(Status::hit, 2));
  EXPECT_FALSE(falling.holds(Status::hit, 2 + 1e-12));
  EXPECT_FALSE(falling.holds(Status::hit, 2, {0, 0, -1}));
  EXPECT_FALSE(falling.holds(Status::miss, 0));
  EXPECT_FALSE(falling.holds(Status::inside, 0));
  EXPECT_FALSE(falling.holds(Status::exhausted, 0));
  falling.ray.t_max = 2;
  EXPECT_TRUE(falling.holds(Status::hit, 2));
  falling.ray.t_max = 1.9;
  EXPECT_FALSE(falling.holds(Status::hit, 2));
  EXPECT_TRUE(falling.holds(Status::miss, 0));
  falling.ray.origin.z() = 0.5;
  EXPECT_TRUE(falling.holds(Status::inside, 0));
  EXPECT_FALSE(falling.holds(Status::miss, 0));
  falling.ray.direction.z() = 1;
  EXPECT_FALSE(falling.holds(Status::hit, 0.5));
}

TEST(HalfSpaceVerdict, nothing_made_up_is_proven_and_all_casts_are) {
  testing::Random random(7);
  std::array<int, 3> holding{};
  for (int i = 0; i < 100'000; ++i) {
    const Vec3<double> normal = random.direction();
    const HalfSpaceBody<double> body{normal, random.uniform(-5, 5)};
    Ray<double> ray{10 * random.in_cube(), random.direction()};
    if (random.below(2) > 0) ray.t_max = random.uniform(0, 20);
    const double height = normal.dot(ray.origin) - body.offset, rise = normal.dot(ray.direction);
    const double t = rise < 0 && height > 0 ? height / -rise : forever;
    const CastResult<double> cast = cast_ray(body, ray);
    ASSERT_TRUE(verdict_of(body, ray, claim_of(cast)).holds) << i;
    // Both are near to what would be so on the other side.
    if (std::abs(height) < 0.1 || std::abs(t - ray.t_max) < 0.1 || std::abs(rise) < 1e-3) continue;

    constexpr std::array times = {0.0,    -1.0, 1e-300,  1e300,
                                  -1e300, 1e17, forever, std::numeric_limits<double>::quiet_NaN()};
    const auto any_time = [&](double usual) {
      if (const int kind = random.below(3); kind > 0)
        return kind > 1 ? usual : random.uniform(-5, 25);
      return times[static_cast<std::size_t>(random.below(int(times.size())))];
    };
    constexpr std::array claims = {Status::hit, Status::miss, Status::inside};
    Claim claim;
    const auto kind = static_cast<std::size_t>(random.below(3));
    claim.status = claims[kind];
    claim.t_base = any_time(t);
    claim.t_offset = any_time(0);
    claim.normal = random.below(2) > 0 ? normal : random.direction();
    if (!verdict_of(body, ray, claim).holds) continue;
    ++holding[kind];
    const double claimed = claim.t_base + claim.t_offset;
    const bool is_met = t < forever && t <= ray.t_max;
    const bool is_true = kind == 0   ? is_met && std::abs(claimed - t) <= 1e-9 * t
                         : kind == 1 ? height > 0 && !is_met
                                     : height < 0;
    ASSERT_TRUE(is_true) << i << ": " << name_of(claim.status) << " at " << claimed << " of " << t;
  }
  for (const int held : holding) EXPECT_GT(held, 100);
}

}  // namespace
}  // namespace minkray
