// SPDX-License-Identifier: MIT
// Scenes under threads and callbacks: queries of a scene keep it as it is, and changing it
// meanwhile is an error. A scene that was changed during a query crashed, or gave results of two
// scenes at once.
#include <gtest/gtest.h>
#include <minkray/minkray.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include "tests/renderer/library/errors.h"
#include "tests/renderer/library/rays.h"
#include "tests/renderer/library/shapes.h"

namespace {

namespace mk = minkray;

constexpr const char* in_use = "must not be changed or released while another call uses it";

/// All that changes a scene; each is called within a query of it.
std::vector<std::string> changes_of(mk::Scene& scene) {
  const mk::Shape ball = mk::sphere(0.1);
  return {error_of([&] { scene.add(ball); }),
          error_of([&] {
            scene.add_half_space({0, 0, 1}, -9);
          }),
          error_of([&] { scene.add_file("none.urdf"); }),
          error_of([&] { scene.set_pose(0, {}); }),
          error_of([&] { scene.remove(0); }),
          error_of([&] { scene.commit(); }),
          error_of([&] { mk::detail::check(minkray_scene_release(scene.handle())); })};
}

TEST(SceneUse, a_progress_callback_cannot_change_the_scene) {
  mk::Scene scene = scene_of_shapes();
  const std::uint32_t size = scene.size();
  const std::vector<mk::Ray> rays = rays_around({0, 0, 0.5}, 3, 10000);
  std::vector<mk::Hit> alone(rays.size()), hits(rays.size());
  scene.cast(rays, alone);
  struct Told {
    mk::Scene& scene;
    std::vector<std::string> errors;
    mk::Hit within;
  };
  for (const int threads : {1, 2}) {
    Told message{scene, {}, {}};
    mk::Options options;
    options.threads = threads;
    options.user = &message;
    options.progress = [](void* user, double) {
      auto& heard = *static_cast<Told*>(user);
      if (!heard.errors.empty()) return 0;
      heard.errors = changes_of(heard.scene);
      heard.within = heard.scene.cast({{-9, 0, 0}, {1, 0, 0}});  // questions are answered
      return 0;
    };
    scene.cast(rays, hits, options);
    ASSERT_EQ(message.errors.size(), 7u);
    for (const std::string& error : message.errors) EXPECT_TRUE(has(error, in_use));
    EXPECT_EQ(scene.size(), size);
    for (std::size_t i = 0; i < rays.size(); ++i) EXPECT_EQ(hits[i].t, alone[i].t);
  }
  scene.add(mk::sphere(1));  // once there are no queries
  scene.commit();
}

TEST(SceneUse, threads_that_change_and_ask_get_answers_or_errors) {
  mk::Scene scene;
  for (int i = 0; i < 50; ++i) scene.add(mk::sphere(0.2), mk::translation({0.0 + i, 0, 0}));
  scene.commit();
  std::vector<mk::Ray> rays;
  for (int i = 0; i < 300; ++i) rays.push_back({{i % 60 - 0.0, -9, 0}, {0, 1, 0}});
  std::atomic<bool> stop = false;
  std::atomic<int> answered = 0, refused = 0, changed = 0;
  std::vector<std::thread> askers;
  for (int t = 0; t < 3; ++t)
    askers.emplace_back([&, t] {
      std::vector<mk::Hit> hits(rays.size());
      while (!stop) try {
          if (t == 0)
            hits[0] = scene.cast(rays[0]);
          else
            scene.cast(rays, hits, {.threads = t});
          // Balls are at whole places, and never at two heights at once.
          for (const mk::Hit& hit : hits) EXPECT_NEAR(hit.found() ? hit.t : 8.8, 8.8, 1e-12);
          EXPECT_FALSE(std::string(scene.name(0)).empty());
          ++answered;
          std::this_thread::sleep_for(std::chrono::microseconds(50));
        } catch (const mk::Error& error) {
          EXPECT_EQ(error.code(), MINKRAY_WRONG_USE) << error.what();
          ++refused;
          std::this_thread::sleep_for(std::chrono::microseconds(200));  // let the others get on
        }
    });
  while (changed < 200 || answered == 0) {
    if (changed >= 200) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    bool is_done = false;
    try {
      scene.add(mk::sphere(0.2), mk::translation({0.0 + changed % 60, 0, 0}),
                "a name of some length");
      is_done = true;
    } catch (const mk::Error& error) {
      EXPECT_EQ(error.code(), MINKRAY_WRONG_USE) << error.what();
    }
    if (!is_done) continue;
    ++changed;
    for (bool is_committed = false; !is_committed;) try {
        scene.commit();
        is_committed = true;
      } catch (const mk::Error&) {
        std::this_thread::yield();
      }
    std::this_thread::yield();
  }
  stop = true;
  for (std::thread& thread : askers) thread.join();
  EXPECT_EQ(scene.size(), 50u + static_cast<unsigned>(changed));
}

/// A box whose function may call back: a query of what it is part of came back for ever, until the
/// stack was full.
struct CallsBack {
  static inline std::vector<std::string> errors;
  static inline mk::Scene* scene = nullptr;
  static inline const mk::Shape* own = nullptr;
  static inline const mk::Shape* other = nullptr;

  mk::Vec3 operator()(const mk::Vec3& n) const {
    if (scene && errors.empty()) {
      errors = {error_of([] {
                  (void)scene->cast({{-9, 0, 0}, {1, 0, 0}});
                }),
                error_of([] {
                  (void)mk::cast(*own, {{-9, 0, 0}, {1, 0, 0}});
                }),
                error_of([] { (void)mk::signed_distance(*own, {}, mk::sphere(1), {}); }),
                error_of([] {
                  (void)own->support({1, 0, 0});
                }),
                error_of([] { (void)own->bounds(); })};
      // Other shapes may be queried.
      EXPECT_EQ(other->support({1, 0, 0}).x, 2);
    }
    return {std::copysign(1.0, n.x), std::copysign(1.0, n.y), std::copysign(1.0, n.z)};
  }
};

TEST(SceneUse, a_support_function_cannot_query_what_it_is_part_of) {
  const mk::Shape own = mk::custom(CallsBack()), grown = mk::rounded(own, 0.5),
                  other = mk::sphere(2);
  mk::Scene scene;
  scene.add(grown);
  scene.commit();
  CallsBack::own = &own;
  CallsBack::other = &other;
  CallsBack::scene = &scene;
  const mk::Hit hit = scene.cast({{-9, 0.1, 0.2}, {1, 0, 0}});
  CallsBack::scene = nullptr;
  EXPECT_EQ(hit.status, mk::hit);
  EXPECT_NEAR(hit.t, 7.5, 1e-9);
  ASSERT_EQ(CallsBack::errors.size(), 5u);
  for (const std::string& error : CallsBack::errors)
    EXPECT_TRUE(has(error, "must not be queried from within its own support function"));
}

TEST(SceneUse, names_stay_where_they_are_as_long_as_the_scene) {
  mk::Scene scene;
  scene.add(mk::sphere(1), {}, "short");
  scene.add(mk::sphere(1), {}, "a name that is too long to lie within a string");
  const char* const first = scene.name(0);
  const char* const second = scene.name(1);
  for (int i = 0; i < 1000; ++i) scene.add(mk::sphere(1));
  scene.remove(1);
  scene.commit();
  EXPECT_STREQ(first, "short");
  EXPECT_STREQ(second, "a name that is too long to lie within a string");
  EXPECT_EQ(scene.name(0), first);
}

}  // namespace
