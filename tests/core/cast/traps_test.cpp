// SPDX-License-Identifier: MIT
// Solvers calculate with finite numbers: with floating-point traps on, none fires. The exceptions,
// with their reasons, are in docs/verification.md: sources that serve numbers and packets alike
// divide first and choose afterwards.
#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <string_view>

#include "core/cast/cast.h"
#include "renderer/paper/distance.h"
#include "tests/support/ray_families.h"
#include "tests/support/sample_shapes.h"
#include "tests/support/traps.h"

namespace minkray::testing {
namespace {

/// The closed form of these divides by what may be zero first and chooses afterwards.
constexpr std::string_view divided_first[] = {"rounded", "minkowski_sum"};
/// The support mapping itself of these takes powers of zero to negative exponents.
constexpr std::string_view with_powers[] = {"superellipsoid"};
bool is_of(std::span<const std::string_view> kinds, const std::string& name) {
  const std::string kind = name.substr(0, name.find_first_of(", "));
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

TEST(Trap, fires_at_zero_by_zero_and_at_a_division_by_zero_and_at_nothing_else) {
  volatile double zero = 0, one = 1, three = 3, result = 0;
#if defined(__GLIBC__) && defined(__x86_64__)
  EXPECT_FALSE(runs_without_trap([&] { result = zero / zero; }));
  EXPECT_FALSE(runs_without_trap([&] { result = one / zero; }));
#endif
  EXPECT_TRUE(runs_without_trap([&] { result = one / three; }));
}

/// Random, grazing and far rays at the sample shapes that are of none of these kinds. Rays that the
/// filter leaves to models are left out: those divide first and choose afterwards.
void cast_with_traps(const Solver* solver, std::span<const std::string_view> left_out,
                     int fewest_shapes) {
  constexpr int rays_each = 200;
  int shapes = 0, hits = 0, casts = 0;
  const CastOptions options{solver};
  for (const SampleShape& sample : sample_shapes()) {
    if (is_of(left_out, sample.name)) continue;
    ++shapes;
    const PreparedShape shape(sample.shape);
    for (const RayFamily family : {RayFamily::random, RayFamily::grazing, RayFamily::far}) {
      FamilyRays rays(sample.shape, family, 11);
      for (int i = 0; i < rays_each; ++i) {
        const Ray<double> r = rays.next();
        const Ray<double> ray{r.origin, r.direction};
        CastResult<double> result;
        if (solver == &solver::automatic && cast_ray(shape, ray, options).path != Path::filter)
          continue;
        ASSERT_TRUE(runs_without_trap([&] { result = cast_ray(shape, ray, options); }))
            << sample.name << ": origin " << ray.origin.transpose() << ", direction "
            << ray.direction.transpose();
        hits += result.found() ? 1 : 0;
        ++casts;
      }
    }
  }
  EXPECT_GE(shapes, fewest_shapes);
  EXPECT_GT(hits, casts / 10);
}

TEST(Traps, none_fires_in_casts_of_the_paper) {
  cast_with_traps(&solver::gjk_alone, with_powers, 56);
}

TEST(Traps, none_fires_in_casts_in_closed_form) {
  cast_with_traps(&solver::automatic, divided_first, 34);
}

TEST(Traps, none_fires_in_distances_between_shapes_apart_and_overlapping) {
  std::vector<SampleShape> samples = sample_shapes();
  std::erase_if(samples, [](const SampleShape& sample) { return is_of(with_powers, sample.name); });
  Random random(5);
  int apart = 0, pairs = 0;
  for (const SampleShape& a : samples)
    for (const SampleShape& b : samples) {
      const Affine<double> pose{random.rotation(), 3 * random.in_cube()};
      const CentredShape here = centred(a.shape, {});
      const CentredShape there = centred(b.shape, pose);
      DistanceResult<double, 3> result;
      ASSERT_TRUE(runs_without_trap([&] { result = distance_between(here, there); }))
          << a.name << " and " << b.name << " at " << pose.translation.transpose();
      apart += result.distance > 0 ? 1 : 0;
      ++pairs;
    }
  EXPECT_GT(apart, pairs / 4);
  EXPECT_LT(apart, pairs);
}

}  // namespace
}  // namespace minkray::testing
