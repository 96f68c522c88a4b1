// SPDX-License-Identifier: MIT
// Scenes by the C++ header: added objects are met, results are the same bits for every kind of
// query, and moved objects are met at their new places.
#include <gtest/gtest.h>
#include <minkray/minkray.h>

#include <cmath>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

#include "tests/renderer/library/errors.h"
#include "tests/renderer/library/rays.h"
#include "tests/renderer/library/shapes.h"
#include "tests/support/temporary_folder.h"

namespace {

namespace mk = minkray;

bool same_bits(const mk::Hit& a, const mk::Hit& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

TEST(LibraryScene, answers_are_the_same_bits_for_any_cut_and_any_number_of_threads) {
  const mk::Scene scene = scene_of_shapes();
  const std::vector<mk::Ray> rays = rays_around({0, 0, 0.5}, 3, 10000);
  std::vector<mk::Hit> one_by_one(rays.size());
  std::vector<bool> met(scene.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    one_by_one[i] = scene.cast(rays[i]);
    if (one_by_one[i].found()) met[one_by_one[i].object] = true;
    EXPECT_NE(one_by_one[i].status, mk::exhausted);
  }
  for (std::size_t i = 0; i < met.size(); ++i) EXPECT_TRUE(met[i]) << scene.name(std::uint32_t(i));
  for (const int threads : {0, 1, 2, 3}) {
    for (const std::size_t cut : {rays.size(), std::size_t{1000}, std::size_t{33}}) {
      std::vector<mk::Hit> hits(rays.size());
      for (std::size_t first = 0; first < rays.size(); first += cut) {
        const std::size_t count = std::min(cut, rays.size() - first);
        scene.cast(mk::View<const mk::Ray>(&rays[first], count),
                   mk::View<mk::Hit>(&hits[first], count), {.threads = threads});
      }
      std::size_t different = 0;
      for (std::size_t i = 0; i < rays.size(); ++i) different += !same_bits(hits[i], one_by_one[i]);
      EXPECT_EQ(different, 0u) << threads << " threads, cut " << cut;
    }
  }
}

TEST(LibraryScene, answers_threads_of_its_own) {
  const mk::Scene scene = scene_of_shapes();
  const std::vector<mk::Ray> rays = rays_around({0, 0, 0.5}, 3, 4000);
  std::vector<mk::Hit> hits(rays.size());
  scene.cast(rays, hits);
  std::vector<std::thread> threads;
  std::vector<std::size_t> different(4);
  for (std::size_t t = 0; t < different.size(); ++t)
    threads.emplace_back([&, t] {
      for (std::size_t i = t; i < rays.size(); i += 4)
        different[t] += !same_bits(scene.cast(rays[i]), hits[i]);
    });
  for (std::thread& thread : threads) thread.join();
  for (const std::size_t count : different) EXPECT_EQ(count, 0u);
}

TEST(LibraryScene, occlusion_and_exits_agree_with_hits) {
  const mk::Scene scene = scene_of_shapes();
  const std::vector<mk::Ray> rays = rays_around({0, 0, 0.5}, 3, 2000);
  std::vector<mk::Hit> hits(rays.size());
  std::vector<std::uint8_t> blocked(rays.size());
  scene.cast(rays, hits);
  scene.occluded(rays, blocked);
  std::size_t exits = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_EQ(blocked[i] == mk::hit, hits[i].found()) << i;
    EXPECT_EQ(scene.occluded(rays[i]), mk::Status(blocked[i])) << i;
    if (!hits[i].found() || hits[i].object + 1 == scene.size()) continue;
    const mk::Hit exit = scene.exit(hits[i].object, rays[i]);
    ASSERT_TRUE(exit.found());
    EXPECT_GE(exit.t_hi, hits[i].t_lo) << i;
    ++exits;
  }
  EXPECT_GT(exits, 200u);
  EXPECT_THROW(scene.exit(scene.size() - 1, rays[0]), mk::Error);  // a half-space has no end
}

TEST(LibraryScene, hits_are_proven_and_false_ones_are_not) {
  const mk::Scene scene = scene_of_shapes();
  const std::vector<mk::Ray> rays = rays_around({0, 0, 0.5}, 3, 1000);
  std::vector<mk::Hit> hits(rays.size());
  std::vector<mk::Proof> proofs(rays.size());
  scene.cast(rays, hits);
  scene.prove(rays, hits, proofs);
  std::vector<mk::Ray> rays_of_lies;
  std::vector<mk::Hit> lies;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_TRUE(proofs[i].holds) << i << ": " << proofs[i].complaint << ", object "
                                 << proofs[i].against;
    if (hits[i].status != mk::hit) continue;
    EXPECT_LE(proofs[i].t_lo, proofs[i].t_hi);
    // Three lies: a little further, a miss, and another object.
    mk::Hit later = hits[i], missed = hits[i], other = hits[i];
    later.t_offset += 1e-6 * (1 + hits[i].t);
    later.t += 1e-6 * (1 + hits[i].t);
    missed.status = mk::miss;
    other.object = (other.object + 1) % scene.size();
    for (const mk::Hit& lie : {later, missed, other}) {
      rays_of_lies.push_back(rays[i]);
      lies.push_back(lie);
    }
  }
  EXPECT_GT(lies.size(), 1000u);
  proofs.resize(lies.size());
  scene.prove(rays_of_lies, lies, proofs);
  for (std::size_t i = 0; i < lies.size(); ++i) EXPECT_FALSE(proofs[i].holds) << i;
}

TEST(LibraryScene, what_moved_is_met_where_a_new_scene_has_it) {
  mk::Scene moved = scene_of_shapes(), fresh;
  const mk::Pose shift = mk::pose({0.3, -0.2, 0.5}, {0, 0.1, 0, 1});
  for (std::uint32_t i = 0; i + 1 < moved.size(); ++i) moved.set_pose(i, shift * moved.pose(i));
  moved.commit();
  const mk::Shape shape = mk::sphere(0.5);
  fresh.add(shape, moved.pose(0));
  fresh.commit();
  const std::vector<mk::Ray> rays = rays_around({-2, -2, 0}, 1, 2000);
  std::size_t hits = 0;
  for (const mk::Ray& ray : rays) {
    const mk::Hit a = moved.cast(ray), b = fresh.cast(ray);
    if (a.object != 0 || b.object != 0) continue;
    EXPECT_TRUE(same_bits(a, b));
    ++hits;
  }
  EXPECT_GT(hits, 100u);
}

TEST(LibraryScene, tells_inside_and_miss_apart) {
  mk::Scene scene;
  scene.add(mk::box({1, 1, 1}));
  scene.commit();
  const mk::Hit in = scene.cast({{0.5, 0, 0}, {1, 0, 0}});
  EXPECT_EQ(in.status, mk::inside);
  EXPECT_EQ(in.t, 0);
  const mk::Hit past = scene.cast({{-5, 3, 0}, {1, 0, 0}});
  EXPECT_EQ(past.status, mk::miss);
  EXPECT_EQ(past.t, std::numeric_limits<double>::infinity());
  EXPECT_EQ(past.object, mk::no_object);
  EXPECT_EQ(scene.cast({{-5, 0, 0}, {2, 0, 0}, 1.9}).status, mk::miss);
  const mk::Hit half = scene.cast({{-5, 0, 0}, {2, 0, 0}, 2.1});
  EXPECT_EQ(half.status, mk::hit);
  EXPECT_EQ(half.t, 2);
  EXPECT_EQ(half.point, (mk::Vec3{-1, 0, 0}));
  EXPECT_EQ(half.normal, (mk::Vec3{-1, 0, 0}));
  EXPECT_EQ(scene.exit(0, {{-5, 0, 0}, {2, 0, 0}}).t, 3);
}

/// The shape had the first material of a file that was there before it.
TEST(LibraryScene, what_is_added_is_grey_whatever_came_before_it) {
  const mk::TemporaryFolder folder;
  const std::string file = folder.write("red.json", R"({"version": 1, "lights": [],
    "camera": {"position": [0, -5, 0], "look_at": [0, 0, 0]},
    "materials": [{"name": "red", "type": "lambert", "color": [1, 0, 0]}],
    "objects": [{"name": "ball", "material": "red", "shape": {"type": "sphere", "radius": 1}}]})");
  for (const bool file_first : {true, false}) {
    minkray_scene scene;
    ASSERT_EQ(minkray_scene_make(&scene), MINKRAY_OK);
    const auto add_file = [&] {
      ASSERT_EQ(minkray_scene_add_file(scene, file.c_str(), nullptr, nullptr), MINKRAY_OK)
          << minkray_last_error();
    };
    if (file_first) add_file();
    minkray_shape shape;
    ASSERT_EQ(minkray_shape_read(R"({"type": "sphere", "radius": 1})", nullptr, &shape),
              MINKRAY_OK);
    const minkray_pose right = {{{1, 0, 0, 2}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    ASSERT_EQ(minkray_scene_add(scene, shape, &right, nullptr, nullptr), MINKRAY_OK);
    if (!file_first) add_file();
    ASSERT_EQ(minkray_scene_commit(scene), MINKRAY_OK);
    double albedo[2][3];  // of a pixel at each
    const minkray_channel channel = {"albedo", &albedo[0][0], 6};
    minkray_picture_options options = {};
    options.size = sizeof options;
    options.width = 2;
    options.height = 1;
    options.view = R"({"camera": {"position": [1, -50, 0], "look_at": [1, 0, 0],
                       "fov_y_degrees": 2}})";
    ASSERT_EQ(minkray_scene_render(scene, &options, &channel, 1, nullptr), MINKRAY_OK)
        << minkray_last_error();
    EXPECT_NEAR(albedo[0][0], 1, 1e-6) << file_first;
    EXPECT_NEAR(albedo[0][1], 0, 1e-6) << file_first;
    for (const double grey : albedo[1]) EXPECT_NEAR(grey, 0.7, 1e-6) << file_first;
    minkray_shape_release(shape);
    minkray_scene_release(scene);
  }
}

TEST(LibraryScene, robots_move_by_their_joints) {
  const mk::TemporaryFolder folder;
  const std::string file = folder.write("robot.urdf", R"(<robot name="arm">
    <link name="base"><visual><geometry><sphere radius="0.1"/></geometry></visual></link>
    <link name="hand"><visual><origin xyz="1 0 0"/><geometry><sphere radius="0.2"/></geometry></visual></link>
    <joint name="elbow" type="revolute"><parent link="base"/><child link="hand"/><axis xyz="0 0 1"/>
      <limit lower="-3" upper="3" effort="1" velocity="1"/></joint></robot>)");
  mk::Scene scene;
  scene.add(mk::sphere(0.01), mk::translation({9, 9, 9}));
  auto robot = scene.add_file(file);
  EXPECT_EQ(robot.first(), 1u);
  EXPECT_EQ(robot.size(), 2u);
  ASSERT_EQ(robot.joints(), 1u);
  EXPECT_STREQ(robot.joint(0), "elbow");
  scene.commit();
  EXPECT_NEAR(scene.cast({{5, 0, 0}, {-1, 0, 0}}).t, 3.8, 1e-12);
  robot.set("elbow", 1.5707963267948966);
  scene.commit();
  EXPECT_NEAR(scene.cast({{0, 5, 0}, {0, -1, 0}}).t, 3.8, 1e-12);
  robot.set_pose(mk::translation({0, 1, 0}));
  scene.commit();
  EXPECT_NEAR(scene.cast({{0, 5, 0}, {0, -1, 0}}).t, 2.8, 1e-12);
  EXPECT_TRUE(has(error_of([&] { robot.set("elbo", 0); }), "known are elbow"));
}

/// A ball on a slide along x from the origin, and one particle in its way.
struct BallAndParticle {
  mk::TemporaryFolder folder;
  mk::Scene scene;
  mk::Scene::Group robot, particles;
  BallAndParticle() : robot(scene.add_file(robot_file())), particles(scene.add_file(file())) {
    scene.commit();
  }
  std::string robot_file() const {
    return folder.write("slide.urdf", R"(<robot name="slide"><link name="base"/><link name="ball">
      <visual><geometry><sphere radius="0.5"/></geometry></visual></link>
      <joint name="way" type="prismatic"><parent link="base"/><child link="ball"/>
        <axis xyz="1 0 0"/><limit lower="0" upper="9" effort="1" velocity="1"/></joint></robot>)");
  }
  std::string file() const {
    return folder.write("particle.json", R"({"version": 1, "lights": [],
      "camera": {"position": [0, -9, 1], "look_at": [0, 0, 0]},
      "materials": [{"name": "m", "type": "lambert", "color": [1, 1, 1]}], "objects": [],
      "particles": [{"name": "p", "shape": {"type": "sphere", "radius": 0.25}, "material": "m",
                     "columns": ["position"], "count": 1, "poses": [[5, 0, 0]]}]})");
  }
};

/// The robot was proven to be infinitely clear of a particle that rays meet.
TEST(LibraryScene, a_robot_does_not_pass_through_particles) {
  BallAndParticle both;
  EXPECT_NEAR(both.scene.cast({{5, -9, 0}, {0, 1, 0}}).t, 8.75, 1e-12);
  const std::vector<double> near = {0, 3}, through = {0, 9};
  const mk::Clearance clear = both.scene.clearance(both.robot, near, 2);
  EXPECT_LE(clear.lower, 1.25);
  EXPECT_NEAR(clear.upper, 1.25, 1e-9);
  EXPECT_EQ(clear.object_b, 1u);  // numbered as rays number it: after all objects
  EXPECT_NEAR(clear.point_b[0], 4.75, 1e-9);
  const mk::Clearance met = both.scene.clearance(both.robot, through, 2);
  EXPECT_NEAR(met.upper, -0.75, 0.01);
  EXPECT_LE(met.lower, -0.75);
  // The robot elsewhere: the particle stays where it is.
  both.robot.set_pose(mk::translation({-2, 0, 0}));
  both.scene.commit();
  const mk::Clearance further = both.scene.clearance(both.robot, near, 2);
  EXPECT_NEAR(further.upper, 3.25, 1e-9);
  EXPECT_NEAR(further.point_b[0], 4.75, 1e-9);
}

/// The ball of radius 0.5 slides to the particle of radius 0.25 at 5.
TEST(LibraryScene, motions_are_judged) {
  BallAndParticle both;
  const std::vector<double> near = {0, 3}, through = {0, 9};
  const mk::Verdict free = both.scene.verify(both.robot, near, 2);
  EXPECT_EQ(free.status, mk::motion_free);
  EXPECT_LE(free.lower, 1.25);
  EXPECT_NEAR(free.lower, 1.25, 0.02);
  EXPECT_NEAR(free.upper, 1.25, 1e-9);
  EXPECT_EQ(free.object_b, 1u);
  EXPECT_EQ(both.scene.verify(both.robot, near, 2, {}, 1.3).status, mk::motion_collides);
  const mk::Verdict met = both.scene.verify(both.robot, through, 2);
  EXPECT_EQ(met.status, mk::motion_collides);
  EXPECT_LT(met.upper, 0);
  // The two touch 0.75 on both sides of 5, which is 9 times a row's part.
  EXPECT_NEAR(met.begin, 4.25 / 9, 0.002);
  EXPECT_NEAR(met.end, 5.75 / 9, 0.002);
  // From rest to rest it swings out by a rate: 3 + 4 * 8 / 27, where a cubic's bulge is largest.
  const std::vector<double> there = {3, 3}, rates = {8, 0};
  const mk::Verdict bulge = both.scene.verify(both.robot, there, 2, rates);
  EXPECT_EQ(bulge.status, mk::motion_free);
  EXPECT_NEAR(bulge.upper, 1.25 - 8 * 4.0 / 27, 0.001);
  EXPECT_NEAR(bulge.row, 1.0 / 3, 0.02);
  // From rest to rest with the acceleration a at both ends it swings out by a/2 s^2 (1 - s)^2.
  const std::vector<double> rest = {0, 0}, pushed = {32, 32};
  const mk::Verdict quintic = both.scene.verify(both.robot, there, 2, rest, 0, pushed);
  EXPECT_EQ(quintic.status, mk::motion_free);
  EXPECT_NEAR(quintic.upper, 0.25, 0.003);
  EXPECT_THROW(both.scene.verify(both.robot, there, 2, {}, 0, pushed), mk::Error);
}

/// The pose was taken, and nothing moved.
TEST(LibraryScene, particles_take_no_pose) {
  BallAndParticle both;
  EXPECT_TRUE(has(error_of([&] {
                    both.particles.set_pose(mk::translation({0, 0, 100}));
                  }),
                  "pose: must not be given to a group with particles"));
  EXPECT_NEAR(both.scene.cast({{5, -9, 0}, {0, 1, 0}}).t, 8.75, 1e-12);
}

/// Rows of a robot without joints have no numbers: 2^30 of them took tens of gigabytes.
TEST(LibraryScene, a_robot_without_joints_stands_still_for_as_many_rows_as_are_asked_for) {
  const mk::TemporaryFolder folder;
  const std::string file = folder.write("fixed.urdf", R"(<robot name="post"><link name="base">
    <visual><geometry><sphere radius="0.5"/></geometry></visual></link></robot>)");
  mk::Scene scene;
  const auto post = scene.add_file(file);
  scene.add(mk::sphere(1), mk::translation({4, 0, 0}));
  scene.commit();
  mk::Clearance steps[2];
  scene.clearance(post, {}, 3, steps);
  EXPECT_EQ(steps[0].lower, steps[1].lower);
  EXPECT_EQ(steps[1].row, steps[0].row + 1);
  minkray_clearance least;
  EXPECT_EQ(minkray_scene_clearance(scene.handle(), post.number(), nullptr, std::size_t{1} << 30, 0,
                                    nullptr, nullptr, &least),
            MINKRAY_OK);
  EXPECT_EQ(least.lower, steps[0].lower);
}

TEST(LibraryScene, shapes_go_through_text_and_stay_the_same) {
  const mk::Shape shape = mk::hull_of(
      {mk::rounded(mk::box({0.1, 0.2, 0.3}), 1.0 / 3), mk::translated(mk::cone(1, 2), {0, 0, 1})});
  const auto text = shape.json<std::string>();
  const mk::Shape again = mk::read_shape(text);
  EXPECT_EQ(again.json<std::string>(), text);
  for (const mk::Ray& ray : rays_around({0, 0, 0}, 2, 200))
    EXPECT_EQ(shape.support(ray.direction), again.support(ray.direction));
}

/// An ellipsoid's were no numbers along (1e308, 5, 0.2), whose squares overflow.
TEST(LibraryScene, support_points_are_the_same_along_directions_of_any_length) {
  for (const mk::Shape& shape : some_shapes()) {
    SCOPED_TRACE(shape.kind());
    for (const mk::Ray& ray : rays_around({0, 0, 0}, 2, 20))
      for (const int power : {-1000, -500, 500, 1000}) {
        const mk::Vec3& n = ray.direction;
        const mk::Vec3 scaled = {std::ldexp(n.x, power), std::ldexp(n.y, power),
                                 std::ldexp(n.z, power)};
        EXPECT_EQ(shape.support(scaled), shape.support(n)) << "times 2^" << power;
      }
    EXPECT_EQ(shape.support({0, 5e-324, 0}), shape.support({0, 1, 0}));
    EXPECT_EQ(shape.support({1e308, 5.28, 1.0 / 6}).x, shape.support({1, 0, 0}).x);
    const mk::Vec3 anywhere = shape.support({0, 0, 0});
    EXPECT_TRUE(std::isfinite(anywhere.x + anywhere.y + anywhere.z));
  }
}

TEST(LibraryScene, what_takes_long_is_told_of_and_can_be_stopped) {
  const mk::Scene scene = scene_of_shapes();
  const std::vector<mk::Ray> rays = rays_around({0, 0, 0.5}, 3, 20000);
  std::vector<mk::Hit> hits(rays.size());
  struct Told {
    int calls = 0;
    double last = 0;
  } message;
  mk::Options options;
  options.user = &message;
  options.progress = [](void* user, double done) {
    auto& heard = *static_cast<Told*>(user);
    EXPECT_GE(done, 0);
    EXPECT_LE(done, 1);
    ++heard.calls;
    return heard.calls == 3 ? 1 : 0;
  };
  EXPECT_NE(error_of([&] { scene.cast(rays, hits, options); }, MINKRAY_STOPPED), "");
  EXPECT_EQ(message.calls, 3);
}

}  // namespace
