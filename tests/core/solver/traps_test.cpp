// SPDX-License-Identifier: MIT
// The reference solvers calculate with finite numbers: with floating-point traps on, none fires.
// What is left out, and why, is in docs/reliability-fuzzing.md: sources that serve numbers and
// packets alike divide first and choose afterwards.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/shape/convert.h"
#include "core/solver/cast.h"
#include "core/solver/distance.h"
#include "tests/support/ray_families.h"
#include "tests/support/sample_shapes.h"
#include "tests/support/traps.h"

namespace minkray::testing {
namespace {

/// Kinds of which support points or whole directions are divided by a length that may be zero
/// (`unit`, and the superellipsoid's powers), or that may be made of such.
bool divides_by_zero(const std::string& name) {
  const std::string kind = name.substr(0, name.find_first_of(", "));
  constexpr std::string_view kinds[] = {
      "cone",          "cylinder", "disk",           "frustum",  "hull_of", "minkowski_difference",
      "minkowski_sum", "point",    "superellipsoid", "transform"};
  return std::find(std::begin(kinds), std::end(kinds), kind) != std::end(kinds);
}

TEST(Trap, fires_at_zero_by_zero_and_at_a_division_by_zero_and_at_nothing_else) {
  volatile double zero = 0, one = 1, three = 3, result = 0;
#if defined(__GLIBC__) && defined(__x86_64__)
  EXPECT_FALSE(runs_without_trap([&] { result = zero / zero; }));
  EXPECT_FALSE(runs_without_trap([&] { result = one / zero; }));
#endif
  EXPECT_TRUE(runs_without_trap([&] { result = one / three; }));
}

template <class T>
class Traps : public ::testing::Test {};
using Precisions = ::testing::Types<float, double>;
TYPED_TEST_SUITE(Traps, Precisions);

TYPED_TEST(Traps, none_fires_in_casts_of_the_paper) {
  using T = TypeParam;
  constexpr int rays_each = 200;
  int shapes = 0, hits = 0, casts = 0;
  for (const SampleShape& sample : sample_shapes()) {
    if (divides_by_zero(sample.name)) continue;
    ++shapes;
    const PreparedShape<T> shape(convert<T>(sample.shape));
    CastOptions<T> options;
    options.solver = SolverKind::paper;
    for (const RayFamily family : {RayFamily::random, RayFamily::grazing, RayFamily::far}) {
      FamilyRays rays(sample.shape, family, 11);
      for (int i = 0; i < rays_each; ++i) {
        const Ray<double> r = rays.next();
        const Ray<T> ray{r.origin.cast<T>(), r.direction.cast<T>()};
        CastResult<T> result;
        ASSERT_TRUE(runs_without_trap([&] { result = cast_ray(shape, ray, options); }))
            << sample.name << ": origin " << ray.origin.transpose() << ", direction "
            << ray.direction.transpose();
        hits += result.found() ? 1 : 0;
        ++casts;
      }
    }
  }
  EXPECT_GT(shapes, 12);
  EXPECT_GT(hits, casts / 10);
}

TYPED_TEST(Traps, none_fires_in_distances_between_shapes_apart_and_overlapping) {
  using T = TypeParam;
  std::vector<SampleShape> samples = sample_shapes();
  std::erase_if(samples, [](const SampleShape& sample) { return divides_by_zero(sample.name); });
  Random random(5);
  int apart = 0, pairs = 0;
  for (const SampleShape& a : samples)
    for (const SampleShape& b : samples) {
      const Affine<double> pose{random.rotation(), 3 * random.in_cube()};
      const CentredShape<T> here = centred<T>(convert<T>(a.shape), {});
      const CentredShape<T> there = centred<T>(convert<T>(b.shape), pose.cast<T>());
      DistanceResult<T, 3> result;
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
