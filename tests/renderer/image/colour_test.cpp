// SPDX-License-Identifier: MIT
#include "renderer/image/colour.h"

#include <gtest/gtest.h>

#include "renderer/image/colour_map.h"

namespace minkray {
namespace {

TEST(Colour, srgb_there_and_back) {
  for (int code = 0; code < 256; ++code) {
    const double linear = from_srgb(code / 255.0);
    EXPECT_NEAR(to_srgb(linear), code / 255.0, 1e-6);  // the standard's own seam is this wide
    EXPECT_EQ(to_srgb8(linear), code);
  }
  EXPECT_NEAR(to_srgb(0.18), 0.4613561295, 1e-9);  // middle grey
  EXPECT_NEAR(to_srgb(0.5), 0.7353569831, 1e-9);
}

TEST(Colour, codes_are_clipped_and_nan_is_black) {
  EXPECT_EQ(to_srgb8(-1), 0);
  EXPECT_EQ(to_srgb8(0), 0);
  EXPECT_EQ(to_srgb8(1), 255);
  EXPECT_EQ(to_srgb8(std::numeric_limits<double>::infinity()), 255);
  EXPECT_EQ(to_srgb8(std::nan("")), 0);
}

// The published table's ends (0, 0, 4) and (252, 255, 164), within what the fit is off by.
TEST(ColourMap, inferno_ends_where_it_was_published_to_end) {
  const auto code = [](double value, int channel) {
    return static_cast<int>(to_srgb8(static_cast<double>(inferno(value)[channel])));
  };
  const int low[3] = {0, 0, 4}, high[3] = {252, 255, 164};
  for (int channel = 0; channel < 3; ++channel) {
    EXPECT_NEAR(code(0, channel), low[channel], 5);
    EXPECT_NEAR(code(1, channel), high[channel], 5);
  }
  EXPECT_EQ(inferno(-3), inferno(0));
  EXPECT_EQ(inferno(7), inferno(1));
  EXPECT_EQ(inferno(std::nan("")), inferno(0));
}

TEST(ColourMap, more_is_lighter) {
  const auto luminance = [](double value) {
    return inferno(value).dot(Vec3<float>(0.2126f, 0.7152f, 0.0722f));
  };
  for (int i = 1; i <= 255; ++i) EXPECT_GT(luminance(i / 255.0), luminance((i - 1) / 255.0)) << i;
}

}  // namespace
}  // namespace minkray
