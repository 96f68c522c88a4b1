// SPDX-License-Identifier: MIT
// Compares results of the filter with school geometry in more digits: no bound is broken, no hit
// or miss is false, wherever rays come from and however shapes are posed.
#include <gtest/gtest.h>

#include "core/derived/convert.h"
#include "tests/support/filter_cases.h"
#include "tests/support/ray_families.h"

namespace minkray::testing {
namespace {

using S = Shape<double>;

struct NamedShape {
  std::string name;
  S shape;
};

std::vector<NamedShape> filtered_shapes() {
  const S box = Box<double>{{1, 0.7, 0.5}};
  return {
      {"sphere", Sphere<double>{0.3}},
      {"a minute sphere", Sphere<double>{1e-12}},
      {"ellipsoid", Ellipsoid<double>{{1, 0.5, 0.25}}},
      {"box", box},
      {"cube", Box<double>{{1, 1, 1}}},
      {"capsule", Capsule<double>{1, 1}},
      {"long capsule", Capsule<double>{0.2, 2}},
      {"cylinder", Cylinder<double>{1, 1}},
      {"coin", Cylinder<double>{2, 0.25}},
      {"cut cylinder", CutCylinder<double>{0.7, {-0.5, 0.6}, {0.2, -0.3}, {-0.5, 0.4}}},
      {"wedge", CutCylinder<double>{1, {0, 0.5}, {0.25, 0}, {-0.25, 0}}},
      {"cone", Cone<double>{1, 1}},
      {"flat cone", Cone<double>{2, 0.2}},
      {"frustum", Frustum<double>{{1, 0.3}, 1}},
      {"upturned frustum", Frustum<double>{{0.25, 1.5}, 0.5}},
      {"even frustum", Frustum<double>{{0.5, 0.5}, 0.5}},
      {"tapered capsule", TaperedCapsule<double>{{1, 0.3}, 1}},
      {"upturned tapered capsule", TaperedCapsule<double>{{0.1, 0.7}, 0.5}},
      {"rounded box", Rounded<double>{0.2, box}},
      {"rounded plate", Rounded<double>{0.1, S(Box<double>{{1, 1, 0}})}},
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

template <class T>
void judge(const S& inner, const PreparedShape<T>& prepared, const Ray<T>& ray, Counted& counted) {
  const auto line_in = [&](const Vec3<Long>& at, const Vec3<Long>& along) {
    return *line_in_shape(inner, at, along);
  };
  judge_by(line_in, prepared, ray, counted);
}

template <class T>
class Filter : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(Filter, Scalars);

template <class T, class Next>
Counted judge_all(int count, std::uint64_t seed, const Next& make_next) {
  Counted counted;
  for (const NamedShape& named : filtered_shapes()) {
    for (const Posed& posed : poses()) {
      // Elsewhere, floats are further apart than it is large.
      if (named.name == "a minute sphere" && posed.name != "as it is") continue;
      SCOPED_TRACE(named.name + ", " + posed.name);
      const Shape<T> shape = convert<T>(named.shape);
      const Affine<T> pose = posed.pose.cast<T>();
      const PreparedShape<T> prepared(shape, pose);
      EXPECT_NE(prepared.definition().form().kind, FormKind::none);
      const S inner = convert<double>(prepared.inner_shape());
      const S outer = convert<double>(Shape<T>(Transform<T>{Nested<T>(shape), pose}));
      Random random(seed);
      auto next = make_next(outer, random);
      for (int i = 0; i < count && !::testing::Test::HasFatalFailure(); ++i)
        judge(inner, prepared, cut<T>(next(), random), counted);
    }
  }
  return counted;
}

template <class T>
Counted judge_family(RayFamily family, int count) {
  return judge_all<T>(count, 71, [&](const S& shape, Random&) {
    auto rays = std::make_shared<FamilyRays>(shape, family, 72);
    return [rays] { return rays->next(); };
  });
}

TYPED_TEST(Filter, random_rays_are_never_in_doubt_and_no_bound_is_broken) {
  const Counted counted = judge_family<TypeParam>(RayFamily::random, 300);
  EXPECT_EQ(counted.in_doubt, 0);
  EXPECT_GT(counted.hits, 0.3 * counted.answered);
  EXPECT_GT(counted.misses, 0.1 * counted.answered);
  EXPECT_GT(counted.insides, 0);
}

TYPED_TEST(Filter, no_bound_of_a_grazing_ray_is_broken_and_few_are_in_doubt) {
  const Counted counted = judge_family<TypeParam>(RayFamily::grazing, 300);
  EXPECT_LT(counted.in_doubt, 0.05 * counted.answered);
  EXPECT_GT(counted.hits, 0.2 * counted.answered);
  EXPECT_GT(counted.misses, 0.3 * counted.answered);
}

TYPED_TEST(Filter, no_bound_of_a_degenerate_ray_is_broken) {
  const Counted counted = judge_family<TypeParam>(RayFamily::degenerate, 300);
  EXPECT_GT(counted.answered, counted.in_doubt);
}

TYPED_TEST(Filter, no_bound_of_a_ray_from_afar_is_broken) {
  const Counted counted = judge_family<TypeParam>(RayFamily::far, 300);
  EXPECT_GT(counted.answered, counted.in_doubt);
}

TYPED_TEST(Filter, ties_are_answered_truly_or_are_in_doubt) {
  const Counted counted = judge_all<TypeParam>(300, 73, [](const S& shape, Random& random) {
    const double R = ball_around(bounds_of<double>(shape)).radius;
    return [&shape, &random, R] { return tied(shape, R, random); };
  });
  EXPECT_GT(counted.answered, 2 * counted.in_doubt);
}

/// The checker uses supports only.
TYPED_TEST(Filter, answers_are_certified) {
  using T = TypeParam;
  for (const NamedShape& named : filtered_shapes()) {
    if (named.name == "a minute sphere") continue;
    SCOPED_TRACE(named.name);
    const Shape<T> shape = convert<T>(named.shape);
    const PreparedShape<T> prepared(shape);
    expect_certified(shape, prepared, 74, 50);
  }
}

/// The plane is in the frame of the ray: it keeps off the shape, and the ray off it.
TYPED_TEST(Filter, misses_have_a_separating_plane) {
  using T = TypeParam;
  constexpr double epsilon = std::numeric_limits<T>::epsilon();
  for (const NamedShape& named : filtered_shapes()) {
    SCOPED_TRACE(named.name);
    const Shape<T> shape = convert<T>(named.shape);
    const PreparedShape<T> prepared(shape);
    const S same = convert<double>(shape);
    int misses = 0;
    for (const RayFamily family : {RayFamily::random, RayFamily::grazing}) {
      FamilyRays rays(same, family, 75);
      const double R = rays.ball().radius;
      for (int i = 0; i < 1000; ++i) {
        const Ray<T> ray = rounded_to<T>(rays.next());
        const CastResult<T> answer = cast_ray(prepared, ray);
        if (answer.path != Path::filter || answer.status != Status::miss) continue;
        ++misses;
        const Vec3<double> n = answer.normal.template cast<double>();
        const Ray<double> exact = in_double(ray);
        EXPECT_GT(n.dot(exact.origin - same.support(n)), -32 * epsilon * R);
        EXPECT_GT(n.dot(exact.direction), -8 * epsilon * exact.direction.norm());
      }
    }
    EXPECT_GT(misses, 300);
  }
}

TYPED_TEST(Filter, answers_cost_no_supports_and_other_solvers_are_not_overruled) {
  using T = TypeParam;
  const PreparedShape<T> sphere(Shape<T>(Sphere<T>{T(1)}));
  const Ray<T> ray{{T(0.1), T(0.2), T(-3)}, {0, 0, 1}};
  const CastResult<T> filtered = cast_ray(sphere, ray);
  EXPECT_EQ(filtered.path, Path::filter);
  EXPECT_EQ(filtered.supports + filtered.iterations, 0);
  CastOptions<T> options;
  options.solver = SolverKind::jet;
  const CastResult<T> by_jets = cast_ray(sphere, ray, options);
  EXPECT_NE(by_jets.path, Path::filter);
  EXPECT_GT(by_jets.supports, 0);
  options.solver = SolverKind::paper;
  EXPECT_EQ(cast_ray(sphere, ray, options).path, Path::gjk);
  int seen = 0;
  cast_ray<T>(sphere, ray, {}, [&](const CastIteration<T>&) { ++seen; });
  EXPECT_GT(seen, 0);
}

}  // namespace
}  // namespace minkray::testing
