// SPDX-License-Identifier: MIT
// Lanes that packets of models settle by themselves: nearly every requested lane, and no other.
// The others go to single casts, so that results do not show it.
#include "core/cast/packet_kernel.h"

#include <gtest/gtest.h>

#include <bit>

#include "core/derived/convert.h"
#include "tests/support/random.h"

namespace minkray::testing {
namespace {

template <class T>
class PacketKernel : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(PacketKernel, Scalars);

/// Shapes without a closed form: smooth ones, and one with edges.
std::vector<Shape<double>> packet_shapes() {
  using S = Shape<double>;
  const S egg = Ellipsoid<double>{{1, 0.5, 0.25}};
  return {Superellipsoid<double>{{1, 0.7, 0.5}, 3},
          MinkowskiSum<double>{{egg, S(Ellipsoid<double>{{0.3, 0.5, 1}})}},
          MinkowskiSum<double>{{egg, S(Cone<double>{0.3, 0.5})}}};
}

template <class T>
void ask(const PreparedShape<T>& shape, const RayPacket<T>& rays, LaneBits lanes,
         InstructionSet set, CastPacket<T>& answers) {
  if (set == InstructionSet::avx2)
    packet_kernel_avx2(shape, rays, lanes, false, answers);
  else
    packet_kernel_sse2(shape, rays, lanes, false, answers);
}

/// Distance of the plane between the ray's lane and the shape.
template <class T>
double margin(const Shape<double>& shape, const RayPacket<T>& rays, const CastPacket<T>& answers,
              int lane) {
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

TYPED_TEST(PacketKernel, settles_nearly_all_lanes_it_is_asked_for_and_no_other) {
  using T = TypeParam;
  const std::vector<InstructionSet> sets =
      best_instruction_set() == InstructionSet::avx2
          ? std::vector{InstructionSet::sse2, InstructionSet::avx2}
          : std::vector{InstructionSet::sse2};
  for (const Shape<double>& kind : packet_shapes()) {
    const PreparedShape<T> shape(convert<T>(kind));
    ASSERT_EQ(shape.definition().form().kind, FormKind::none);
    for (const InstructionSet set : sets) {
      Random random(61);
      int asked = 0, open = 0, hits = 0, misses = 0, inside = 0;
      for (int round = 0; round < 600; ++round) {
        RayPacket<T> rays;
        // Some packets miss altogether, of some a few lanes begin inside.
        const double beside = round % 4 == 0 ? 6 : 0;
        for (int lane = 0; lane < packet_lanes<T>; ++lane) {
          Vec3<double> from = 5 * random.direction();
          if (round % 5 == 1 && lane % 2 == 0) from = 0.1 * random.in_cube();
          const Vec3<double> aim =
              1.3 * random.in_cube() + beside * unit<double>(from.cross(Vec3<double>(1, 2, 3)));
          rays.set(lane, {from.cast<T>(), unit<double>(aim - from).cast<T>()});
        }
        const LaneBits lanes =
            round % 3 == 0 ? all_lanes<T> : LaneBits(random.below(int(all_lanes<T>) + 1));
        CastPacket<T> answers;
        ask(shape, rays, lanes, set, answers);
        const LaneBits settled = answers.hit | answers.inside | answers.miss;
        ASSERT_EQ(settled & ~lanes, 0u);
        asked += std::popcount(lanes);
        open += std::popcount(lanes & ~settled);
        hits += std::popcount(answers.hit);
        misses += std::popcount(answers.miss);
        inside += std::popcount(answers.inside);
        for (int lane = 0; lane < packet_lanes<T>; ++lane)
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
TYPED_TEST(PacketKernel, answers_that_are_used_again_hold_nothing_of_the_former) {
  using T = TypeParam;
  const PreparedShape<T> ball(Shape<T>(Sphere<T>{T(1)}));
  RayPacket<T> at_it, away;
  for (int lane = 0; lane < packet_lanes<T>; ++lane) {
    at_it.set(lane, {{T(lane % 2 ? -3 : 0), T(0), T(0)}, {T(1), T(0), T(0)}});
    away.set(lane, {{T(-3), T(0), T(0)}, {T(-1), T(0), T(0)}});
  }
  CastPacket<T> answers;
  for (const RayPacket<T>& rays : {at_it, away}) {
    cast_packet(ball, rays, all_lanes<T>, answers);
    const bool is_away = rays.direction[0][0] < T(0);
    EXPECT_EQ(std::popcount(answers.hit), is_away ? 0 : packet_lanes<T> / 2);
    EXPECT_EQ(std::popcount(answers.inside), is_away ? 0 : packet_lanes<T> / 2);
    EXPECT_EQ(std::popcount(answers.miss), is_away ? packet_lanes<T> : 0);
  }
}

}  // namespace
}  // namespace minkray::testing
