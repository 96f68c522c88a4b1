// SPDX-License-Identifier: MIT
// Compares results of the filter with school geometry in more digits: no bound is broken, no hit
// or miss is false, wherever rays come from and however shapes are posed.
#include <gtest/gtest.h>

#include "tests/support/filter_cases.h"
#include "tests/support/ray_families.h"

namespace minkray::testing {
namespace {

using S = Shape;

struct NamedShape {
  std::string name;
  S shape;
};

std::vector<NamedShape> filtered_shapes() {
  const S box = Box{{1, 0.7, 0.5}};
  return {
      {"sphere", Sphere{0.3}},
      {"a minute sphere", Sphere{1e-12}},
      {"ellipsoid", Ellipsoid{{1, 0.5, 0.25}}},
      {"box", box},
      {"cube", Box{{1, 1, 1}}},
      {"capsule", Capsule{1, 1}},
      {"long capsule", Capsule{0.2, 2}},
      {"cylinder", Cylinder{1, 1}},
      {"coin", Cylinder{2, 0.25}},
      {"cut cylinder", CutCylinder{0.7, {-0.5, 0.6}, {0.2, -0.3}, {-0.5, 0.4}}},
      {"wedge", CutCylinder{1, {0, 0.5}, {0.25, 0}, {-0.25, 0}}},
      {"cone", Cone{1, 1}},
      {"flat cone", Cone{2, 0.2}},
      {"frustum", Frustum{{1, 0.3}, 1}},
      {"upturned frustum", Frustum{{0.25, 1.5}, 0.5}},
      {"even frustum", Frustum{{0.5, 0.5}, 0.5}},
      {"tapered capsule", TaperedCapsule{{1, 0.3}, 1}},
      {"upturned tapered capsule", TaperedCapsule{{0.1, 0.7}, 0.5}},
      {"rounded box", Rounded{0.2, box}},
      {"rounded plate", Rounded{0.1, S(Box{{1, 1, 0}})}},
  };
}

/// Coordinates that tie: zeros of either sign, the shape's own sizes, halves; a surface's points.
Ray<double> tied(const S& shape, double R, Random& random) {
  constexpr std::array numbers = {0.0, -0.0, 1.0, -1.0, 0.5, -0.5, 2.0, 0.25, 1e-30, -1e-20};
  const auto number = [&] { return numbers[static_cast<std::size_t>(random.below(10))]; };
  Ray<double> ray;
  for (int axis = 0; axis < 3; ++axis) {
    ray.origin[axis] = number() * (random.below(2) ? 1 : R);
    ray.direction[axis] = random.below(4) ? number() : random.uniform(-1, 1);
  }
  if (random.below(4) == 0) ray.origin = shape.support(random.direction());
  return ray;
}

void judge(const S& inner, const PreparedShape& prepared, const Ray<double>& ray,
           Counted& counted) {
  const auto line_in = [&](const Vec3<Long>& at, const Vec3<Long>& along) {
    return *line_in_shape(inner, at, along);
  };
  judge_by(line_in, prepared, ray, counted);
}

template <class Next>
Counted judge_all(int count, std::uint64_t seed, const Next& make_next) {
  Counted counted;
  for (const NamedShape& named : filtered_shapes()) {
    for (const Posed& posed : poses()) {
      // Elsewhere, floats are further apart than it is large.
      if (named.name == "a minute sphere" && posed.name != "as it is") continue;
      SCOPED_TRACE(named.name + ", " + posed.name);
      const Shape shape = named.shape;
      const Affine<double> pose = posed.pose.cast<double>();
      const PreparedShape prepared(shape, pose);
      EXPECT_NE(prepared.definition().form().kind, FormKind::none);
      const S inner = prepared.inner_shape();
      const S outer = Shape(Transform{Nested(shape), pose});
      Random random(seed);
      auto next = make_next(outer, random);
      for (int i = 0; i < count && !::testing::Test::HasFatalFailure(); ++i)
        judge(inner, prepared, cut(next(), random), counted);
    }
  }
  return counted;
}

Counted judge_family(RayFamily family, int count) {
  return judge_all(count, 71, [&](const S& shape, Random&) {
    auto rays = std::make_shared<FamilyRays>(shape, family, 72);
    return [rays] { return rays->next(); };
  });
}

TEST(Filter, random_rays_are_never_in_doubt_and_no_bound_is_broken) {
  const Counted counted = judge_family(RayFamily::random, 300);
  EXPECT_EQ(counted.in_doubt, 0);
  EXPECT_GT(counted.hits, 0.3 * counted.answered);
  EXPECT_GT(counted.misses, 0.1 * counted.answered);
  EXPECT_GT(counted.insides, 0);
}

TEST(Filter, no_bound_of_a_grazing_ray_is_broken_and_few_are_in_doubt) {
  const Counted counted = judge_family(RayFamily::grazing, 300);
  EXPECT_LT(counted.in_doubt, 0.05 * counted.answered);
  EXPECT_GT(counted.hits, 0.2 * counted.answered);
  EXPECT_GT(counted.misses, 0.3 * counted.answered);
}

TEST(Filter, no_bound_of_a_degenerate_ray_is_broken) {
  const Counted counted = judge_family(RayFamily::degenerate, 300);
  EXPECT_GT(counted.answered, counted.in_doubt);
}

TEST(Filter, no_bound_of_a_ray_from_afar_is_broken) {
  const Counted counted = judge_family(RayFamily::far, 300);
  EXPECT_GT(counted.answered, counted.in_doubt);
}

TEST(Filter, ties_are_answered_truly_or_are_in_doubt) {
  const Counted counted = judge_all(300, 73, [](const S& shape, Random& random) {
    const double R = ball_around(bounds_of(shape)).radius;
    return [&shape, &random, R] { return tied(shape, R, random); };
  });
  EXPECT_GT(counted.answered, 2 * counted.in_doubt);
}

/// The checker uses supports only.
TEST(Filter, answers_are_certified) {
  for (const NamedShape& named : filtered_shapes()) {
    if (named.name == "a minute sphere") continue;
    SCOPED_TRACE(named.name);
    const Shape shape = named.shape;
    const PreparedShape prepared(shape);
    expect_certified(shape, prepared, 74, 50);
  }
}

/// The plane is in the frame of the ray: it keeps off the shape, and the ray off it.
TEST(Filter, misses_have_a_separating_plane) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  for (const NamedShape& named : filtered_shapes()) {
    SCOPED_TRACE(named.name);
    const Shape shape = named.shape;
    const PreparedShape prepared(shape);
    int misses = 0;
    for (const RayFamily family : {RayFamily::random, RayFamily::grazing}) {
      FamilyRays rays(shape, family, 75);
      const double R = rays.ball().radius;
      for (int i = 0; i < 1000; ++i) {
        const Ray<double> ray = rays.next();
        const CastResult<double> answer = cast_ray(prepared, ray);
        if (answer.path != Path::filter || answer.status != Status::miss) continue;
        ++misses;
        const Vec3<double> n = answer.normal.cast<double>();
        const Ray<double> exact = ray;
        EXPECT_GT(n.dot(exact.origin - shape.support(n)), -32 * epsilon * R);
        EXPECT_GT(n.dot(exact.direction), -8 * epsilon * exact.direction.norm());
      }
    }
    EXPECT_GT(misses, 300);
  }
}

TEST(Filter, answers_cost_no_supports_and_other_solvers_are_not_overruled) {
  const PreparedShape sphere(Shape(Sphere{1.0}));
  const Ray<double> ray{{0.1, 0.2, -3.0}, {0, 0, 1}};
  const CastResult<double> filtered = cast_ray(sphere, ray);
  EXPECT_EQ(filtered.path, Path::filter);
  EXPECT_EQ(filtered.supports + filtered.iterations, 0);
  CastOptions options;
  options.solver = SolverKind::jet;
  const CastResult<double> by_jets = cast_ray(sphere, ray, options);
  EXPECT_NE(by_jets.path, Path::filter);
  EXPECT_GT(by_jets.supports, 0);
  options.solver = SolverKind::paper;
  EXPECT_EQ(cast_ray(sphere, ray, options).path, Path::gjk);
  int seen = 0;
  cast_ray(sphere, ray, {}, [&](const CastIteration<double>&) { ++seen; });
  EXPECT_GT(seen, 0);
}

}  // namespace
}  // namespace minkray::testing
