// SPDX-License-Identifier: MIT
#include "renderer/rays/sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace minkray {
namespace {

TEST(Sampler, reversing_bits_twice_changes_nothing) {
  EXPECT_EQ(detail::reverse_bits(1u), 0x80000000u);
  EXPECT_EQ(detail::reverse_bits(detail::reverse_bits(0x12345678u)), 0x12345678u);
}

TEST(Sampler, begins_like_the_sobol_sequence) {
  const std::vector<std::uint32_t> expected = {0x00000000u, 0x80000000u, 0xc0000000u, 0x40000000u,
                                               0xa0000000u, 0x20000000u, 0x60000000u, 0xe0000000u};
  for (std::uint32_t i = 0; i < expected.size(); ++i)
    EXPECT_EQ(detail::reverse_bits(detail::sobol_second_reversed(i)), expected[i]);
}

// Uses direction numbers: those of the second dimension are each the one before and its shift.
TEST(Sampler, the_second_dimension_is_the_sum_of_its_direction_numbers) {
  for (std::uint32_t i = 0; i < 100'000; ++i) {
    const std::uint32_t index = i * 2654435761u;
    std::uint32_t sum = 0, direction = 0x80000000u;
    for (int bit = 0; bit < 32; ++bit, direction ^= direction >> 1)
      if (index >> bit & 1u) sum ^= direction;
    ASSERT_EQ(detail::reverse_bits(detail::sobol_second_reversed(index)), sum) << index;
  }
}

// A (0, 2)-net: every box of area 1/64 with sides that are powers of two holds one of 64 samples,
// in every pair of dimensions.
TEST(Sampler, every_elementary_interval_holds_one_sample) {
  constexpr int bits = 6, count = 1 << bits;
  std::vector<Sampler> samplers;
  for (int i = 0; i < count; ++i) samplers.emplace_back(42, 17, 4, static_cast<std::uint32_t>(i));
  for (int pair = 0; pair < 20; ++pair) {
    std::vector<std::array<double, 2>> points;
    for (Sampler& sampler : samplers) points.push_back(sampler.next());
    for (int x_bits = 0; x_bits <= bits; ++x_bits) {
      std::set<int> cells;
      for (const auto& [x, y] : points) {
        ASSERT_TRUE(x >= 0 && x < 1 && y >= 0 && y < 1);
        cells.insert((static_cast<int>(x * (1 << x_bits)) << (bits - x_bits)) +
                     static_cast<int>(y * (1 << (bits - x_bits))));
      }
      EXPECT_EQ(cells.size(), std::size_t{count}) << pair << " " << x_bits;
    }
  }
}

// The mean of one sample over many pixels reveals a bias that a single pixel hides: the sum of n
// uniform numbers has a standard deviation of sqrt(n / 12).
TEST(Sampler, pixels_seeds_and_dimensions_are_independent) {
  constexpr int side = 128, n = side * side;
  const double deviation = std::sqrt(n / 12.0), covariance = std::sqrt(n / 144.0);
  for (const std::uint64_t seed : {0u, 1u}) {
    double sum = 0, with_neighbour = 0, with_next_pair = 0, with_next_seed = 0;
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        Sampler here(seed, x, y, 0), neighbour(seed, x + 1, y, 0), other(seed + 1, x, y, 0);
        const double u = here.next()[0] - 0.5;
        sum += u;
        with_neighbour += u * (neighbour.next()[0] - 0.5);
        with_next_pair += u * (here.next()[0] - 0.5);
        with_next_seed += u * (other.next()[0] - 0.5);
      }
    EXPECT_LT(std::abs(sum), 4 * deviation);
    EXPECT_LT(std::abs(with_neighbour), 4 * covariance);
    EXPECT_LT(std::abs(with_next_pair), 4 * covariance);
    EXPECT_LT(std::abs(with_next_seed), 4 * covariance);
  }
}

}  // namespace
}  // namespace minkray
