// SPDX-License-Identifier: MIT
#include "renderer/image/filter.h"

#include <gtest/gtest.h>

#include <cmath>

namespace minkray {
namespace {

/// The integral of f over the filter's support, by the middle rule: exact to rounding for a smooth
/// function that begins and ends flat.
template <class F>
double integral(const F& f) {
  constexpr int steps = 4096;
  double sum = 0;
  for (int i = 0; i < steps; ++i)
    sum += f(PixelFilter::radius * (2 * (i + 0.5) / steps - 1)) * 2 * PixelFilter::radius / steps;
  return sum;
}

TEST(PixelFilter, weights_are_positive_even_and_sum_to_one) {
  EXPECT_NEAR(integral(PixelFilter::weight), 1, 1e-12);
  for (double x = 0; x < 2; x += 0.01) {
    EXPECT_GE(PixelFilter::weight(x), 0);
    EXPECT_NEAR(PixelFilter::weight(x), PixelFilter::weight(-x), 1e-15);
  }
  EXPECT_EQ(PixelFilter::weight(PixelFilter::radius), 0);
  EXPECT_NEAR(std::sqrt(integral([](double x) { return x * x * PixelFilter::weight(x); })), 0.4155,
              1e-4);
}

TEST(PixelFilter, samples_are_spread_as_the_weights_say) {
  const PixelFilter filter;
  double last = -PixelFilter::radius;
  for (int i = 0; i <= 1000; ++i) {
    const double u = std::min(i / 1000.0, 0x1.fffffffep-1);
    const double x = filter.offset(u);
    EXPECT_GE(x, last);
    EXPECT_LE(x, PixelFilter::radius);
    last = x;
    const double below = integral([&](double at) { return at < x ? PixelFilter::weight(at) : 0; });
    EXPECT_NEAR(below, u, 1e-3);
  }
  EXPECT_NEAR(filter.offset(0.5), 0, 1e-12);
  // A guess of the step would be most wrong here: the window's flat ends.
  EXPECT_EQ(filter.offset(0), -PixelFilter::radius);
  for (double u = 0x1p-32; u < 1e-3; u *= 1.5) {
    EXPECT_GT(filter.offset(1.5 * u), filter.offset(u));
    EXPECT_NEAR(filter.offset(u), -filter.offset(1 - u), 1e-6);
  }
}

}  // namespace
}  // namespace minkray
