// SPDX-License-Identifier: MIT
// A packet's answers are those of single casts, bit for bit, whatever the instruction set.
#include "core/cast/packet_cast.h"

#include <gtest/gtest.h>

#include <bit>

#include "tests/support/aimed_rays.h"
#include "tests/support/sample_shapes.h"

namespace minkray::testing {
namespace {

std::vector<InstructionSet> instruction_sets() {
  std::vector<InstructionSet> sets = {InstructionSet::sse2};
  if (best_instruction_set() == InstructionSet::avx2) sets.push_back(InstructionSet::avx2);
  return sets;
}

std::vector<SampleShape> packed_shapes() {
  std::vector<SampleShape> all = sample_shapes_and_nestings(500, 540);
  // Needles: packets left their casts' box and model to them.
  using V = Vec3<double>;
  all.push_back(
      {"triangle of 1e27", Triangle{{V(-1, 3, 0), V(3, -1.25, 0.75), V(5.9e27, 0.04, -0.0625)}}});
  Random random(6);
  std::vector<V> points;
  for (int k = 0; k < 8; ++k) points.push_back(random.in_cube().cwiseProduct(V(1, 1e-11, 1e-11)));
  all.push_back({"needle of 1e-11", Hull{PointCloud(points)}});
  return all;
}

bool same_bits(double a, double b) {
  using Bits = std::conditional_t<sizeof(double) == 4, std::uint32_t, std::uint64_t>;
  return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
}

::testing::AssertionResult same(const CastResult<double>& a, const CastResult<double>& b) {
  if (a.status != b.status)
    return ::testing::AssertionFailure() << name_of(a.status) << " and " << name_of(b.status);
  if (a.found() && !same_bits(a.t_base, b.t_base)) return ::testing::AssertionFailure() << "t_base";
  if (a.found() && !(same_bits(a.t_offset, b.t_offset) && same_bits(a.offset_lo, b.offset_lo) &&
                     same_bits(a.offset_hi, b.offset_hi)))
    return ::testing::AssertionFailure()
           << "t_offset " << a.t_offset << " and " << b.t_offset << ", [" << a.offset_lo << ", "
           << a.offset_hi << "] and [" << b.offset_lo << ", " << b.offset_hi << "]";
  if (a.normal != b.normal)
    return ::testing::AssertionFailure()
           << "normals " << a.normal.transpose() << " and " << b.normal.transpose();
  if (a.supports != b.supports)
    return ::testing::AssertionFailure() << "supports " << a.supports << " and " << b.supports;
  return ::testing::AssertionSuccess();
}

/// Packets of rays of all kinds: near and far, that begin inside, end early, are points.
std::vector<RayPacket> packets_at(const Shape& shape, int count) {
  const Bounds<double> bounds = bounds_of(shape);
  AimedRays near(bounds, 91, 3), far(bounds, 92, 1e4), inside(bounds, 93, 0.6);
  Random random(94);
  std::vector<RayPacket> packets(static_cast<std::size_t>(count));
  for (RayPacket& packet : packets) {
    for (int lane = 0; lane < packet_lanes; ++lane) {
      const double kind = random.uniform(0, 1);
      Ray<double> ray = kind < 0.6 ? near.next(1.4) : kind < 0.8 ? far.next(1.4) : inside.next(0.7);
      Ray<double> cast_at{ray.origin, ray.direction};
      if (kind > 0.97) cast_at.direction.setZero();
      if (kind > 0.5 && kind < 0.55) cast_at.t_max = double(random.uniform(0, 2));
      packet.set(lane, cast_at);
    }
  }
  return packets;
}

/// `leaves`: compares exits.
void check_all(bool leaves) {
  int hits = 0, rays = 0;
  for (const SampleShape& sample : packed_shapes()) {
    const Shape shape = sample.shape;
    const PreparedShape prepared(shape);
    for (const RayPacket& packet : packets_at(shape, 1000 / packet_lanes)) {
      for (const InstructionSet set : instruction_sets()) {
        CastPacket answers;
        if (leaves)
          cast_exit_packet(prepared, packet, all_lanes, answers, set);
        else
          cast_packet(prepared, packet, all_lanes, answers, set);
        for (int lane = 0; lane < packet_lanes; ++lane) {
          const CastResult<double> alone =
              leaves ? cast_exit(prepared, packet.ray(lane)) : cast_ray(prepared, packet.ray(lane));
          ASSERT_TRUE(same(alone, answers.result(lane)))
              << sample.name << ", " << packet_lanes << " lanes, set " << int(set) << ", origin "
              << packet.ray(lane).origin.transpose() << ", direction "
              << packet.ray(lane).direction.transpose();
          ++rays;
          hits += alone.found() ? 1 : 0;
        }
      }
    }
  }
  EXPECT_GT(hits, 0.3 * rays);
  EXPECT_LT(hits, 0.7 * rays);
}

TEST(PacketCast, answers_as_single_casts_do) {
  check_all(false);
}

TEST(PacketCast, exits_are_those_of_single_casts) {
  check_all(true);
}

TEST(PacketCast, lanes_that_are_not_asked_for_change_nothing) {
  const PreparedShape box(sample_shapes().front().shape);
  for (const RayPacket& packet : packets_at(box.inner_shape(), 50)) {
    CastPacket whole, half;
    cast_packet(box, packet, all_lanes, whole);
    cast_packet(box, packet, LaneBits(0b0101), half);
    EXPECT_EQ(half.hit, whole.hit & 0b0101u);
    EXPECT_EQ(half.inside, whole.inside & 0b0101u);
    EXPECT_EQ(half.miss, whole.miss & 0b0101u);
    for (int lane = 0; lane < packet_lanes; lane += 2)
      EXPECT_TRUE(same(whole.result(lane), half.result(lane)));
  }
}

}  // namespace
}  // namespace minkray::testing
