// SPDX-License-Identifier: MIT
#include "core/world/instances.h"

#include <gtest/gtest.h>

#include <random>

#include "core/cast/cast.h"

namespace minkray {
namespace {

template <class T>
class InstancesOf : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(InstancesOf, Scalars);

template <class T>
struct Random {
  std::mt19937 generator{11};
  T next() { return std::uniform_real_distribution<T>(-1, 1)(generator); }
  Vec3<T> vector() { return {next(), next(), next()}; }
  Affine<T> pose() {
    const Mat3<T> turn = rotation_matrix_of_any(next(), next(), next(), next());
    return {turn * Vec3<T>(T(1.5) + next(), 1, 2).asDiagonal(), T(5) * vector()};
  }
};

template <class T>
void expect_same_cast(const PreparedShape<T>& a, const PreparedShape<T>& b, const Ray<T>& ray,
                      int& hits) {
  const CastResult<T> x = cast_ray(a, ray), y = cast_ray(b, ray);
  ASSERT_EQ(x.status, y.status);
  EXPECT_EQ(x.t_base, y.t_base);
  EXPECT_EQ(x.t_offset, y.t_offset);
  EXPECT_EQ(x.normal, y.normal);
  EXPECT_EQ(x.supports, y.supports);
  hits += x.found();
}

/// Plain, under two maps, and so small that it is brought to another size.
template <class T>
std::vector<Shape<T>> shapes(Random<T>& random) {
  const Shape<T> box = Rounded<T>{T(0.2), Shape<T>(Box<T>{{1, T(0.5), T(0.4)}})};
  const Shape<T> once = Transform<T>{box, random.pose()};
  return {Sphere<T>{1}, box, Transform<T>{once, random.pose()},
          Transform<T>{Shape<T>(Sphere<T>{T(1e-6)}),
                       Affine<T>{Mat3<T>::Identity() * T(1e6), {0, 0, 0}}}};
}

// A shared definition is to save memory, and nothing else.
TYPED_TEST(InstancesOf, posed_definitions_are_cast_at_bit_for_bit_as_shapes_of_their_own) {
  using T = TypeParam;
  Random<T> random;
  int hits = 0, rays = 0;
  for (const Shape<T>& shape : shapes(random)) {
    std::vector<Affine<T>> poses(50);
    for (Affine<T>& pose : poses) pose = random.pose();
    poses[7].linear = Mat3<T>::Identity();
    Instances<T> many, one_by_one;
    many.add_many(many.define(shape), poses.size(), false, [&](std::size_t i) { return poses[i]; });
    const std::uint32_t definition = one_by_one.define(shape);
    for (const Affine<T>& pose : poses) one_by_one.add(definition, pose);
    for (std::size_t i = 0; i < poses.size(); ++i)
      for (int k = 0; k < 20; ++k, ++rays) {
        const PreparedShape<T> own(shape, poses[i]);
        const Vec3<T> origin = T(12) * random.vector();
        const Vec3<T> aim = own.centre() + T(1.2) * random.vector();
        const Ray<T> ray{origin, aim - origin};
        int unused = 0;
        expect_same_cast(own, many.at(i), ray, hits);
        expect_same_cast(own, one_by_one.at(i), ray, unused);
      }
  }
  EXPECT_GT(hits, rays * 3 / 10);
  EXPECT_LT(hits, rays * 95 / 100);
}

TYPED_TEST(InstancesOf, poses_that_differ_in_translation_share_their_linear_part) {
  using T = TypeParam;
  Random<T> random;
  const Affine<T> first = random.pose();
  for (const Shape<T>& shape : shapes(random)) {
    Instances<T> alike, different;
    const auto pose_of = [&](std::size_t i) { return Affine<T>{first.linear, {T(i), T(0), T(0)}}; };
    alike.add_many(alike.define(shape), 1000, true, pose_of);
    different.add_many(different.define(shape), 1000, false, pose_of);
    EXPECT_LT(alike.bytes(), different.bytes() * 6 / 10);
    int hits = 0;
    for (std::size_t i : {0u, 1u, 999u}) {
      const Vec3<T> aim = PreparedShape<T>(shape, pose_of(i)).centre();
      const Ray<T> ray{aim + Vec3<T>(0, 10, 20), Vec3<T>(0, -10, -20)};
      expect_same_cast(alike.at(i), different.at(i), ray, hits);
    }
    EXPECT_EQ(hits, 3);
  }
}

// What a million costs: 32 bytes for where it is, 80 for how it is turned, in double.
TYPED_TEST(InstancesOf, an_instance_costs_its_pose_however_large_its_shape) {
  using T = TypeParam;
  Random<T> random;
  std::vector<Vec3<T>> points(1000);
  for (Vec3<T>& point : points) point = random.vector();
  Instances<T> hulls;
  const std::size_t count = 10000;
  hulls.add_many(hulls.define(Hull<T>{PointCloud<T>(points)}), count, false, [&](std::size_t i) {
    return Affine<T>{Mat3<T>(rotation_matrix(T(1), T(2), T(3), T(i))), {T(i), 0, 0}};
  });
  EXPECT_EQ(hulls.take_boxes().size(), count);
  const std::size_t pose = 12 * sizeof(T) + sizeof(T) + 2 * sizeof(std::uint32_t);
  EXPECT_LE(hulls.bytes(), count * pose + 2000);
  EXPECT_EQ(hulls.definitions(), 1u);
}

// Bounds are from supports: a turned box's are those of its corners, not of its ball.
TYPED_TEST(InstancesOf, boxes_hold_their_instances_tightly) {
  using T = TypeParam;
  Random<T> random;
  Instances<T> instances;
  std::vector<Affine<T>> poses;
  const Vec3<T> half(1, 2, 3);
  for (int i = 0; i < 200; ++i) {
    poses.push_back(random.pose());
    instances.add(Box<T>{half}, poses.back());
  }
  const FirstTouchVector<Bounds<float>> boxes = instances.take_boxes();
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Vec3<double> extent =
        poses[i].linear.template cast<double>().cwiseAbs() * half.template cast<double>();
    const Vec3<double> centre = poses[i].translation.template cast<double>();
    const double slack = 1e-5 * (extent.maxCoeff() + centre.norm());
    const double rounding = 1e-6 * slack;
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_LE(double(boxes[i].lower[axis]), centre[axis] - extent[axis] + rounding);
      EXPECT_GE(double(boxes[i].lower[axis]), centre[axis] - extent[axis] - slack);
      EXPECT_GE(double(boxes[i].upper[axis]), centre[axis] + extent[axis] - rounding);
      EXPECT_LE(double(boxes[i].upper[axis]), centre[axis] + extent[axis] + slack);
      EXPECT_GE(double(instances.half_extent(i)), extent.maxCoeff() - slack);
      EXPECT_LE(double(instances.half_extent(i)), extent.maxCoeff() + slack);
    }
  }
}

}  // namespace
}  // namespace minkray
