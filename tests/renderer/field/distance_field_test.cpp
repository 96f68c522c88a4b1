// SPDX-License-Identifier: MIT
// Compares pictures of distances with closed forms, and checks pixels where a distance is unknown.
#include "renderer/field/distance_field.h"

#include <gtest/gtest.h>

#include "renderer/field/field_picture.h"

namespace minkray {
namespace {

constexpr int width = 8, height = 6;
constexpr double infinity = std::numeric_limits<double>::infinity();

Object ball_at(double x, double radius) {
  Object object;
  object.shape = Sphere{radius};
  object.pose.translation = Vec3<double>(x, 0, 0);
  return object;
}

DistanceField field_of(const std::vector<Object>& objects) {
  Scene scene;
  scene.objects = objects;
  const FieldPlane plane =
      plane_facing(Vec3<double>(0, 0, 0), Vec3<double>(0, 0, 1), 4, width, height);
  return measure_field(scene, Point(), plane, {});
}

/// Calls f(pixel, its place).
template <class F>
void for_each_pixel(const DistanceField& field, const F& f) {
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      f(static_cast<std::size_t>(y * width + x), field.plane.at(x, y));
}

TEST(DistanceField, is_the_distance_of_the_nearest) {
  const DistanceField field = field_of({ball_at(-1, 0.5), ball_at(1, 0.5)});
  for_each_pixel(field, [&](std::size_t pixel, const Vec3<double>& at) {
    const double exact = (at - Vec3<double>(at.x() < 0 ? -1 : 1, 0, 0)).norm() - 0.5;
    EXPECT_NEAR(field.value[pixel], exact, 1e-12);
    EXPECT_LE(field.lower[pixel], exact);
    EXPECT_GE(field.upper[pixel], exact);
    EXPECT_EQ(field.object[pixel], at.x() < 0 ? 0 : 1);
    EXPECT_FALSE(field.is_unknown(pixel));
  });
}

/// A distance that did not converge has the value 0: with a ball at 1e200 as the first object it
/// touched every pixel.
TEST(DistanceField, an_object_too_far_for_a_distance_is_not_the_nearest) {
  const Object far = ball_at(1e200, 1), near = ball_at(0, 0.5);
  for (const bool is_far_first : {true, false}) {
    const DistanceField field = is_far_first ? field_of({far, near}) : field_of({near, far});
    for_each_pixel(field, [&](std::size_t pixel, const Vec3<double>& at) {
      EXPECT_NEAR(field.value[pixel], at.norm() - 0.5, 1e-12);
      EXPECT_NEAR(field.lower[pixel], at.norm() - 0.5, 1e-12);
      EXPECT_EQ(field.object[pixel], is_far_first ? 1 : 0);
      EXPECT_FALSE(field.is_unknown(pixel));
    });
  }
}

TEST(DistanceField, what_is_unknown_is_told_and_grey) {
  const Object infinite = ball_at(0, infinity), far = ball_at(1e200, 1), near = ball_at(0, 0.5);
  for (const std::vector<Object>& objects : {std::vector{infinite, near}, {near, infinite}}) {
    const DistanceField field = field_of(objects);
    const Image picture = field_picture(field, "");
    for_each_pixel(field, [&](std::size_t pixel, const Vec3<double>& at) {
      EXPECT_TRUE(field.is_unknown(pixel));
      EXPECT_EQ(field.object[pixel], -1);
      EXPECT_EQ(field.lower[pixel], -infinity);
      EXPECT_NEAR(field.value[pixel], at.norm() - 0.5, 1e-12);
      const int x = static_cast<int>(pixel) % width, y = static_cast<int>(pixel) / width;
      EXPECT_EQ(picture.at(x, y), Vec3<float>::Constant(picture.at(0, 0).x()));
    });
  }
  const DistanceField alone = field_of({far});
  for_each_pixel(alone, [&](std::size_t pixel, const Vec3<double>&) {
    EXPECT_TRUE(alone.is_unknown(pixel));
    EXPECT_EQ(alone.value[pixel], infinity);
    EXPECT_GT(alone.lower[pixel], 0.9e200);
  });
}

TEST(DistanceField, of_nothing_is_infinite) {
  const DistanceField field = field_of({});
  for_each_pixel(field, [&](std::size_t pixel, const Vec3<double>&) {
    EXPECT_EQ(field.lower[pixel], infinity);
    EXPECT_FALSE(field.is_unknown(pixel));
  });
}

}  // namespace
}  // namespace minkray
