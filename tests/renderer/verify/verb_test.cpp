// SPDX-License-Identifier: MIT
// minkray verify and minkray-check as their users meet them.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "renderer/json/json.h"
#include "tests/renderer/verify/verify_folder.h"
#include "tests/support/meshes.h"

namespace minkray {
namespace {

/// A ball that a hinge swings at a distance of 1, another one that slides out from it, and a post.
class VerifyVerb : public VerifyFolder {
 protected:
  VerifyVerb() {
    write("swing.urdf", R"(<robot name="swing">
  <link name="base"/>
  <link name="bob"><collision><origin xyz="1 0 0"/><geometry><sphere radius="0.1"/></geometry></collision></link>
  <link name="tip"><collision><origin xyz="1.2 0 0"/><geometry><sphere radius="0.05"/></geometry></collision></link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="bob"/><axis xyz="0 0 1"/>
    <limit lower="-4" upper="4" effort="1" velocity="1"/></joint>
  <joint name="out" type="prismatic"><parent link="bob"/><child link="tip"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="1" effort="1" velocity="1"/></joint>
</robot>)");
    // At (0, 1.5): the bob passes it by 0.2 on its circle, and the tip by 1.5 - 1.2 - 0.05 - 0.2.
    write("scene.yaml", R"(world:
  collision_objects:
    - id: post
      primitives: [{type: sphere, dimensions: [0.2]}]
      primitive_poses: [{position: [0, 1.5, 0], orientation: [0, 0, 0, 1]}]
)");
    write("past.yaml", R"(joint_trajectory:
  joint_names: [turn, out]
  points:
    - {positions: [0, 0], time_from_start: {sec: 0, nanosec: 0}}
    - {positions: [3.141592653589793, 0], time_from_start: {sec: 2, nanosec: 0}}
)");
    write("hit.yaml", R"(joint_trajectory:
  joint_names: [turn, out]
  points:
    - {positions: [0, 0.3], time_from_start: {sec: 0, nanosec: 0}}
    - {positions: [3.141592653589793, 0.3], time_from_start: {sec: 2, nanosec: 0}}
)");
    // From 0.2 to 0.2 via 0.05 less: by rates alone, the rows look free.
    write("bulge.yaml", R"(joint_names: [turn, out]
points:
  - {positions: [1.5707963267948966, 0.0], velocities: [0, 0.8], time_from_start: 0}
  - {positions: [1.5707963267948966, 0.0], velocities: [0, -0.8], time_from_start: 1}
)");
    write("rates.yaml", R"(joint_names: [turn, out]
points:
  - {positions: [0, 0], velocities: [1, 0], time_from_start: 0}
  - {positions: [1.4, 0.02], velocities: [0.7, 0.01], time_from_start: 1}
  - {positions: [3, 0], velocities: [0, 0], time_from_start: 3}
)");
  }
  ProgramOutcome verify(const std::string& words) {
    return VerifyFolder::verify("--robot swing.urdf --scene scene.yaml " + words);
  }
};

TEST_F(VerifyVerb, free_motions_have_their_least_clearance) {
  const ProgramOutcome outcome = verify("--trajectory past.yaml --json --tolerance 1e-6");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json json = Json::parse(outcome.out);
  EXPECT_EQ(json["status"].text(), "free");
  // The tip passes the post at half a circle's half.
  EXPECT_NEAR(json["lower"].get<double>(), 0.05, 1e-6);
  EXPECT_LE(json["lower"].get<double>(), 0.05);
  EXPECT_NEAR(json["time"].get<double>(), 1, 1e-3);
  EXPECT_EQ(json["a"].text(), "tip/sphere");
  EXPECT_EQ(json["b"].text(), "post");
  const ProgramOutcome words = verify("--trajectory past.yaml");
  EXPECT_TRUE(has(words.out, "past.yaml: free: every pair stays at least"));
}

TEST_F(VerifyVerb, collisions_are_named_from_when_to_when) {
  const ProgramOutcome outcome = verify("--trajectory hit.yaml --json");
  ASSERT_EQ(outcome.exit_code, 1) << outcome.err;
  const Json json = Json::parse(outcome.out);
  EXPECT_EQ(json["status"].text(), "collides");
  ASSERT_EQ(json["collisions"].size(), 1u);
  const Json& stretch = json["collisions"][0];
  // The two touch where a triangle of sides 1.5 and 1.5 has 0.25 across from the angle.
  const double angle = 2 * std::asin(0.125 / 1.5), rate = 3.141592653589793 / 2;
  EXPECT_NEAR(stretch["begin"].get<double>(), 1 - angle / rate, 2.1 / 1024);
  EXPECT_NEAR(stretch["end"].get<double>(), 1 + angle / rate, 2.1 / 1024);
  EXPECT_LT(stretch["upper"].get<double>(), 0);
}

TEST_F(VerifyVerb, what_happens_between_the_rows_counts) {
  // With a cubic of rates 0.8 and -0.8 the tip goes out by 0.8 / 4, and 0.05 of that is free.
  expect_exit(1, verify("--trajectory bulge.yaml"));
  expect_exit(0, verify("--trajectory past.yaml --padding 0.049"));
  expect_exit(1, verify("--trajectory past.yaml --padding 0.051"));
  expect_exit(1, verify("--trajectory past.yaml --inflate tip=0.051"));
  expect_exit(0, verify("--trajectory past.yaml --inflate bob=0.051"));
  // Exactly touching is neither.
  expect_exit(6, verify("--trajectory past.yaml --padding 0.05"));
}

TEST_F(VerifyVerb, a_table_has_a_row_for_each_step) {
  const ProgramOutcome outcome = verify("--trajectory rates.yaml --table");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_EQ(outcome.out.find("begin,end,lower,upper,time,a,b\n"), 0u);
  EXPECT_EQ(std::ranges::count(outcome.out, '\n'), 3);
}

TEST_F(VerifyVerb, serves_a_verdict_for_each_line) {
  std::ofstream(folder_ / "plans.jsonl")
      << R"({"joint_names": ["turn"], "points": [{"positions": [0]}, {"positions": [3]}]})"
      << "\n"
      << "\"hit.yaml\"\n"
      << R"({"joint_names": ["nope"], "points": [{"positions": [0]}]})"
      << "\n";
  const ProgramOutcome outcome = verify("--serve < plans.jsonl");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::istringstream lines(outcome.out);
  std::vector<std::string> status;
  for (std::string line; std::getline(lines, line);)
    status.push_back(Json::parse(line)["status"].text());
  EXPECT_EQ(status, (std::vector<std::string>{"free", "collides", "error"}));
}

/// The turn of a free joint at rest had its numbers in another order: the rod was upright, and a
/// motion that hits the ball was `free`.
TEST_F(VerifyVerb, free_joints_without_values_rest_as_their_file_says) {
  // Half a turn about x: the rod goes down from z = 0.7 to 0.2, below it a ball at z = 0.
  write("free.xml", R"(<mujoco><worldbody>
  <body name="base" pos="0 0 1" quat="0 1 0 0"><freejoint name="root"/>
    <geom name="rod" type="capsule" size=".05" fromto="0 0 .3 0 0 .8"/>
    <body name="arm" pos=".3 0 0"><joint name="turn" axis="0 0 1"/><geom size=".05" pos=".2 0 0"/></body>
  </body></worldbody></mujoco>)");
  write("turn.csv", "time,turn\n0,0\n1,0.1\n");
  for (const auto& [radius, code, text] :
       {std::tuple("0.1", 0, "free: every pair stays at least 50 mm apart (rod, ball"),
        {"0.2", 1, "rod and ball collide from 0 s to 1 s"}}) {
    write("ball.yaml", std::string("world:\n  collision_objects:\n    - {id: ball, primitives: "
                                   "[{type: sphere, dimensions: [") +
                           radius + "]}], primitive_poses: [{position: [0, 0, 0]}]}\n");
    const ProgramOutcome outcome =
        VerifyFolder::verify("--robot free.xml --trajectory turn.csv --scene ball.yaml");
    expect_exit(code, outcome);
    EXPECT_TRUE(has(outcome.out, text)) << radius;
  }
}

/// Velocities lead a continuous joint round its whole way, where a post is.
TEST_F(VerifyVerb, continuous_joints_with_velocities_go_their_own_way) {
  std::ifstream file(folder_ / "swing.urdf");
  std::string urdf((std::istreambuf_iterator<char>(file)), {});
  urdf.replace(urdf.find("\"revolute\""), 10, "\"continuous\"");
  std::ofstream(folder_ / "swing.urdf") << urdf;
  const auto plan = [&](const std::string& name, const std::string& velocities) {
    std::ofstream(folder_ / name) << R"({"joint_names": ["turn", "out"], "points": [
      {"positions": [0, 0.3])" + velocities +
                                         R"(, "time_from_start": 0},
      {"positions": [5, 0.3])" + velocities +
                                         R"(, "time_from_start": 1}]})";
    return verify("--trajectory " + name);
  };
  expect_exit(1, plan("own.json", R"(, "velocities": [5, 0])"));
  // The shorter way does not come by the post.
  expect_exit(0, plan("shorter.json", ""));
}

TEST_F(VerifyVerb, a_joint_is_named_once_and_a_bad_plan_hides_no_other) {
  std::ofstream(folder_ / "twice.json")
      << R"({"joint_names": ["turn", "turn"], "points": [{"positions": [1, 0.2]}]})";
  const ProgramOutcome outcome = verify("--trajectory twice.json --trajectory hit.yaml");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_TRUE(has(outcome.err, "/joint_names/1: duplicate"));
  EXPECT_TRUE(has(outcome.out, "hit.yaml: collides"));
}

/// There is no proof of what is undecided; the verdict has its exit code all the same.
TEST_F(VerifyVerb, an_undecided_motion_is_that_also_where_a_proof_is_requested) {
  expect_exit(6, verify("--trajectory past.yaml --budget 1 -o proof.json"), {"undecided"});
  EXPECT_FALSE(std::ifstream(folder_ / "proof.json").good());
}

TEST_F(VerifyVerb, mistakes_are_told) {
  expect_exit(2, verify(""));
  expect_exit(2, verify("--trajectory past.yaml -o proof.txt"));
  expect_exit(2, verify("--trajectory past.yaml --trajectory hit.yaml -o proof.json"));
  expect_exit(3, verify("--trajectory none.yaml"), {"none.yaml"});
  std::ofstream(folder_ / "bad.yaml") << "joint_names: [turn]\npoints:\n  - positions: [0, 1]\n";
  expect_exit(3, verify("--trajectory bad.yaml"), {"bad.yaml: line 3: /points/0/positions: "});
}

TEST_F(VerifyVerb, tables_of_numbers_are_plans_too) {
  std::ofstream(folder_ / "plan.csv") << "time,turn,out\n0,0,0\n2,3.14159265,0\n";
  const ProgramOutcome csv = verify("--trajectory plan.csv --json");
  ASSERT_EQ(csv.exit_code, 0) << csv.err;
  EXPECT_NEAR(Json::parse(csv.out)["lower"].get<double>(), 0.05, 0.001);
  const std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2), }";
  std::string npy = "\x93NUMPY";
  npy += std::string("\x01\x00", 2);
  std::string padded = header + std::string(118 - header.size() - 1, ' ') + "\n";
  npy += static_cast<char>(padded.size());
  npy += '\0';
  npy += padded;
  for (const double value : {0.0, 0.0, 3.14159265, 0.0})
    npy.append(reinterpret_cast<const char*>(&value), sizeof value);
  std::ofstream(folder_ / "plan.npy") << npy;
  const ProgramOutcome array = verify("--trajectory plan.npy --json");
  ASSERT_EQ(array.exit_code, 0) << array.err;
  EXPECT_NEAR(Json::parse(array.out)["lower"].get<double>(), 0.05, 0.001);
}

TEST_F(VerifyVerb, pictures_and_pages_are_written) {
  ASSERT_EQ(verify("--trajectory past.yaml -o p.html -o p.png -s 1").exit_code, 0);
  const auto begin_of = [&](const std::string& file) {
    std::ifstream stream(folder_ / file);
    std::string text(15, '\0');
    stream.read(text.data(), 15);
    return text;
  };
  EXPECT_EQ(begin_of("p.html"), "<!doctype html>");
  EXPECT_EQ(begin_of("p.png").substr(1, 3), "PNG");
}

/// Meshes were shown as squares of six metres.
TEST_F(VerifyVerb, pages_show_meshes) {
  std::ofstream(folder_ / "mesh.yaml") << R"(world:
  collision_objects:
    - id: fin
      meshes: [{vertices: [[3, 3, 0], [4, 3, 0], [3, 4, 0], [3, 3, 1], [5, 5, 5]],
                triangles: [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]}]
)";
  expect_exit(0, run_minkray(folder_,
                             "verify --robot swing.urdf --scene mesh.yaml --trajectory past.yaml "
                             "-o p.html && grep -c '\"t\":\\[0,2,1,0,1,3,1,2,3,0,3,2\\]' p.html"));
}

/// A tip that runs into a wall was shown from behind the wall.
TEST_F(VerifyVerb, pictures_show_the_body_that_hits) {
  for (const std::string side : {"1.55", "-1.55"}) {
    std::ofstream(folder_ / "wall.yaml")
        << "world: {collision_objects: [{id: wall, primitives: [{type: box, dimensions: [4, 0.02, "
           "4]}], primitive_poses: [{position: [0, " +
               side + ", 0]}]}]}\n";
    std::ofstream(folder_ / "into.yaml")
        << "joint_names: [turn, out]\npoints: [{positions: [0, 0.3]}, {positions: [" +
               std::string(side[0] == '-' ? "-" : "") + "1.5707963, 0.3]}]\n";
    const ProgramOutcome outcome =
        run_minkray(folder_,
                    "verify --robot swing.urdf --scene wall.yaml --trajectory "
                    "into.yaml -o p.pfm -s 1");
    ASSERT_EQ(outcome.exit_code, 1) << outcome.out << outcome.err;
    std::ifstream file(folder_ / "p.pfm", std::ios::binary);
    std::string format, scale;
    int width = 0, height = 0, orange = 0;
    file >> format >> width >> height >> scale;
    file.get();
    std::vector<float> pixels(static_cast<std::size_t>(3 * width * height));
    file.read(reinterpret_cast<char*>(pixels.data()),
              static_cast<std::streamsize>(pixels.size() * sizeof(float)));
    for (std::size_t i = 0; i < pixels.size(); i += 3)
      orange += pixels[i] > 0.02f && pixels[i] > 3 * pixels[i + 2] ? 1 : 0;
    EXPECT_GT(orange, 100) << side;
  }
}

class Proofs : public VerifyVerb {
 protected:
  void SetUp() override {
    if (python().empty()) GTEST_SKIP() << "needs NumPy";
  }
};

TEST_F(Proofs, of_free_motions_and_of_collisions_hold) {
  for (const std::string plan : {"past", "rates", "hit", "bulge"}) {
    const ProgramOutcome made = verify("--trajectory " + plan + ".yaml -o proof.json");
    ASSERT_LE(made.exit_code, 1) << made.err;
    const ProgramOutcome outcome = check("proof.json --files");
    EXPECT_EQ(outcome.exit_code, 0) << plan << outcome.out << outcome.err;
    EXPECT_TRUE(has(outcome.out, made.exit_code == 0 ? "holds: free" : "holds: collides"));
  }
}

/// The swing is within a ring: no plane is between the two.
TEST_F(Proofs, of_meshes_in_hollows_and_of_meshes_that_collide_hold) {
  std::ofstream obj(folder_ / "ring.obj");
  const testing::Surface torus = testing::torus(40, 12);
  for (const Vec3<double>& v : torus.vertices)
    obj << "v " << 2.3 * v.x() << " " << 2.3 * v.y() << " " << v.z() << "\n";
  for (const Corners& t : torus.triangles)
    obj << "f " << t[0] + 1 << " " << t[1] + 1 << " " << t[2] + 1 << "\n";
  obj.close();
  std::ofstream(folder_ / "ring.json")
      << R"({"version": 2, "objects": [{"name": "ring", "mesh": {"file": "ring.obj"}}]})";
  const auto plan = [&](const std::string& name, const std::string& out) {
    std::ofstream(folder_ / name) << R"({"joint_names": ["turn", "out"], "points": [
      {"positions": [0, 0]}, {"positions": [0.8, )" +
                                         out + R"(]}, {"positions": [1.5, 0]}]})";
    return run_minkray(folder_, "verify --robot swing.urdf --scene ring.json --trajectory " + name +
                                    " -o " + name + ".proof.json");
  };
  // The hole's radius is 1.38, but for the straight edges of the mesh.
  const ProgramOutcome free = plan("free.json", "0.05");
  EXPECT_EQ(free.exit_code, 0) << free.out << free.err;
  const ProgramOutcome of_free = check("free.json.proof.json --files");
  EXPECT_TRUE(has(of_free.out, "holds: free")) << of_free.err;
  const ProgramOutcome hit = plan("hit.json", "0.4");
  EXPECT_EQ(hit.exit_code, 1) << hit.out << hit.err;
  const ProgramOutcome of_hit = check("hit.json.proof.json --files");
  EXPECT_TRUE(has(of_hit.out, "holds: collides")) << of_hit.err;
}

TEST_F(Proofs, are_of_the_files_that_were_verified) {
  ASSERT_EQ(verify("--trajectory past.yaml -o proof.json").exit_code, 0);
  std::ofstream(folder_ / "past.yaml", std::ios::app) << "# changed\n";
  const ProgramOutcome outcome = check("proof.json");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(has(outcome.out, "past.yaml: was changed"));
}

TEST_F(Proofs, that_cannot_be_read_are_not_wrong) {
  expect_exit(3, check("none.json"));
  expect_exit(3, check("."));
  expect_exit(2, check(""));
  expect_exit(1, check("past.yaml"));
  std::ofstream(folder_ / "numpy.py") << "raise ImportError\n";
  const ProgramOutcome bare = check("past.yaml", "PYTHONPATH=. ");
  EXPECT_EQ(bare.exit_code, 3);
  EXPECT_EQ(bare.err, "minkray-check: needs NumPy (python3-numpy)\n");
  std::remove((folder_ / "numpy.py").c_str());
  std::ofstream(folder_ / "list.json") << R"([1e999,"sha256":")" << std::string(64, '0') << "\"}\n";
  expect_exit(1, check("list.json"));
  // A name that is a number was the program's own output, which was read and closed.
  ASSERT_EQ(verify("--trajectory past.yaml -o proof.json").exit_code, 0);
  const ProgramOutcome output = run_in(folder_, python() + R"( -c '
import hashlib, re
text = open("proof.json").read()
text = re.sub("\"name\":\"[^\"]*\",\"sha256\"", "\"name\":1,\"sha256\"", text[:text.rindex(",\"sha256")])
print(text + ",\"sha256\":\"" + hashlib.sha256(text.encode()).hexdigest() + "\"}")' > named.json)");
  ASSERT_EQ(output.exit_code, 0) << output.err;
  EXPECT_EQ(check("named.json").out, "named.json: does not hold: files: must have names\n");
}

TEST_F(Proofs, with_a_changed_digit_are_refused_unless_they_are_true) {
  ASSERT_EQ(verify("--trajectory rates.yaml -o proof.json").exit_code, 0);
  expect_exit(0, run_in(folder_, python() + " '" + source_folder().string() +
                                     "/tests/renderer/verify/mutate_proof.py' '" + checker() +
                                     "' proof.json 120"));
}

TEST_F(VerifyVerb, has_a_checker_of_fewer_than_600_lines) {
  std::ifstream stream(checker());
  std::size_t lines = 0;
  for (std::string line; std::getline(stream, line);) ++lines;
  EXPECT_GT(lines, 100u);
  EXPECT_LT(lines, 600u);
}

}  // namespace
}  // namespace minkray
