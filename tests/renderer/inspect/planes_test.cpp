// SPDX-License-Identifier: MIT
// Numbers on their way into a page: rounding is marked, with its direction.
#include "renderer/inspect/planes.h"

#include <gtest/gtest.h>

#include <random>

#include "renderer/inspect/base64.h"

namespace minkray {
namespace {

double length_of(std::uint16_t bits) {
  return static_cast<double>(std::bit_cast<float>(std::uint32_t{bits} << 16));
}

TEST(Planes, lengths_are_rounded_up_by_less_than_a_hundredth) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponent(-30, 30);
  for (int i = 0; i < 10000; ++i) {
    const double length = std::pow(10, exponent(random));
    const double kept = length_of(length_in_16_bits(length));
    EXPECT_GE(kept, length);
    EXPECT_LE(kept, length * 1.01);
  }
  EXPECT_EQ(length_of(length_in_16_bits(0)), 0);
  EXPECT_EQ(length_of(length_in_16_bits(-1e-20)), 0);
  EXPECT_TRUE(std::isinf(length_of(length_in_16_bits(std::numeric_limits<double>::infinity()))));
  EXPECT_TRUE(std::isinf(length_of(length_in_16_bits(1e300))));
  EXPECT_TRUE(std::isinf(length_of(length_in_16_bits(std::nan("")))));
}

TEST(Planes, directions_are_kept_to_four_digits) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 10000; ++i) {
    const Vec3<double> n = unit(Vec3<double>(normal(random), normal(random), normal(random)));
    const auto [u, v] = direction_in_32_bits(n);
    // The page's own steps (directionOf in data.js).
    Vec3<double> kept(u / 32767.0, v / 32767.0, 0);
    kept.z() = 1 - std::abs(kept.x()) - std::abs(kept.y());
    if (kept.z() < 0) {
      const double folded = (1 - std::abs(kept.y())) * (kept.x() < 0 ? -1 : 1);
      kept.y() = (1 - std::abs(kept.x())) * (kept.y() < 0 ? -1 : 1);
      kept.x() = folded;
    }
    // Each of u and v is off by 1.6e-5 at most, z by their sum; the three are 1 / sqrt(3) long at
    // least.
    EXPECT_LT((unit(kept) - n).norm(), 7e-5);
  }
  EXPECT_EQ(direction_in_32_bits(Vec3<double>::Zero())[1], -32768);
}

TEST(Planes, numbers_are_written_byte_by_byte) {
  PackedPlanes planes;
  planes.add<std::uint8_t>("a", {1, 2});
  planes.add<std::uint16_t>("b", {0x0304, 0x0506});
  EXPECT_EQ(planes.bytes, (std::vector<unsigned char>{1, 2, 4, 6, 3, 5}));
  EXPECT_EQ(planes.list.dump(), R"([["a","u8"],["b","u16"]])");
}

/// The examples of RFC 4648, section 10.
TEST(Base64, is_that_of_the_standard) {
  const auto encoded = [](std::string_view text) {
    return base64(std::span(reinterpret_cast<const unsigned char*>(text.data()), text.size()));
  };
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("fo"), "Zm8=");
  EXPECT_EQ(encoded("foo"), "Zm9v");
  EXPECT_EQ(encoded("foob"), "Zm9vYg==");
  EXPECT_EQ(encoded("fooba"), "Zm9vYmE=");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
}

}  // namespace
}  // namespace minkray
