// SPDX-License-Identifier: MIT
// Proofs of collisions in which one body is within a mesh: by the moment at which it crosses the
// surface, or, if it is within all the time, by the surface that winds around it.
#include <gtest/gtest.h>

#include <fstream>

#include "renderer/json/json.h"
#include "renderer/verify/sha256.h"
#include "tests/renderer/verify/verify_folder.h"
#include "tests/support/meshes.h"

namespace minkray {
namespace {

/// A ball of radius 0.1, or a mesh of its size, that slides along x through a hollow cube from x =
/// 2 to 4.
class Enclosures : public VerifyFolder {
 protected:
  void SetUp() override {
    if (python().empty()) GTEST_SKIP() << "needs NumPy";
    const auto write_robot = [&](const std::string& name, const std::string& geometry) {
      std::ofstream(folder_ / (name + ".urdf")) << R"(<robot name="r"><link name="base"/>
  <link name="probe"><collision><geometry>)" + geometry +
                                                       R"(</geometry></collision></link>
  <joint name="x" type="prismatic"><parent link="base"/><child link="probe"/><axis xyz="1 0 0"/>
    <limit lower="-9" upper="9" effort="1" velocity="1"/></joint></robot>)";
    };
    write_robot("ball", R"(<sphere radius="0.1"/>)");
    write_robot("mesh", R"(<mesh filename="cube.obj" scale="0.1 0.1 0.1"/>)");
    std::ofstream obj(folder_ / "cube.obj");
    for (int i = 0; i < 8; ++i)
      obj << "v " << (i & 1 ? 1 : -1) << " " << (i & 2 ? 1 : -1) << " " << (i & 4 ? 1 : -1) << "\n";
    for (const char* face : {"1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"})
      obj << "f " << face << "\n";
    std::ofstream(folder_ / "scene.json")
        << R"({"version": 2, "objects": [{"name": "room", "mesh": {"file": "cube.obj"},
               "transform": {"translate": [3, 0, 0]}}]})";
  }

  /// Verifies a motion along x; returns the checker's output for its proof.
  std::string checked(const std::string& robot, const std::string& from, const std::string& to) {
    std::ofstream(folder_ / "plan.json") << R"({"joint_names": ["x"], "points": [{"positions": [)" +
                                                from + R"(]}, {"positions": [)" + to + "]}]}";
    expect_exit(1, verify("--robot " + robot +
                          ".urdf --scene scene.json --trajectory plan.json -o proof.json"));
    return verdict("proof.json");
  }
  std::string verdict(const std::string& file) {
    const ProgramOutcome outcome = check(file);
    return outcome.out + outcome.err;
  }
  Json proof() { return Json::parse(text_of_file(folder_ / "proof.json")); }
};

TEST_F(Enclosures, a_body_that_gets_in_is_proven_where_it_crosses) {
  for (const std::string robot : {"ball", "mesh"}) {
    // In the middle of the step it is within.
    const std::string said = checked(robot, "0", "6");
    EXPECT_TRUE(has(said, "holds: collides: 1 collisions")) << robot;
    const Json made = proof();
    EXPECT_TRUE(made["enclosures"].empty()) << robot;
    const double at = 6 * made["collisions"][0][1].get<double>();
    EXPECT_TRUE(std::abs(at - 2) <= 0.1 || std::abs(at - 4) <= 0.1) << robot << at;
  }
}

TEST_F(Enclosures, a_body_that_is_within_all_the_time_is_wound_around) {
  for (const std::string robot : {"ball", "mesh"}) {
    const std::string said = checked(robot, "2.5", "3.5");
    EXPECT_TRUE(has(said, "holds: collides: 1 collisions")) << robot;
    EXPECT_EQ(proof()["enclosures"].size(), 1u) << robot;
  }
}

/// Proofs of a body elsewhere, of an open surface, and of a surface as its hull.
TEST_F(Enclosures, changed_proofs_are_refused) {
  checked("ball", "2.5", "3.5");
  const std::string text = text_of_file(folder_ / "proof.json");
  const auto said_of = [&](const std::string& from, const std::string& to) {
    std::string changed = text.substr(0, text.rfind(",\"sha256\""));
    const std::size_t at = changed.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    if (at != std::string::npos) changed.replace(at, from.size(), to);
    std::ofstream(folder_ / "changed.json")
        << changed << ",\"sha256\":\"" << sha256(changed) << "\"}\n";
    return verdict("changed.json");
  };
  EXPECT_TRUE(has(said_of("[2.5]", "[9.5]"), "does not hold"));
  EXPECT_TRUE(has(said_of("\"triangles\":[[0,2,3],", "\"triangles\":["), "is not closed"));
  const std::string lists = text.substr(text.find("\"collisions\""));
  const std::string entry = lists.substr(lists.find("[["), lists.find("]]") - lists.find("[[") + 2);
  EXPECT_TRUE(has(said_of("\"collisions\":[],\"enclosures\":" + entry,
                          "\"collisions\":" + entry + ",\"enclosures\":[]"),
                  "a surface is no hull"));
}

}  // namespace
}  // namespace minkray
