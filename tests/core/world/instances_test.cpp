// SPDX-License-Identifier: MIT
#include "core/world/instances.h"

#include <gtest/gtest.h>

#include <random>

#include "core/cast/cast.h"
#include "tests/support/shifted.h"

namespace minkray {
namespace {

struct Random {
  std::mt19937 generator{11};
  double next() { return std::uniform_real_distribution<double>(-1, 1)(generator); }
  Vec3<double> vector() { return {next(), next(), next()}; }
  Affine<double> pose() {
    const Mat3<double> turn = rotation_matrix_of_any(next(), next(), next(), next());
    return {turn * Vec3<double>(1.5 + next(), 1, 2).asDiagonal(), 5 * vector()};
  }
};

void expect_same_cast(const PreparedShape& a, const PreparedShape& b, const Ray<double>& ray,
                      int& hits) {
  const CastResult<double> x = cast_ray(a, ray), y = cast_ray(b, ray);
  ASSERT_EQ(x.status, y.status);
  EXPECT_EQ(x.t_base, y.t_base);
  EXPECT_EQ(x.t_offset, y.t_offset);
  EXPECT_EQ(x.normal, y.normal);
  EXPECT_EQ(x.supports, y.supports);
  hits += x.found();
}

/// Plain, under two maps, and so small that it is brought to another size.
std::vector<Shape> shapes(Random& random) {
  const Shape box = Rounded{0.2, Shape(Box{{1, 0.5, 0.4}})};
  const Shape once = Transform{box, random.pose()};
  return {
      Sphere{1}, box, Transform{once, random.pose()},
      Transform{Shape(Sphere{1e-6}), Affine<double>{Mat3<double>::Identity() * 1e6, {0, 0, 0}}}};
}

// A shared definition is to save memory, and nothing else.
TEST(Instances, posed_definitions_are_cast_at_bit_for_bit_as_shapes_of_their_own) {
  Random random;
  int hits = 0, rays = 0;
  for (const Shape& shape : shapes(random)) {
    std::vector<Affine<double>> poses(50);
    for (Affine<double>& pose : poses) pose = random.pose();
    poses[7].linear = Mat3<double>::Identity();
    Instances many, one_by_one;
    many.add_many(many.define(shape), poses.size(), [&](std::size_t i) { return poses[i]; });
    const std::uint32_t definition = one_by_one.define(shape);
    for (const Affine<double>& pose : poses) one_by_one.add(definition, pose);
    for (std::size_t i = 0; i < poses.size(); ++i)
      for (int k = 0; k < 20; ++k, ++rays) {
        const PreparedShape own(shape, poses[i]);
        const Vec3<double> origin = 12 * random.vector();
        const Vec3<double> aim = own.centre() + 1.2 * random.vector();
        const Ray<double> ray{origin, aim - origin};
        int unused = 0;
        expect_same_cast(own, many.at(i), ray, hits);
        expect_same_cast(own, one_by_one.at(i), ray, unused);
      }
  }
  EXPECT_GT(hits, rays * 3 / 10);
  EXPECT_LT(hits, rays * 95 / 100);
}

TEST(Instances, equal_shapes_share_a_definition) {
  Instances instances;
  const Shape box = Box{{1, 2, 3}};
  const std::uint32_t first = instances.define(Rounded{0.1, box});
  EXPECT_EQ(instances.define(Rounded{0.1, Shape(Box{{1, 2, 3}})}), first);
  EXPECT_NE(instances.define(Rounded{0.2, box}), first);
  EXPECT_NE(instances.define(box), first);
  const auto made = [&] {
    return std::make_shared<const ShapeDefinition>(Shape(Rounded{0.1, box}));
  };
  EXPECT_EQ(instances.define(made()), first);
  EXPECT_EQ(instances.define(made()), first);
  EXPECT_EQ(instances.definitions(), 3u);
  for (int i = 0; i < 10; ++i)
    instances.add(Shape(Sphere{double(1 + i % 2)}), shifted_by(double(i), 0, 0));
  EXPECT_EQ(instances.definitions(), 5u);
}

TEST(Instances, plain_poses_are_returned_as_they_were_given) {
  Random random;
  Instances instances;
  const std::uint32_t cone = instances.define(Cone{1, 2});
  std::vector<Affine<double>> poses;
  int plain = 0;
  for (int i = 0; i < 1000; ++i) {
    Affine<double> pose{
        rotation_matrix_of_any(random.next(), random.next(), random.next(), random.next()),
        1e6 * random.vector()};
    if (i % 10 == 0) pose.linear = Mat3<double>::Identity();
    if (i % 10 == 1) pose.linear(0, 0) += 1e-3;
    poses.push_back(pose);
    instances.add(cone, pose);
  }
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::optional<Affine<double>> pose = instances.plain_pose(i);
    if (pose) {
      EXPECT_EQ(*pose, poses[i]);
      ++plain;
    } else {
      EXPECT_FALSE(keeps_lengths(poses[i].linear));
    }
  }
  EXPECT_GT(plain, 600);
}

// Numbers below float's normal range are kept with the map.
TEST(Instances, maps_that_float_does_not_hold_are_kept_in_full) {
  const Affine<double> pose{Vec3<double>(1e50, 1e-3, 1).asDiagonal(), {1, 2, 3}};
  const Shape shape = Box{{1, 1, 1}};
  Instances instances;
  instances.add(shape, pose);
  const PreparedShape own(shape, pose), posed = instances.at(0);
  EXPECT_EQ(*posed.linear_to_inner(), *own.linear_to_inner());
  EXPECT_EQ(posed.centre(), own.centre());
  EXPECT_FALSE(instances.plain_pose(0).has_value());
}

// Memory of a million instances: 64 bytes each for the place, 36 for the last digits of the
// rotation.
TEST(Instances, an_instance_costs_its_pose_however_large_its_shape) {
  Random random;
  std::vector<Vec3<double>> points(1000);
  for (Vec3<double>& point : points) point = random.vector();
  Instances hulls;
  const std::size_t count = 10000;
  hulls.add_many(hulls.define(Hull{PointCloud(points)}), count, [&](std::size_t i) {
    return Affine<double>{Mat3<double>(rotation_matrix(1.0, 2.0, 3.0, double(i))),
                          {double(i), 0, 0}};
  });
  EXPECT_EQ(hulls.take_boxes().size(), count);
  EXPECT_LE(hulls.bytes(), count * 100 + 8000);
  EXPECT_EQ(hulls.definitions(), 1u);
}

// Bounds are from supports: a turned box's are those of its corners, not of its ball.
TEST(Instances, boxes_hold_their_instances_tightly) {
  Random random;
  Instances instances;
  std::vector<Affine<double>> poses;
  const Vec3<double> half(1, 2, 3);
  for (int i = 0; i < 200; ++i) {
    poses.push_back(random.pose());
    instances.add(Box{half}, poses.back());
  }
  const FirstTouchVector<Bounds<float>> boxes = instances.take_boxes();
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Vec3<double> extent = poses[i].linear.cwiseAbs() * half;
    const Vec3<double> centre = poses[i].translation;
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
