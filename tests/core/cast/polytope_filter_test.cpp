// SPDX-License-Identifier: MIT
// Compares results of the filter at convex hulls with planes through every three of their points,
// in more digits: no bound is broken, no hit or miss is false.
#include "core/cast/packet_cast.h"
#include "core/polytope/polytope.h"
#include "tests/oracle/half_spaces.h"
#include "tests/support/filter_cases.h"
#include "tests/support/hull_points.h"
#include "tests/support/ray_families.h"

namespace minkray::testing {
namespace {

using S = Shape;
/// The inner shape's own points, as they were rounded and moved.
HalfSpaces planes_of(const PreparedShape& prepared) {
  const Shape& inner = prepared.inner_shape();
  Points points;
  for (const Vec3<double>& p : std::get<Hull>(inner.kind).points.points())
    points.push_back(p.cast<double>());
  return HalfSpaces(points);
}

template <class Next>
Counted judge_hulls(int count, const Next& make_next) {
  Counted counted;
  for (const NamedPoints& named : hulls()) {
    for (const Posed& posed : poses()) {
      SCOPED_TRACE(named.name + ", " + posed.name);
      const S exact = Hull{PointCloud(named.points)};
      const Shape shape = exact;
      const Affine<double> pose = posed.pose.cast<double>();
      const PreparedShape prepared(shape, pose);
      EXPECT_EQ(prepared.definition().form().kind, FormKind::polytope);
      const HalfSpaces planes = planes_of(prepared);
      const auto line_in = [&](const Vec3<Long>& at, const Vec3<Long>& along) -> Interval {
        const HalfSpaces::Part part = planes.clip(at, along);
        return {part.lower, part.upper};
      };
      const S outer = Shape(Transform{Nested(shape), pose});
      Points posed_points;
      for (const Vec3<double>& p : named.points) posed_points.push_back(posed.pose(p));
      Random random(81);
      auto next = make_next(outer, posed_points);
      for (int i = 0; i < count && !::testing::Test::HasFatalFailure(); ++i)
        judge_by(line_in, prepared, cut(next(), random), counted);
    }
  }
  return counted;
}

Counted judge_hulls_by(RayFamily family, int count) {
  return judge_hulls(count, [&](const S& shape, const Points&) {
    auto rays = std::make_shared<FamilyRays>(shape, family, 82);
    return [rays] { return rays->next(); };
  });
}

TEST(PolytopeFilter, random_rays_are_hardly_ever_in_doubt_and_no_bound_is_broken) {
  const Counted counted = judge_hulls_by(RayFamily::random, 400);
  EXPECT_LE(counted.in_doubt, 0.001 * counted.answered);
  EXPECT_GT(counted.hits, 0.2 * counted.answered);
  EXPECT_GT(counted.misses, 0.2 * counted.answered);
  EXPECT_GT(counted.insides, 0);
}

TEST(PolytopeFilter, no_bound_of_a_grazing_ray_is_broken_and_few_are_in_doubt) {
  const Counted counted = judge_hulls_by(RayFamily::grazing, 400);
  EXPECT_LT(counted.in_doubt, 0.05 * counted.answered);
  EXPECT_GT(counted.hits, 0.2 * counted.answered);
  EXPECT_GT(counted.misses, 0.3 * counted.answered);
}

TEST(PolytopeFilter, no_bound_of_a_degenerate_ray_is_broken) {
  const Counted counted = judge_hulls_by(RayFamily::degenerate, 400);
  // In double most of them are ties, which no bound can decide.
  EXPECT_GT(counted.answered, counted.in_doubt / 2);
}

TEST(PolytopeFilter, no_bound_of_a_ray_from_afar_is_broken) {
  const Counted counted = judge_hulls_by(RayFamily::far, 400);
  EXPECT_GT(counted.answered, counted.in_doubt);
}

TEST(PolytopeFilter, no_bound_of_a_ray_through_points_or_along_edges_is_broken) {
  const Counted counted = judge_hulls(400, [](const S& shape, const Points& points) {
    const double R = ball_around(bounds_of(shape)).radius;
    auto rays = std::make_shared<PointRays>(points, R);
    return [rays] { return rays->next(); };
  });
  EXPECT_GT(counted.answered, counted.in_doubt);
}

/// The checker uses supports only.
TEST(PolytopeFilter, answers_are_certified) {
  for (const NamedPoints& named : hulls()) {
    SCOPED_TRACE(named.name);
    const Shape shape = S(Hull{PointCloud(named.points)});
    const PreparedShape prepared(shape);
    // Both ends at the size of the shape: what is far away is rounded to that.
    if (prepared.centre().norm() > 10) continue;
    expect_certified(shape, prepared, 83, 60);
  }
}

TEST(PolytopeFilter, packets_have_the_bits_of_single_rays) {
  for (const NamedPoints& named : hulls()) {
    SCOPED_TRACE(named.name);
    const Shape shape = S(Hull{PointCloud(named.points)});
    const PreparedShape prepared(shape);
    for (const RayFamilyDescription& family : ray_families) {
      FamilyRays rays(shape, family.family, 84);
      RayPacket packet;
      for (int i = 0; i < packet_lanes; ++i) packet.set(i, rays.next());
      for (const InstructionSet set : {InstructionSet::sse2, best_instruction_set()}) {
        CastPacket answers;
        cast_packet(prepared, packet, all_lanes, answers, set);
        for (int i = 0; i < packet_lanes; ++i) {
          const CastResult<double> one = cast_ray(prepared, packet.ray(i)),
                                   other = answers.result(i);
          EXPECT_EQ(one.status, other.status);
          EXPECT_EQ(one.path, other.path);
          if (!one.found()) continue;
          EXPECT_EQ(one.t_base, other.t_base);
          EXPECT_EQ(one.t_offset, other.t_offset);
          EXPECT_EQ(one.offset_lo, other.offset_lo);
          EXPECT_EQ(one.offset_hi, other.offset_hi);
          EXPECT_EQ(one.normal, other.normal);
        }
      }
    }
  }
}

/// A facet of a cube is one plane, however it was cut into triangles.
TEST(Polytope, triangles_in_one_plane_share_it) {
  EXPECT_EQ(exact::Polytope::of(PointCloud(cube()), {0, 0, 0}, 1)->planes(), 6u);
  EXPECT_EQ(exact::Polytope::of(PointCloud(prism(12, 0.5)), {0, 0, 0}, 1)->planes(), 14u);
}

TEST(Polytope, flat_hulls_have_no_form) {
  EXPECT_EQ(
      exact::Polytope::of(PointCloud({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}), {0, 0, 0}, 1),
      nullptr);
  EXPECT_EQ(exact::Polytope::of(PointCloud({{1, 2, 3}}), {0, 0, 0}, 1), nullptr);
}

/// Hulls that are 1e3 to 1e4 radii from their frame's origin, with points and rays on a coarse
/// grid: once they were computed at their place, in steps of what rounding leaves there.
TEST(Polytope, hulls_far_from_their_origin_are_hit_where_they_are) {
  constexpr double step = 0x1p-10;
  for (const double distance : {1000.0, 9000.0}) {
    Random random(9);
    const Vec3<double> middle(distance, -distance, 0.5);
    const auto near_middle = [&](double size) {
      const Vec3<double> p = middle + size * random.in_cube();
      return Vec3<double>((p / step).array().round() * step);
    };
    Points points;
    for (int i = 0; i < 12; ++i) points.push_back(near_middle(1));
    const Shape shape = Hull{PointCloud(points)};
    const PreparedShape prepared(shape);
    const HalfSpaces planes(points);
    for (const SolverKind solver : {SolverKind::automatic, SolverKind::jet}) {
      int hits = 0;
      for (int i = 0; i < 2000; ++i) {
        const Vec3<double> from = near_middle(4), to = near_middle(1);
        const Ray<double> ray{from, to - from};
        CastOptions options;
        options.solver = solver;
        const CastResult<double> answer = cast_ray(prepared, ray, options);
        if (answer.status != Status::hit) continue;
        const auto part = planes.clip(ray.origin.cast<Long>(), ray.direction.cast<Long>());
        ASSERT_FALSE(part.empty());
        const double late = (answer.t_base - static_cast<double>(part.lower)) + answer.t_offset;
        EXPECT_LT(std::abs(late * ray.direction.dot(answer.normal)), 1e-11) << distance;
        ++hits;
      }
      EXPECT_GT(hits, 500);
    }
  }
}

}  // namespace
}  // namespace minkray::testing
