// SPDX-License-Identifier: MIT
// Lanes that packets of models settle by themselves: nearly every requested lane, and no other.
// The others go to single casts, so that results do not show it.
#include "core/cast/packet_kernel.h"

#include <gtest/gtest.h>

#include <bit>

#include "tests/support/random.h"

namespace minkray::testing {
namespace {

/// Shapes without a closed form: smooth ones, and one with edges.
std::vector<Shape> packet_shapes() {
  using S = Shape;
  const S egg = Ellipsoid{{1, 0.5, 0.25}};
  return {Superellipsoid{{1, 0.7, 0.5}, 3}, MinkowskiSum{{egg, S(Ellipsoid{{0.3, 0.5, 1}})}},
          MinkowskiSum{{egg, S(Cone{0.3, 0.5})}}};
}

void ask(const PreparedShape& shape, const RayPacket& rays, LaneBits lanes, InstructionSet set,
         CastPacket& answers) {
  if (set == InstructionSet::avx2)
    packet_kernel_avx2(shape, rays, lanes, false, answers);
  else
    packet_kernel_sse2(shape, rays, lanes, false, answers);
}

/// Distance of the plane between the ray's lane and the shape.
double margin(const Shape& shape, const RayPacket& rays, const CastPacket& answers, int lane) {
  Vec3<double> n, origin, direction;
  const auto i = static_cast<std::size_t>(lane);
  for (int axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    n[axis] = double(answers.normal[k][i]);
    origin[axis] = double(rays.origin[k][i]);
    direction[axis] = double(rays.direction[k][i]);
  }
  return n.dot(origin - shape.support(n)) + std::min(0.0, n.dot(direction) * 1e3);
}

TEST(PacketKernel, settles_nearly_all_lanes_it_is_asked_for_and_no_other) {
  const std::vector<InstructionSet> sets =
      best_instruction_set() == InstructionSet::avx2
          ? std::vector{InstructionSet::sse2, InstructionSet::avx2}
          : std::vector{InstructionSet::sse2};
  for (const Shape& kind : packet_shapes()) {
    const PreparedShape shape(kind);
    ASSERT_EQ(shape.definition().form().kind, FormKind::none);
    for (const InstructionSet set : sets) {
      Random random(61);
      int asked = 0, open = 0, hits = 0, misses = 0, inside = 0;
      for (int round = 0; round < 600; ++round) {
        RayPacket rays;
        // Some packets miss altogether, of some a few lanes begin inside.
        const double beside = round % 4 == 0 ? 6 : 0;
        for (int lane = 0; lane < packet_lanes; ++lane) {
          Vec3<double> from = 5 * random.direction();
          if (round % 5 == 1 && lane % 2 == 0) from = 0.1 * random.in_cube();
          const Vec3<double> aim =
              1.3 * random.in_cube() + beside * unit<double>(from.cross(Vec3<double>(1, 2, 3)));
          rays.set(lane, {from, unit<double>(aim - from)});
        }
        const LaneBits lanes =
            round % 3 == 0 ? all_lanes : LaneBits(random.below(int(all_lanes) + 1));
        CastPacket answers;
        ask(shape, rays, lanes, set, answers);
        const LaneBits settled = answers.hit | answers.inside | answers.miss;
        ASSERT_EQ(settled & ~lanes, 0u);
        asked += std::popcount(lanes);
        open += std::popcount(lanes & ~settled);
        hits += std::popcount(answers.hit);
        misses += std::popcount(answers.miss);
        inside += std::popcount(answers.inside);
        for (int lane = 0; lane < packet_lanes; ++lane)
          if (answers.miss & (LaneBits(1) << lane)) {
            EXPECT_GT(margin(kind, rays, answers, lane), -1e-3);
          }
      }
      EXPECT_LT(open, asked / 50);
      EXPECT_GT(hits, asked / 10);
      EXPECT_GT(misses, asked / 10);
      EXPECT_GT(inside, asked / 50);
    }
  }
}

// A caller may keep one packet of answers for all rays.
TEST(PacketKernel, answers_that_are_used_again_hold_nothing_of_the_former) {
  const PreparedShape ball(Shape(Sphere{1.0}));
  RayPacket at_it, away;
  for (int lane = 0; lane < packet_lanes; ++lane) {
    at_it.set(lane, {{double(lane % 2 ? -3 : 0), 0.0, 0.0}, {1.0, 0.0, 0.0}});
    away.set(lane, {{-3.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}});
  }
  CastPacket answers;
  for (const RayPacket& rays : {at_it, away}) {
    cast_packet(ball, rays, all_lanes, answers);
    const bool is_away = rays.direction[0][0] < 0.0;
    EXPECT_EQ(std::popcount(answers.hit), is_away ? 0 : packet_lanes / 2);
    EXPECT_EQ(std::popcount(answers.inside), is_away ? 0 : packet_lanes / 2);
    EXPECT_EQ(std::popcount(answers.miss), is_away ? packet_lanes : 0);
  }
}

}  // namespace
}  // namespace minkray::testing
