// SPDX-License-Identifier: MIT
#include "core/world/world.h"

#include <gtest/gtest.h>

#include <random>

namespace minkray {
namespace {

template <class T>
class WorldOf : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(WorldOf, Scalars);

template <class T>
struct Random {
  std::mt19937 generator{5};
  T within(T low, T high) { return std::uniform_real_distribution<T>(low, high)(generator); }
  Vec3<T> point(T size) { return {within(-size, size), within(-size, size), within(-size, size)}; }
};

template <class T>
Instances<T> scattered_shapes(int count, Random<T>& random) {
  const std::vector<Shape<T>> kinds = {
      Sphere<T>{T(0.7)},
      Rounded<T>{T(0.1), Shape<T>(Box<T>{{T(0.6), T(0.5), T(0.3)}})},
      Ellipsoid<T>{{T(1), T(0.5), T(0.2)}},
      Cylinder<T>{T(0.3), T(0.8)},
      Disk<T>{T(0.8)},
      Triangle<T>{{Vec3<T>(0, 0, 0), Vec3<T>(1, 0, 0), Vec3<T>(0, 1, 0)}}};
  Instances<T> shapes;
  for (int i = 0; i < count; ++i) {
    const Vec3<T> axis = random.point(1);
    const Mat3<T> turn = rotation_matrix(axis.x(), axis.y(), axis.z(), random.within(-1, 1));
    shapes.add(kinds[static_cast<std::size_t>(i) % kinds.size()], Affine<T>{turn, random.point(6)});
  }
  return shapes;
}

template <class T>
Instances<T> only(const Shape<T>& shape) {
  Instances<T> instances;
  instances.add(shape);
  return instances;
}

TYPED_TEST(WorldOf, closest_hit_is_the_nearest_of_all_instances) {
  using T = TypeParam;
  Random<T> random;
  const World<T> world(scattered_shapes(110, random));
  int hits = 0, rays = 0;
  for (int i = 0; i < 2000; ++i, ++rays) {
    const Vec3<T> origin = random.point(12);
    const Ray<T> ray{origin, random.point(6) - origin};
    QueryCounts counts;
    const WorldHit<T> hit = world.closest_hit(ray, counts);
    T nearest = std::numeric_limits<T>::infinity();
    for (std::size_t k = 0; k < world.instances().size(); ++k)
      if (const CastResult<T> cast = cast_ray(world.instances().at(k), ray); cast.found())
        nearest = std::min(nearest, cast.t());
    ASSERT_EQ(hit.found(), nearest < std::numeric_limits<T>::infinity());
    EXPECT_EQ(counts.exhausted, 0u);
    EXPECT_GT(counts.nodes, 0u);
    EXPECT_LT(counts.casts, world.instances().size());
    if (!hit.found()) continue;
    ++hits;
    EXPECT_EQ(hit.cast.t(), nearest);
  }
  EXPECT_GT(hits, rays * 3 / 10);
  EXPECT_LT(hits, rays * 7 / 10);
}

TYPED_TEST(WorldOf, occlusion_agrees_with_the_closest_hit) {
  using T = TypeParam;
  Random<T> random;
  const World<T> world(scattered_shapes(110, random));
  QueryCounts counts;
  for (int i = 0; i < 2000; ++i) {
    const Vec3<T> origin = random.point(12);
    Ray<T> ray{origin, random.point(6) - origin};
    const WorldHit<T> hit = world.closest_hit(ray, counts);
    EXPECT_EQ(world.occluded(ray, counts), hit.found());
    if (hit.cast.status != Status::hit) continue;
    // Just before and just behind the hit point.
    const T step = T(64) * std::numeric_limits<T>::epsilon();
    ray.t_max = hit.cast.t() * (T(1) - step) - step;
    EXPECT_FALSE(world.occluded(ray, counts));
    ray.t_max = hit.cast.t() * (T(1) + step) + step;
    EXPECT_TRUE(world.occluded(ray, counts));
    // The shape that is left itself does not count.
    ray.t_max = hit.cast.t() * (T(1) + step) + step;
    const WorldHit<T> other = world.closest_hit(ray, counts, hit.instance);
    EXPECT_NE(other.instance, hit.instance);
    EXPECT_EQ(world.occluded(ray, counts, hit.instance), other.found());
  }
}

TYPED_TEST(WorldOf, empty_worlds_and_rays_from_inside) {
  using T = TypeParam;
  QueryCounts counts;
  const Ray<T> ray{{0, 0, 0}, {1, 0, 0}};
  EXPECT_FALSE(World<T>().closest_hit(ray, counts).found());
  EXPECT_FALSE(World<T>().occluded(ray, counts));
  EXPECT_EQ(World<T>().closest_hit(ray, counts).cast.status, Status::miss);

  const World<T> around(only<T>(Sphere<T>{T(1)}));
  EXPECT_EQ(around.closest_hit(ray, counts).cast.status, Status::inside);
  EXPECT_EQ(around.closest_hit(ray, counts).cast.t(), T(0));
  EXPECT_TRUE(around.occluded(ray, counts));
}

// A solver that gives up must be seen: the reader of a picture trusts its black.
TYPED_TEST(WorldOf, exhausted_casts_are_counted_and_taken_for_neither) {
  using T = TypeParam;
  CastOptions<T> impatient;
  impatient.solver = SolverKind::paper;
  impatient.max_iterations = 1;
  const World<T> world(only<T>(Box<T>{{1, 1, 1}}), impatient);
  QueryCounts counts;
  const WorldHit<T> hit = world.closest_hit({{-3, T(0.2), T(0.1)}, {1, 0, 0}}, counts);
  EXPECT_FALSE(hit.found());
  EXPECT_EQ(counts.casts, 1u);
  EXPECT_EQ(counts.exhausted, 1u);
}

}  // namespace
}  // namespace minkray
