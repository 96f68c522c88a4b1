// SPDX-License-Identifier: MIT
// Compares results of the filter at rounded hulls, triangles and segments with the union of their
// facets' prisms and their edges' capsules, in more digits: no bound is broken, no hit or miss is
// false.
#include "tests/oracle/rounded_hull.h"
#include "tests/support/filter_cases.h"
#include "tests/support/hull_points.h"
#include "tests/support/ray_families.h"

namespace minkray::testing {
namespace {

using S = Shape;

/// Two points are a segment, three a triangle.
S rounded_hull(double radius, const Points& points) {
  if (points.size() == 2) return Rounded{radius, Nested(S(Segment{{points[0], points[1]}}))};
  if (points.size() == 3)
    return Rounded{radius, Nested(S(Triangle{{points[0], points[1], points[2]}}))};
  return Rounded{radius, Nested(S(Hull{PointCloud(points)}))};
}

std::vector<NamedPoints> cores() {
  std::vector<NamedPoints> named = hulls();
  named.push_back({"segment", {{-1, 0.2, 0}, {0.7, 1, -0.4}}});
  named.push_back({"segment of no length", {{0.5, 0.25, 1}, {0.5, 0.25, 1}}});
  named.push_back({"segment along x", {{-1, 0, 0}, {1, 0, 0}}});
  named.push_back({"segment off centre", {{3, 2, 1}, {4, 2.5, 0}}});
  named.push_back({"triangle", {{-1, -0.5, 0.1}, {1, -0.3, 0}, {0.2, 1, -0.4}}});
  named.push_back({"triangle along the axes", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
  named.push_back({"slender triangle", {{0, 0, 0}, {1, 0, 0}, {0.4, 0.02, 0.01}}});
  return named;
}

bool has_form(const PreparedShape& prepared) {
  return prepared.definition().form().kind != FormKind::none;
}

RoundedHull oracle_of(const PreparedShape& prepared) {
  const Shape& inner = prepared.inner_shape();
  const auto& shape = std::get<Rounded>(inner.kind);
  Points points;
  std::visit(
      [&]<class Core>(const Core& core) {
        if constexpr (std::is_same_v<Core, Hull>)
          for (const Vec3<double>& p : core.points.points()) points.push_back(p.cast<double>());
        else if constexpr (std::is_same_v<Core, Segment> || std::is_same_v<Core, Triangle>)
          for (const Vec3<double>& p : core.points) points.push_back(p.cast<double>());
      },
      shape.shape->kind);
  return RoundedHull(points, Long(shape.radius));
}

/// Hulls of some 60 points have too many features for this oracle.
constexpr std::size_t most_points = 40;

template <class Next>
Counted judge_rounded(int count, const Next& make_next) {
  Counted counted;
  int without_form = 0;
  for (const NamedPoints& named : cores()) {
    if (named.points.size() > most_points) continue;
    for (const double radius : {0.01, 0.1, 2.0}) {
      for (const Posed& posed : poses()) {
        SCOPED_TRACE(named.name + ", " + posed.name);
        const Shape shape = rounded_hull(radius, named.points);
        const Affine<double> pose = posed.pose.cast<double>();
        const PreparedShape prepared(shape, pose);
        if (!has_form(prepared)) {
          ++without_form;
          continue;
        }
        const RoundedHull oracle = oracle_of(prepared);
        const auto line_in = [&](const Vec3<Long>& at, const Vec3<Long>& along) {
          return oracle.line(at, along);
        };
        const S outer = Shape(Transform{Nested(shape), pose});
        Points posed_points;
        for (const Vec3<double>& p : named.points) posed_points.push_back(posed.pose(p));
        Random random(91);
        auto next = make_next(outer, posed_points);
        for (int i = 0; i < count && !::testing::Test::HasFatalFailure(); ++i)
          judge_by(line_in, prepared, cut(next(), random), counted);
      }
    }
  }
  EXPECT_EQ(without_form, 0);
  return counted;
}

Counted judge_rounded_by(RayFamily family, int count) {
  return judge_rounded(count, [&](const S& shape, const Points&) {
    auto rays = std::make_shared<FamilyRays>(shape, family, 92);
    return [rays] { return rays->next(); };
  });
}

TEST(RoundedPolytopeFilter, random_rays_are_hardly_ever_in_doubt_and_no_bound_is_broken) {
  const Counted counted = judge_rounded_by(RayFamily::random, 60);
  EXPECT_LE(counted.in_doubt, 0.001 * counted.answered);
  EXPECT_GT(counted.hits, 0.2 * counted.answered);
  EXPECT_GT(counted.misses, 0.1 * counted.answered);
  EXPECT_GT(counted.insides, 0);
}

TEST(RoundedPolytopeFilter, no_bound_of_a_grazing_ray_is_broken_and_few_are_in_doubt) {
  const Counted counted = judge_rounded_by(RayFamily::grazing, 60);
  EXPECT_LT(counted.in_doubt, 0.01 * counted.answered);
  EXPECT_GT(counted.hits, 0.2 * counted.answered);
  EXPECT_GT(counted.misses, 0.3 * counted.answered);
}

TEST(RoundedPolytopeFilter, no_bound_of_a_degenerate_ray_is_broken) {
  const Counted counted = judge_rounded_by(RayFamily::degenerate, 60);
  EXPECT_GT(counted.answered, counted.in_doubt);
}

TEST(RoundedPolytopeFilter, no_bound_of_a_ray_from_afar_is_broken) {
  const Counted counted = judge_rounded_by(RayFamily::far, 60);
  EXPECT_GT(counted.answered, counted.in_doubt);
}

TEST(RoundedPolytopeFilter, no_bound_of_a_ray_along_edges_is_broken) {
  const Counted counted = judge_rounded(60, [](const S& shape, const Points& points) {
    const double R = ball_around(bounds_of(shape)).radius;
    auto rays = std::make_shared<PointRays>(points, R);
    return [rays] { return rays->next(); };
  });
  EXPECT_GT(counted.answered, 10 * counted.in_doubt);
}

/// A line in the plane of a cube's face, across the middle of that face, meets the edge between
/// the face's two triangles at no distance, and was reported as a miss by the same edge of the
/// face opposite: to both of its triangles, the direction into the cube is a normal as well.
TEST(RoundedPolytope, a_line_in_a_faces_plane_is_no_miss) {
  const PreparedShape shape(rounded_hull(0.1, cube()));
  const CastResult<double> answer =
      cast_ray(shape, Ray<double>{{-7.9929982039150005, -7.5754525137685294, -1},
                                  {1.3785996407830001, 1.3150905027537059, 0}});
  ASSERT_EQ(answer.status, Status::hit);
  EXPECT_NEAR(answer.t(), 5, 1e-14);
}

/// The checker uses supports only.
TEST(RoundedPolytopeFilter, answers_are_certified) {
  for (const NamedPoints& named : cores()) {
    SCOPED_TRACE(named.name);
    const Shape shape = rounded_hull(0.1, named.points);
    const PreparedShape prepared(shape);
    if (prepared.centre().norm() > 10) continue;  // rounded to that
    expect_certified(shape, prepared, 93, 60);
  }
}

}  // namespace
}  // namespace minkray::testing
