// SPDX-License-Identifier: MIT
#include "renderer/image/tone_map.h"

#include <gtest/gtest.h>

namespace minkray {
namespace {

TEST(ToneMap, each_keeps_black_and_rises_to_white_and_no_further) {
  for (const auto& map : tone_maps) {
    EXPECT_LT(tone_mapped(map.kind, {0, 0, 0}).maxCoeff(), 1e-3) << map.name;
    double last = -1;
    for (double light = 1e-3; light < 100; light *= 1.3) {
      const double shown = tone_mapped(map.kind, Vec3<double>::Constant(light)).y();
      EXPECT_GE(shown, last) << map.name << " " << light;
      last = shown;
    }
    if (map.kind != ToneMap::srgb) {
      EXPECT_LE(last, 1.0) << map.name;
      EXPECT_GT(last, 0.9) << map.name;
      // Greys stay grey.
      const Vec3<double> grey = tone_mapped(map.kind, Vec3<double>::Constant(0.4));
      EXPECT_NEAR(grey.maxCoeff() - grey.minCoeff(), 0, 1e-3) << map.name;
    }
  }
}

TEST(ToneMap, agx_fades_bright_colours_to_white) {
  const Vec3<double> dim = tone_mapped(ToneMap::agx, {0.2, 0.01, 0.01});
  const Vec3<double> bright = tone_mapped(ToneMap::agx, {20, 1, 1});
  EXPECT_GT(dim.x() / dim.y(), 2 * bright.x() / bright.y());
}

}  // namespace
}  // namespace minkray
