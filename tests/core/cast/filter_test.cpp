// SPDX-License-Identifier: MIT
// Compares results of the filter with oracles in more digits: no bound is broken, no hit or miss
// is false, wherever rays come from and however shapes are posed.
#include <gtest/gtest.h>

#include <memory>

#include "tests/support/filter_judge.h"

namespace minkray::testing {
namespace {

MakeRays of_family(RayFamily family) {
  return [family](const Shape& shape, const Points&, Random&) -> NextRay {
    return [rays = std::make_shared<FamilyRays>(shape, family, 72)] { return rays->next(); };
  };
}

/// Through points, along edges and in the planes of facets.
NextRay along_edges(const Shape& shape, const Points& points, Random&) {
  const double R = ball_around(bounds_of(shape)).radius;
  return [rays = std::make_shared<PointRays>(points, R)] { return rays->next(); };
}

/// Coordinates that tie: zeros of either sign, the shape's own sizes, halves; a surface's points.
NextRay tied(const Shape& shape, const Points&, Random& random) {
  return [&shape, &random, R = ball_around(bounds_of(shape)).radius] {
    constexpr std::array numbers = {0.0, -0.0, 1.0, -1.0, 0.5, -0.5, 2.0, 0.25, 1e-30, -1e-20};
    const auto number = [&] { return numbers[static_cast<std::size_t>(random.below(10))]; };
    Ray<double> ray;
    for (int axis = 0; axis < 3; ++axis) {
      ray.origin[axis] = number() * (random.below(2) ? 1 : R);
      ray.direction[axis] = random.below(4) ? number() : random.uniform(-1, 1);
    }
    if (random.below(4) == 0) ray.origin = shape.support(random.direction());
    return ray;
  };
}

/// Rays at a group of shapes. Parts of the answered rays: the most in doubt next to them, the least
/// hits and misses among them.
struct FilterRow {
  const char* name;
  FilterGroup (*group)();
  MakeRays rays;
  double in_doubt, hits, misses;
  int insides = 0;
};

void PrintTo(const FilterRow& row, std::ostream* out) {
  *out << row.name;
}

/// In double most degenerate rays at polytopes are ties, which no bound can decide.
const std::vector<FilterRow> rows = {
    {"random_rays_at_closed_forms", closed_forms, of_family(RayFamily::random), 0, 0.3, 0.1, 1},
    {"grazing_rays_at_closed_forms", closed_forms, of_family(RayFamily::grazing), 0.05, 0.2, 0.3},
    {"degenerate_rays_at_closed_forms", closed_forms, of_family(RayFamily::degenerate), 1, 0, 0},
    {"far_rays_at_closed_forms", closed_forms, of_family(RayFamily::far), 1, 0, 0},
    {"tied_rays_at_closed_forms", closed_forms, tied, 0.5, 0, 0},
    {"random_rays_at_polytopes", polytopes, of_family(RayFamily::random), 0.001, 0.2, 0.2, 1},
    {"grazing_rays_at_polytopes", polytopes, of_family(RayFamily::grazing), 0.05, 0.2, 0.3},
    {"degenerate_rays_at_polytopes", polytopes, of_family(RayFamily::degenerate), 2, 0, 0},
    {"far_rays_at_polytopes", polytopes, of_family(RayFamily::far), 1, 0, 0},
    {"rays_along_edges_of_polytopes", polytopes, along_edges, 1, 0, 0},
    {"random_rays_at_rounded_ones", rounded_polytopes, of_family(RayFamily::random), 0.001, 0.2,
     0.1, 1},
    {"grazing_rays_at_rounded_ones", rounded_polytopes, of_family(RayFamily::grazing), 0.01, 0.2,
     0.3},
    {"degenerate_rays_at_rounded_ones", rounded_polytopes, of_family(RayFamily::degenerate), 1, 0,
     0},
    {"far_rays_at_rounded_ones", rounded_polytopes, of_family(RayFamily::far), 1, 0, 0},
    {"rays_along_edges_of_rounded_ones", rounded_polytopes, along_edges, 0.1, 0, 0},
};

class Filter : public ::testing::TestWithParam<FilterRow> {};

TEST_P(Filter, breaks_no_bound_and_is_seldom_in_doubt) {
  const FilterRow& row = GetParam();
  const Counted counted = judge_all(row.group(), row.rays);
  EXPECT_LE(counted.in_doubt, row.in_doubt * counted.answered);
  EXPECT_GT(counted.hits, row.hits * counted.answered);
  EXPECT_GT(counted.misses, row.misses * counted.answered);
  EXPECT_GE(counted.insides, row.insides);
}

INSTANTIATE_TEST_SUITE_P(Rays, Filter, ::testing::ValuesIn(rows),
                         [](const auto& tested) { return std::string(tested.param.name); });

/// The checker uses supports only.
TEST(Filters, answers_are_certified) {
  for (const FilterGroup& group : {closed_forms(), polytopes(), rounded_polytopes()})
    for (const FilterShape& one : group.shapes) {
      SCOPED_TRACE(one.name);
      // Both ends at the size of the shape: numbers far away are rounded to that. Normals of little
      // rounding have fewer digits than their planes need.
      const auto* rounded = std::get_if<Rounded>(&one.shape.kind);
      if (!one.is_posed || PreparedShape(one.shape).centre().norm() > 10) continue;
      if (rounded && rounded->radius < 0.1) continue;
      expect_certified(one.shape, 60);
    }
}

/// The plane is in the frame of the ray: it keeps off the shape, and the ray off it.
TEST(Filters, misses_have_a_separating_plane) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  for (const auto& [name, shape, points, is_posed] : closed_forms().shapes) {
    SCOPED_TRACE(name);
    const PreparedShape prepared(shape);
    int misses = 0;
    for (const RayFamily family : {RayFamily::random, RayFamily::grazing}) {
      FamilyRays rays(shape, family, 75);
      for (int i = 0; i < 1000; ++i) {
        const Ray<double> ray = rays.next();
        const CastResult<double> answer = cast_ray(prepared, ray);
        if (answer.path != Path::filter || answer.status != Status::miss) continue;
        ++misses;
        const Vec3<double>& n = answer.normal;
        EXPECT_GT(n.dot(ray.origin - shape.support(n)), -32 * epsilon * rays.ball().radius);
        EXPECT_GT(n.dot(ray.direction), -8 * epsilon * ray.direction.norm());
      }
    }
    EXPECT_GT(misses, 300);
  }
}

TEST(Filters, answers_cost_no_supports_and_other_solvers_are_not_overruled) {
  const PreparedShape sphere(Shape(Sphere{1.0}));
  const Ray<double> ray{{0.1, 0.2, -3.0}, {0, 0, 1}};
  const CastResult<double> filtered = cast_ray(sphere, ray);
  EXPECT_EQ(filtered.path, Path::filter);
  EXPECT_EQ(filtered.supports + filtered.iterations, 0);
  const CastResult<double> by_jets = cast_ray(sphere, ray, {&solver::jet});
  EXPECT_NE(by_jets.path, Path::filter);
  EXPECT_GT(by_jets.supports, 0);
  EXPECT_EQ(cast_ray(sphere, ray, {&solver::gjk_alone}).path, Path::gjk);
  int seen = 0;
  cast_ray(sphere, ray, {}, [&](const CastIteration<double>&) { ++seen; });
  EXPECT_GT(seen, 0);
}

}  // namespace
}  // namespace minkray::testing
