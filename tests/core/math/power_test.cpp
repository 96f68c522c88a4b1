// SPDX-License-Identifier: MIT
#include "core/math/power.h"

#include <gtest/gtest.h>

#include "core/math/wide.h"

namespace minkray::testing {
namespace {

constexpr double exponents[] = {0.001, 0.05, 0.25, 1.0 / 3, 0.5, 0.9, 1.1, 2.5,
                                3,     7,    11.5, 12,      16,  17,  99,  1000};

/// Bases from 0 to 2, and near 0 and 1, where logarithms are hardest.
template <class T>
std::vector<T> bases() {
  std::vector<T> all;
  for (int i = 1; i <= 400; ++i) all.push_back(static_cast<T>(i * 0.005));
  for (int i = 1; i < 120; ++i) all.push_back(std::ldexp(T(1.37), -i));
  for (int i = 1; i < 50; ++i) {
    all.push_back(T(1) - std::ldexp(T(1), -i));
    all.push_back(T(1) + std::ldexp(T(1), -i));
  }
  return all;
}

/// Errors relative to the power or to 1, whichever is more. The logarithm's rounding counts as
/// often as the power has digits before the point, a product's as often as it has factors.
template <class T>
void check_against_library() {
  const long double epsilon = std::numeric_limits<T>::epsilon();
  for (const double exponent : exponents) {
    const T y = static_cast<T>(exponent);
    const long double allowed = 4 + std::min(exponent, 16.0) / 2;
    for (const T x : bases<T>()) {
      const long double exact = std::pow(static_cast<long double>(x), static_cast<long double>(y));
      if (exact > std::sqrt(std::numeric_limits<T>::max())) continue;
      const long double size = std::max(exact, 1.0L) * (1 + std::log2(std::max(exact, 1.0L)));
      EXPECT_LE(std::abs(power<T>(x, y) - exact), allowed * epsilon * size) << x << " ^ " << y;
    }
  }
}

TEST(Power, is_the_librarys_up_to_rounding) {
  check_against_library<float>();
  check_against_library<double>();
}

// In long double the library's own is no more precise than a few epsilon: it is compared with what
// is exact, a product and a root.
TEST(Power, in_long_double_is_precise_to_its_own_digits) {
  using Long = long double;
  constexpr Long epsilon = std::numeric_limits<Long>::epsilon();
  for (const Long x : bases<Long>()) {
    const Long cube = x * x * x, sixth = std::sqrt(cube) * cube;
    EXPECT_LE(std::abs(power<Long>(cube, 1 / Long(3)) - x), 8 * epsilon * std::max(x, Long(1)));
    EXPECT_LE(std::abs(power<Long>(x, Long(4.5)) - sixth),
              16 * epsilon * std::max(sixth, Long(1)) * (1 + std::log2(std::max(sixth, Long(1)))))
        << x;
  }
  EXPECT_LE(std::abs(power<Long>(1e-4945L, 1e-3L) - std::pow(1e-4945L, 1e-3L)), 1e-22L);
}

TEST(Power, of_zero_and_one_is_exact) {
  for (const double exponent : exponents) {
    EXPECT_EQ(power<double>(0, exponent), 0) << exponent;
    EXPECT_EQ(power<double>(1, exponent), 1) << exponent;
    EXPECT_EQ(power<float>(0, static_cast<float>(exponent)), 0) << exponent;
    EXPECT_EQ(power<float>(1, static_cast<float>(exponent)), 1) << exponent;
  }
  EXPECT_EQ(power<double>(0.3, 0), 1);
}

TEST(Power, of_numbers_below_the_normal_ones_is_not_lost) {
  EXPECT_NEAR(power<float>(1e-42f, 0.1f), std::pow(static_cast<double>(1e-42f), 0.1), 1e-9);
  EXPECT_NEAR(power<double>(1e-320, 0.01), std::pow(1e-320, 0.01), 1e-15);
}

TEST(Power, to_infinity_leaves_what_is_not_less_than_one) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(power<double>(1, infinity), 1);
  EXPECT_EQ(power<double>(std::nextafter(1.0, 0.0), infinity), 0);
  EXPECT_EQ(power<double>(0, infinity), 0);
  EXPECT_GT(power<double>(1.5, infinity), 1e300);
}

TEST(Power, that_leaves_the_range_is_zero_or_large) {
  EXPECT_EQ(power<float>(0.5f, 1000), 0);
  EXPECT_EQ(power<double>(0.5, 1e300), 0);
  EXPECT_GT(power<double>(2, 1e300), 1e300);
}

TEST(Power, of_two_and_its_logarithm_are_exact) {
  for (int k = -120; k <= 120; ++k) {
    EXPECT_EQ(exp2_of<float>(static_cast<float>(k)), std::ldexp(1.0f, k));
    EXPECT_EQ(log2_of<float>(std::ldexp(1.0f, k)), static_cast<float>(k));
    EXPECT_EQ(exp2_of<double>(8.0 * k), std::ldexp(1.0, 8 * k));
    EXPECT_EQ(log2_of<double>(std::ldexp(1.0, 8 * k)), 8 * k);
  }
}

/// Four in float or two in double at once.
template <class T>
void check_lanes() {
  constexpr int lanes = static_cast<int>(IsaSse2::register_bytes / sizeof(T));
  using W = Wide<T, lanes, IsaSse2>;
  std::vector<T> all = bases<T>();
  all.push_back(0);
  all.push_back(std::numeric_limits<T>::denorm_min());
  for (const double exponent : exponents)
    for (std::size_t i = 0; i + lanes <= all.size(); ++i) {
      const W together = power<W>(W::load(all.data() + i), static_cast<T>(exponent));
      for (int lane = 0; lane < lanes; ++lane)
        EXPECT_EQ(together.lane(lane),
                  power<T>(all[i + static_cast<std::size_t>(lane)], static_cast<T>(exponent)));
    }
}

TEST(Power, in_lanes_has_the_same_bits) {
  check_lanes<float>();
  check_lanes<double>();
}

}  // namespace
}  // namespace minkray::testing
