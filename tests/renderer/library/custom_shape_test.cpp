// SPDX-License-Identifier: MIT
// A shape that is given by its support function is cast at, proven and measured as one of ours; an
// inconsistent function is found and reported.
#include <gtest/gtest.h>
#include <minkray/minkray.h>
#include <sys/resource.h>

#include <atomic>
#include <cmath>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/renderer/library/errors.h"
#include "tests/renderer/library/rays.h"
#include "tests/renderer/library/same_answers.h"

namespace {

namespace mk = minkray;
using mk::Vec3;

Vec3 box_support(const Vec3& n) {
  return {std::copysign(0.5, n.x), std::copysign(0.3, n.y), std::copysign(0.2, n.z)};
}

/// The cylinder of FCL's issue 642: x^2 + y^2 <= 0.49, cut by two oblique planes.
constexpr mk::CutPlanes cuts = {-0.5, 0.6, {0.2, -0.3}, {-0.5, 0.4}};
Vec3 cut_cylinder_support(const Vec3& n) {
  constexpr double radius = 0.7;
  const auto rim = [&](double height, const double(&slope)[2]) -> Vec3 {
    const double x = n.x + n.z * slope[0], y = n.y + n.z * slope[1], length = std::hypot(x, y);
    const double px = length > 0 ? radius * x / length : radius;
    const double py = length > 0 ? radius * y / length : 0;
    return {px, py, height + slope[0] * px + slope[1] * py};
  };
  const Vec3 lower = rim(cuts.lower_height, cuts.lower_slope);
  const Vec3 upper = rim(cuts.upper_height, cuts.upper_slope);
  const auto along = [&](const Vec3& p) { return n.x * p.x + n.y * p.y + n.z * p.z; };
  return along(upper) > along(lower) ? upper : lower;
}

TEST(CustomShape, of_a_box_is_met_where_the_box_is) {
  expect_same_answers(mk::box({0.5, 0.3, 0.2}), mk::custom(box_support), 0.8, 20000);
}

TEST(CustomShape, of_a_cylinder_cut_by_oblique_planes_is_met_where_ours_is) {
  expect_same_answers(mk::cut_cylinder(0.7, cuts), mk::custom(cut_cylinder_support), 2, 100000);
}

TEST(CustomShape, may_stand_wherever_a_shape_may) {
  const mk::Shape box = mk::box({0.5, 0.3, 0.2}), custom = mk::custom(box_support);
  const mk::Pose turned = mk::pose({0.1, 0.2, 0.3}, {0.1, 0.2, 0.3, 0.9});
  const auto nest = [&](const mk::Shape& shape) {
    return mk::hull_of({mk::sum(mk::transformed(shape, turned), mk::sphere(0.1)),
                        mk::rounded(mk::scaled(shape, Vec3{1, 0.5, 0.5}), 0.05),
                        mk::difference(mk::point({0.2, 0, 0}), shape)});
  };
  expect_same_answers(nest(box), nest(custom), 1.2, 4000);
}

TEST(CustomShape, is_as_far_from_others_as_ours_is) {
  const mk::Shape box = mk::box({0.5, 0.3, 0.2}), custom = mk::custom(box_support);
  const mk::Shape other = mk::capsule(0.2, 0.5);
  const mk::Pose turned = mk::pose({0, 0, 0}, {0.1, 0.2, 0.3, 0.9});
  for (const double x : {0.4, 0.6, 0.9, 2.0}) {
    const mk::Pose pose = mk::pose({x, 0.1, 0.2}, {0.3, -0.1, 0.2, 0.8});
    const mk::Distance a = mk::signed_distance(box, turned, other, pose);
    const mk::Distance b = mk::signed_distance(custom, turned, other, pose);
    EXPECT_LE(a.lower, b.upper) << x;
    EXPECT_LE(b.lower, a.upper) << x;
    EXPECT_NEAR(a.value, b.value, 1e-9) << x;
  }
  const mk::Twist twist = {{-1, 0, 0}, {0, 0.5, 1}};
  const mk::Impact a =
      mk::time_of_impact(box, turned, {}, other, mk::translation({3, 0, 0}), twist, 5);
  const mk::Impact b =
      mk::time_of_impact(custom, turned, {}, other, mk::translation({3, 0, 0}), twist, 5);
  ASSERT_EQ(a.status, MINKRAY_IMPACT);
  ASSERT_EQ(b.status, MINKRAY_IMPACT);
  EXPECT_NEAR(a.t_lo, b.t_lo, 1e-8);
}

TEST(CustomShape, keeps_its_function_as_long_as_a_scene_needs_it) {
  struct Counted {
    int* alive;
    explicit Counted(int* count) : alive(count) { ++*alive; }
    Counted(const Counted& other) : alive(other.alive) { ++*alive; }
    ~Counted() { --*alive; }
    Vec3 operator()(const Vec3& n) const { return box_support(n); }
  };
  int alive = 0;
  {
    mk::Scene scene;
    scene.add(mk::custom(Counted(&alive)));
    EXPECT_EQ(alive, 1);
    scene.commit();
    EXPECT_EQ(scene.cast({{-5, 0, 0}, {1, 0, 0}}).t, 4.5);
  }
  EXPECT_EQ(alive, 0);
}

/// Error of making a custom shape of the function; empty if it is accepted.
template <class Support>
std::string refusal(Support support) {
  return error_of([&] { mk::custom(support); }, MINKRAY_BAD_SUPPORT);
}

TEST(CustomShape, of_a_function_that_lies_is_refused) {
  EXPECT_TRUE(has(refusal([](const Vec3& n) { return Vec3{-n.x, -n.y, -n.z}; }), "not maximal"));
  EXPECT_TRUE(has(refusal([](const Vec3& n) { return Vec3{n.x, NAN, n.z}; }), "not finite"));
  EXPECT_TRUE(has(refusal([](const Vec3& n) { return Vec3{n.x, INFINITY, n.z}; }), "not finite"));
  EXPECT_TRUE(has(refusal([](const Vec3&) -> Vec3 { throw std::runtime_error("no"); }), "failed"));
  // A box whose corners are rounded to float but for some: the error is 1e-8.
  EXPECT_TRUE(
      has(refusal([](const Vec3& n) {
            const double x = n.y > 0.3 ? 0.3 : double(0.3f);
            return Vec3{std::copysign(x, n.x), std::copysign(0.3, n.y), std::copysign(1, n.z)};
          }),
          "not maximal"));
  int calls = 0;
  EXPECT_TRUE(has(refusal([&calls](const Vec3& n) {
                    const double wander = 1e-14 * (++calls % 7);
                    return Vec3{n.x + wander, n.y, n.z};
                  }),
                  "once"));
  EXPECT_EQ(refusal(box_support), "");
  EXPECT_EQ(refusal([](const Vec3&) { return Vec3{3, 4, 5}; }), "");  // a point is a shape
}

TEST(CustomShape, out_of_its_bounds_is_refused) {
  EXPECT_NO_THROW(mk::custom(box_support, {-0.5, -0.3, -0.2}, {0.5, 0.3, 0.2}));
  EXPECT_THROW(mk::custom(box_support, {-0.5, -0.3, -0.2}, {0.5, 0.3, 0.1}), mk::Error);
  EXPECT_THROW(mk::custom(box_support, {0.5, -0.3, -0.2}, {-0.5, 0.3, 0.1}), mk::Error);
}

/// A box in the directions of the first calls, with wrong results in a narrow cone: a point within
/// the box.
Vec3 sly_support(const Vec3& n) {
  const double cosine = (n.x * 0.83 + n.y * 0.41 + n.z * 0.37) / std::hypot(0.83, 0.41, 0.37);
  return cosine > 0.9995 ? Vec3{0.1, 0.1, 0.1} : box_support(n);
}

TEST(CustomShape, that_lies_later_on_ends_the_query_with_an_error) {
  const mk::Shape sly = mk::custom(sly_support);
  EXPECT_TRUE(has(error_of(
                      [&] {
                        sly.support({0.83, 0.41, 0.37});
                      },
                      MINKRAY_BAD_SUPPORT),
                  "not maximal"));
  EXPECT_THROW(sly.support({1, 0, 0}), mk::Error);  // and is not forgotten
}

TEST(CustomShape, that_throws_in_the_middle_of_a_cast_ends_the_cast_with_an_error) {
  bool throws = false;
  mk::Scene scene;
  scene.add(mk::custom([&throws](const Vec3& n) {
    if (throws) throw std::runtime_error("no more");
    return box_support(n);
  }));
  scene.commit();
  const std::vector<mk::Ray> rays = rays_around({0, 0, 0}, 1, 100);
  std::vector<mk::Hit> hits(rays.size());
  scene.cast(rays, hits);
  throws = true;
  EXPECT_THROW(scene.cast(rays, hits), mk::Error);
  std::vector<mk::Proof> proofs(rays.size());
  EXPECT_THROW(scene.prove(rays, hits, proofs), mk::Error);
}

/// Counts how often it is called, and with how many directions.
struct CountedBatch {
  std::atomic<std::size_t>*calls, *directions;
  const bool* fails = nullptr;
  void operator()(mk::View<const Vec3> n, mk::View<Vec3> points) const {
    ++*calls;
    *directions += n.size();
    if (fails && *fails) throw std::runtime_error("no more");
    for (std::size_t i = 0; i < n.size(); ++i) points[i] = cut_cylinder_support(n[i]);
  }
};

TEST(CustomShape, that_is_gathered_answers_the_same_bits_in_fewer_calls) {
  std::atomic<std::size_t> calls[2] = {0, 0}, directions[2] = {0, 0};
  const std::vector<mk::Ray> rays = rays_around({0, 0, 0}, 2, 10000);
  std::vector<mk::Hit> hits[2];
  std::vector<mk::Proof> proofs[2];
  std::vector<std::uint8_t> blocked[2];
  for (const std::size_t gathered : {0, 1000}) {
    const std::size_t i = gathered > 0;
    mk::Scene scene;
    const mk::Shape shape = mk::custom_batched(CountedBatch{&calls[i], &directions[i]}, gathered);
    // Two of them, one in the other's way, and one of ours.
    scene.add(shape);
    scene.add(
        mk::rounded(mk::custom_batched(CountedBatch{&calls[i], &directions[i]}, gathered), 0.1),
        mk::translation({1, 0.5, 0}));
    scene.add(mk::sphere(0.5), mk::translation({-1, 0, 0}));
    scene.commit();
    calls[i] = directions[i] = 0;
    hits[i].resize(rays.size());
    proofs[i].resize(500);
    blocked[i].resize(rays.size());
    scene.cast(rays, hits[i]);
    scene.occluded(rays, blocked[i]);
    scene.prove({rays.data(), 500}, {hits[i].data(), 500}, proofs[i]);
  }
  EXPECT_GT(directions[1], 20000u);
  // Rays that wait for each other are cut in smaller parts, in which other rays share packets.
  const auto count = [&](std::size_t i) { return static_cast<double>(directions[i].load()); };
  EXPECT_NEAR(count(0), count(1), 0.02 * count(0));
  EXPECT_LT(calls[1] * 10, calls[0]) << calls[0] << " calls become " << calls[1];
  std::size_t met = 0;
  for (std::size_t k = 0; k < rays.size(); ++k) {
    ASSERT_EQ(std::memcmp(&hits[0][k], &hits[1][k], sizeof(mk::Hit)), 0) << k;
    met += hits[0][k].found();
  }
  EXPECT_GT(met, rays.size() / 4);
  EXPECT_LT(met, rays.size() * 3 / 4);
  EXPECT_EQ(blocked[0], blocked[1]);
  for (std::size_t k = 0; k < proofs[0].size(); ++k) {
    EXPECT_TRUE(proofs[0][k].holds) << k << ": " << proofs[0][k].complaint;
    ASSERT_EQ(std::memcmp(&proofs[0][k], &proofs[1][k], sizeof(mk::Proof)), 0) << k;
  }
}

TEST(CustomShape, that_is_gathered_and_throws_ends_the_cast_with_an_error) {
  std::atomic<std::size_t> calls = 0, directions = 0;
  bool fails = false;
  mk::Scene scene;
  scene.add(mk::custom_batched(CountedBatch{&calls, &directions, &fails}, 100));
  scene.commit();
  const std::vector<mk::Ray> rays = rays_around({0, 0, 0}, 2, 5000);
  std::vector<mk::Hit> hits(rays.size());
  scene.cast(rays, hits);
  fails = true;
  EXPECT_THROW(scene.cast(rays, hits), mk::Error);
  EXPECT_THROW(scene.cast(rays, hits), mk::Error);  // and is not forgotten
}

/// A ball's support function in C that throws on demand, as a failed allocation does.
struct Thrower {
  bool throws = false;
  static int support(void* user, std::size_t count, const double (*n)[3], double (*p)[3]) {
    if (static_cast<Thrower*>(user)->throws) throw std::bad_alloc();
    std::memcpy(p, n, count * sizeof *p);
    return 0;
  }
};

/// The thread continued to gather for the batch that was gone, and so did all its later queries.
TEST(CustomShape, that_is_gathered_answers_again_once_there_is_memory) {
  Thrower thrower;
  const minkray_support function = {Thrower::support, &thrower, nullptr, nullptr, nullptr};
  minkray_shape shape = {0};
  ASSERT_EQ(minkray_shape_custom_gathered(&function, 100, &shape), MINKRAY_OK);
  minkray_scene scene = {0};
  ASSERT_EQ(minkray_scene_make(&scene), MINKRAY_OK);
  ASSERT_EQ(minkray_scene_add(scene, shape, nullptr, nullptr, nullptr), MINKRAY_OK);
  ASSERT_EQ(minkray_scene_commit(scene), MINKRAY_OK);
  const std::vector<mk::Ray> rays = rays_around({0, 0, 0}, 1, 500);
  std::vector<minkray_hit> hits(rays.size());
  const auto* plain = reinterpret_cast<const minkray_ray*>(rays.data());
  const minkray_options options = {sizeof options, 1, 0, nullptr, nullptr};  // on this thread
  for (const bool throws : {true, false, true, false}) {
    thrower.throws = throws;
    EXPECT_EQ(minkray_scene_cast(scene, plain, rays.size(), hits.data(), &options),
              throws ? MINKRAY_NO_MEMORY : MINKRAY_OK);
    thrower.throws = false;
    const double x[1][3] = {{1, 0, 0}};
    double point[1][3] = {};
    EXPECT_EQ(minkray_shape_support(shape, 1, x, point), MINKRAY_OK);
    EXPECT_EQ(point[0][0], 1);
  }
  minkray_scene_release(scene);
  minkray_shape_release(shape);
}

/// A sum of a shape with itself, made nineteen times over, was a custom shape 2^19 times, and a
/// scene of twenty such sums kept ten million.
TEST(CustomShape, is_watched_once_however_often_it_stands_in_a_scene) {
  mk::Shape sum = mk::custom(box_support);
  for (int i = 0; i < 19; ++i) sum = mk::sum(sum, sum);
  const auto most_memory = [] {
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;  // in KiB
  };
  const long before = most_memory();
  mk::Scene scene;
  for (int i = 0; i < 20; ++i) scene.add(sum);
  EXPECT_LT(most_memory() - before, 60'000);
}

}  // namespace
