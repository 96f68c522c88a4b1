// SPDX-License-Identifier: MIT
// Reliefs bend normals as the surface that they represent would have them.
#include "renderer/surfaces/relief_normal.h"

#include <gtest/gtest.h>

namespace minkray {
namespace {

/// A picture that is linear, so that its numbers are what they are.
Paint picture(const Image& image, const char* mapping) {
  return Paint(
      TextureKind(ImageTexture{{"x.exr", std::make_shared<const Image>(image)}, {mapping}, 1}));
}

TEST(Relief, a_ramp_leans_as_steep_as_it_is) {
  Relief relief;
  GradientTexture rise;
  rise.a = Colour::Zero();
  rise.b = Colour::Ones();
  rise.scale = 2;
  rise.direction = {3, 0, 0};
  relief.bump = Paint(TextureKind(rise));
  relief.bump_height = 0.5;  // over a length of 2
  const Vec3<double> normal = relief_normal(relief, {{0.1, 0.7, 0}, Vec3<double>::UnitZ()});
  EXPECT_NEAR((normal - unit<double>({-0.25, 0, 1})).norm(), 0, 1e-6);
}

TEST(Relief, without_a_slope_along_the_surface_nothing_is_bent) {
  Relief relief;
  GradientTexture rise;
  rise.direction = {0, 0, 1};
  relief.bump = Paint(TextureKind(rise));
  const Vec3<double> normal = relief_normal(relief, {{0.1, 0.7, 0}, Vec3<double>::UnitZ()});
  EXPECT_NEAR((normal - Vec3<double>::UnitZ()).norm(), 0, 1e-12);
}

TEST(Relief, pictures_of_normals_lean_to_the_right_and_up) {
  for (const char* mapping : {"box", "radial", "normal"}) {
    // On the side that faces +x, +y is on the right and +z up.
    const TexturePoint at{{2, 0, 0}, Vec3<double>::UnitX()};
    const auto bent = [&](const Vec3<float>& code) {
      Relief relief;
      relief.normal_map = picture(Image(4, 4, code), mapping);
      return relief_normal(relief, at);
    };
    EXPECT_NEAR((bent({0.5F, 0.5F, 1}) - Vec3<double>::UnitX()).norm(), 0, 1e-6) << mapping;
    EXPECT_NEAR((bent({0.8F, 0.5F, 0.9F}) - Vec3<double>(0.8, 0.6, 0)).norm(), 0, 1e-6) << mapping;
    EXPECT_NEAR((bent({0.5F, 0.8F, 0.9F}) - Vec3<double>(0.8, 0, 0.6)).norm(), 0, 1e-6) << mapping;
  }
}

// A globe: east of a place is on its right, seen from outside.
TEST(Relief, radial_pictures_are_not_mirrored) {
  Image globe(64, 32);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x) globe.at(x, y).setConstant(static_cast<float>(x) / 63.0F);
  const Paint paint = picture(globe, "radial");
  const auto at = [&](const Vec3<double>& p) { return paint_at(paint, {p, unit(p)}).x(); };
  EXPECT_LT(at({1, -0.2, 0}), at({1, 0, 0}));
  EXPECT_LT(at({1, 0, 0}), at({1, 0.2, 0}));
}

}  // namespace
}  // namespace minkray
