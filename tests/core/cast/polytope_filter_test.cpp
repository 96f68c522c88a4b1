// SPDX-License-Identifier: MIT
// Hulls of points: packets compared with single rays, their planes, and hits far from the origin.
#include "core/cast/packet_cast.h"
#include "core/polytope/polytope.h"
#include "tests/oracle/half_spaces.h"
#include "tests/support/filter_cases.h"

namespace minkray::testing {
namespace {

TEST(PolytopeFilter, packets_have_the_bits_of_single_rays) {
  for (const NamedPoints& named : hulls()) {
    SCOPED_TRACE(named.name);
    const Shape shape = Hull{PointCloud(named.points)};
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
    for (const Solver* const solver : {&solver::automatic, &solver::jet}) {
      int hits = 0;
      for (int i = 0; i < 2000; ++i) {
        const Vec3<double> from = near_middle(4), to = near_middle(1);
        const Ray<double> ray{from, to - from};
        const CastOptions options{solver};
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

}  // namespace
}  // namespace minkray::testing
