// SPDX-License-Identifier: MIT
// Proofs of verdicts on motions, and options of verdicts from programs of earlier versions.
#include <gtest/gtest.h>
#include <minkray/minkray.h>

#include <fstream>
#include <string>
#include <vector>

#include "tests/renderer/library/errors.h"
#include "tests/support/temporary_folder.h"

namespace {

namespace mk = minkray;

/// A ball on a slide along x from the origin, and another one in its way.
struct BallAndPost {
  mk::TemporaryFolder folder;
  mk::Scene scene;
  mk::Scene::Group robot;
  BallAndPost() : robot(scene.add_file(robot_file())) {
    scene.add(mk::sphere(0.25), mk::translation({5, 0, 0}), "post");
    scene.commit();
  }
  std::string robot_file() const {
    return folder.write("slide.urdf", R"(<robot name="slide"><link name="base"/><link name="ball">
      <visual><geometry><sphere radius="0.5"/></geometry></visual></link>
      <joint name="way" type="prismatic"><parent link="base"/><child link="ball"/>
        <axis xyz="1 0 0"/><limit lower="0" upper="9" effort="1" velocity="1"/></joint></robot>)");
  }
};

TEST(LibraryVerdict, verdicts_have_proofs) {
  BallAndPost both;
  const std::vector<double> near = {0, 3}, through = {0, 9};
  for (const auto& [path, status] : {std::pair(near, "free"), {through, "collides"}}) {
    const std::string file = both.folder / "proof.json";
    both.scene.verify(both.robot, path, 2, {}, 0, {}, file);
    std::ifstream stream(file);
    const std::string text((std::istreambuf_iterator<char>(stream)), {});
    expect_parts(text, {std::string("\"status\":\"") + status + '"', "\"sha256\":"});
  }
  const std::string nowhere = both.folder / "none/proof.json";
  EXPECT_THROW(both.scene.verify(both.robot, near, 2, {}, 0, {}, nowhere), mk::Error);
}

TEST(LibraryVerdict, rates_are_by_time) {
  BallAndPost both;
  // From 0 to 3 in two seconds, with a speed of 4.5 at the end.
  const std::vector<double> path = {0, 3, 3}, rates = {0, 4.5, 0}, times = {10, 12, 12.5};
  const mk::Verdict free = both.scene.verify(both.robot, path, 3, {}, 0, {}, {}, times);
  EXPECT_EQ(free.status, MINKRAY_MOTION_FREE);
  EXPECT_NEAR(free.upper, 1.25, 1e-6);
  // Then it overshoots: in half a second at 4.5, by 4/27 of 2.25.
  const mk::Verdict past = both.scene.verify(both.robot, path, 3, rates, 0, {}, {}, times);
  EXPECT_EQ(past.status, MINKRAY_MOTION_FREE);
  EXPECT_NEAR(past.upper, 1.25 - 2.25 * 4 / 27, 1e-2);
  EXPECT_NEAR(past.row, 1 + 1.0 / 3, 0.05);
  EXPECT_GT(past.lower, 1.25 - 2.25 * 4 / 27 - 1e-2);
  // Rows a second apart: it overshoots by 4/27 of 4.5.
  const mk::Verdict rows = both.scene.verify(both.robot, path, 3, rates);
  EXPECT_NEAR(rows.upper, 1.25 - 4.5 * 4 / 27, 1e-2);
  const std::vector<double> standing = {10, 12, 12};
  EXPECT_THROW(both.scene.verify(both.robot, path, 3, rates, 0, {}, {}, standing), mk::Error);
  EXPECT_THROW(both.scene.verify(both.robot, path, 3, rates, 0, {}, {}, {times.data(), 2}),
               mk::Error);
  const std::vector<double> further = {0, 5, 5};
  const mk::Verdict met = both.scene.verify(both.robot, further, 3, {}, 0, {}, {}, times);
  EXPECT_EQ(met.status, MINKRAY_MOTION_COLLIDES);
  EXPECT_NEAR(met.begin, 4.25 / 5, 2e-3);
}

/// Programs that were compiled before the options had more members.
TEST(LibraryVerdict, options_of_verdicts_may_end_earlier) {
  BallAndPost both;
  const double path[] = {0, 3};
  minkray_verdict_options options = {};
  options.size = offsetof(minkray_verdict_options, accelerations);
  options.proof = "/never/read";
  minkray_verdict verdict = {};
  EXPECT_EQ(minkray_scene_verify(both.scene.handle(), both.robot.number(), path, nullptr, 2, 1,
                                 &options, &verdict),
            MINKRAY_OK);
  EXPECT_EQ(verdict.status, MINKRAY_MOTION_FREE);
  options.size -= 1;
  EXPECT_EQ(minkray_scene_verify(both.scene.handle(), both.robot.number(), path, nullptr, 2, 1,
                                 &options, &verdict),
            MINKRAY_WRONG_USE);
}

}  // namespace
