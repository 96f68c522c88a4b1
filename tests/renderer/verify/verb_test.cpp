// SPDX-License-Identifier: MIT
// minkray verify and minkray-check as their users meet them.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "renderer/json/json.h"
#include "tests/support/meshes.h"
#include "tests/support/program.h"
#include "tests/support/source_files.h"

namespace minkray {
namespace {

/// A ball that a hinge swings at a distance of 1, another one that slides out from it, and a post.
void write_swing(const TemporaryFolder& folder) {
  std::ofstream(folder / "swing.urdf") << R"(<robot name="swing">
  <link name="base"/>
  <link name="bob"><collision><origin xyz="1 0 0"/><geometry><sphere radius="0.1"/></geometry></collision></link>
  <link name="tip"><collision><origin xyz="1.2 0 0"/><geometry><sphere radius="0.05"/></geometry></collision></link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="bob"/><axis xyz="0 0 1"/>
    <limit lower="-4" upper="4" effort="1" velocity="1"/></joint>
  <joint name="out" type="prismatic"><parent link="bob"/><child link="tip"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="1" effort="1" velocity="1"/></joint>
</robot>)";
  // At (0, 1.5): the bob passes it by 0.2 on its circle, and the tip by 1.5 - 1.2 - 0.05 - 0.2.
  std::ofstream(folder / "scene.yaml") << R"(world:
  collision_objects:
    - id: post
      primitives: [{type: sphere, dimensions: [0.2]}]
      primitive_poses: [{position: [0, 1.5, 0], orientation: [0, 0, 0, 1]}]
)";
  std::ofstream(folder / "past.yaml") << R"(joint_trajectory:
  joint_names: [turn, out]
  points:
    - {positions: [0, 0], time_from_start: {sec: 0, nanosec: 0}}
    - {positions: [3.141592653589793, 0], time_from_start: {sec: 2, nanosec: 0}}
)";
  std::ofstream(folder / "hit.yaml") << R"(joint_trajectory:
  joint_names: [turn, out]
  points:
    - {positions: [0, 0.3], time_from_start: {sec: 0, nanosec: 0}}
    - {positions: [3.141592653589793, 0.3], time_from_start: {sec: 2, nanosec: 0}}
)";
  // From 0.2 to 0.2 via 0.05 less: by rates alone, the rows look free.
  std::ofstream(folder / "bulge.yaml") << R"(joint_names: [turn, out]
points:
  - {positions: [1.5707963267948966, 0.0], velocities: [0, 0.8], time_from_start: 0}
  - {positions: [1.5707963267948966, 0.0], velocities: [0, -0.8], time_from_start: 1}
)";
  std::ofstream(folder / "rates.yaml") << R"(joint_names: [turn, out]
points:
  - {positions: [0, 0], velocities: [1, 0], time_from_start: 0}
  - {positions: [1.4, 0.02], velocities: [0.7, 0.01], time_from_start: 1}
  - {positions: [3, 0], velocities: [0, 0], time_from_start: 3}
)";
}

ProgramOutcome verify(const TemporaryFolder& folder, const std::string& words) {
  return run_shell("cd '" + folder / "" +
                   "' && $MINKRAY verify --robot swing.urdf --scene scene.yaml " + words);
}

TEST(VerifyVerb, free_motions_have_their_least_clearance) {
  const TemporaryFolder folder;
  write_swing(folder);
  const ProgramOutcome outcome = verify(folder, "--trajectory past.yaml --json --tolerance 1e-6");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json json = Json::parse(outcome.out);
  EXPECT_EQ(json["status"].text(), "free");
  // The tip passes the post at half a circle's half.
  EXPECT_NEAR(json["lower"].get<double>(), 0.05, 1e-6);
  EXPECT_LE(json["lower"].get<double>(), 0.05);
  EXPECT_NEAR(json["time"].get<double>(), 1, 1e-3);
  EXPECT_EQ(json["a"].text(), "tip/sphere");
  EXPECT_EQ(json["b"].text(), "post");
  const ProgramOutcome words = verify(folder, "--trajectory past.yaml");
  EXPECT_NE(words.out.find("past.yaml: free: every pair stays at least"), std::string::npos)
      << words.out;
}

TEST(VerifyVerb, collisions_are_named_from_when_to_when) {
  const TemporaryFolder folder;
  write_swing(folder);
  const ProgramOutcome outcome = verify(folder, "--trajectory hit.yaml --json");
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

TEST(VerifyVerb, what_happens_between_the_rows_counts) {
  const TemporaryFolder folder;
  write_swing(folder);
  // With a cubic of rates 0.8 and -0.8 the tip goes out by 0.8 / 4, and 0.05 of that is free.
  EXPECT_EQ(verify(folder, "--trajectory bulge.yaml").exit_code, 1);
  EXPECT_EQ(verify(folder, "--trajectory past.yaml --padding 0.049").exit_code, 0);
  EXPECT_EQ(verify(folder, "--trajectory past.yaml --padding 0.051").exit_code, 1);
  EXPECT_EQ(verify(folder, "--trajectory past.yaml --inflate tip=0.051").exit_code, 1);
  EXPECT_EQ(verify(folder, "--trajectory past.yaml --inflate bob=0.051").exit_code, 0);
  // Exactly touching is neither.
  EXPECT_EQ(verify(folder, "--trajectory past.yaml --padding 0.05").exit_code, 6);
}

TEST(VerifyVerb, a_table_has_a_row_for_each_step) {
  const TemporaryFolder folder;
  write_swing(folder);
  const ProgramOutcome outcome = verify(folder, "--trajectory rates.yaml --table");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_EQ(outcome.out.find("begin,end,lower,upper,time,a,b\n"), 0u);
  EXPECT_EQ(std::ranges::count(outcome.out, '\n'), 3);
}

TEST(VerifyVerb, serves_a_verdict_for_each_line) {
  const TemporaryFolder folder;
  write_swing(folder);
  std::ofstream(folder / "plans.jsonl")
      << R"({"joint_names": ["turn"], "points": [{"positions": [0]}, {"positions": [3]}]})"
      << "\n"
      << "\"hit.yaml\"\n"
      << R"({"joint_names": ["nope"], "points": [{"positions": [0]}]})"
      << "\n";
  const ProgramOutcome outcome = verify(folder, "--serve < plans.jsonl");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::istringstream lines(outcome.out);
  std::vector<std::string> status;
  for (std::string line; std::getline(lines, line);)
    status.push_back(Json::parse(line)["status"].text());
  EXPECT_EQ(status, (std::vector<std::string>{"free", "collides", "error"}));
}

/// Velocities lead a continuous joint round its whole way, where a post is.
TEST(VerifyVerb, continuous_joints_with_velocities_go_their_own_way) {
  const TemporaryFolder folder;
  write_swing(folder);
  std::ifstream file(folder / "swing.urdf");
  std::string urdf((std::istreambuf_iterator<char>(file)), {});
  urdf.replace(urdf.find("\"revolute\""), 10, "\"continuous\"");
  std::ofstream(folder / "swing.urdf") << urdf;
  const auto plan = [&](const std::string& name, const std::string& velocities) {
    std::ofstream(folder / name) << R"({"joint_names": ["turn", "out"], "points": [
      {"positions": [0, 0.3])" + velocities +
                                        R"(, "time_from_start": 0},
      {"positions": [5, 0.3])" + velocities +
                                        R"(, "time_from_start": 1}]})";
    return verify(folder, "--trajectory " + name);
  };
  EXPECT_EQ(plan("own.json", R"(, "velocities": [5, 0])").exit_code, 1);
  // The shorter way does not come by the post.
  EXPECT_EQ(plan("shorter.json", "").exit_code, 0);
}

TEST(VerifyVerb, a_joint_is_named_once_and_a_bad_plan_hides_no_other) {
  const TemporaryFolder folder;
  write_swing(folder);
  std::ofstream(folder / "twice.json")
      << R"({"joint_names": ["turn", "turn"], "points": [{"positions": [1, 0.2]}]})";
  const ProgramOutcome outcome = verify(folder, "--trajectory twice.json --trajectory hit.yaml");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("/joint_names/1: duplicate"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.out.find("hit.yaml: collides"), std::string::npos) << outcome.out;
}

/// There is no proof of what is undecided; the verdict has its exit code all the same.
TEST(VerifyVerb, an_undecided_motion_is_that_also_where_a_proof_is_requested) {
  const TemporaryFolder folder;
  write_swing(folder);
  const ProgramOutcome outcome = verify(folder, "--trajectory past.yaml --budget 1 -o proof.json");
  EXPECT_EQ(outcome.exit_code, 6) << outcome.out << outcome.err;
  EXPECT_NE(outcome.err.find("undecided"), std::string::npos) << outcome.err;
  EXPECT_FALSE(std::ifstream(folder / "proof.json").good());
}

TEST(VerifyVerb, mistakes_are_told) {
  const TemporaryFolder folder;
  write_swing(folder);
  EXPECT_EQ(verify(folder, "").exit_code, 2);
  EXPECT_EQ(verify(folder, "--trajectory past.yaml -o proof.txt").exit_code, 2);
  EXPECT_EQ(verify(folder, "--trajectory past.yaml --trajectory hit.yaml -o proof.json").exit_code,
            2);
  const ProgramOutcome missing = verify(folder, "--trajectory none.yaml");
  EXPECT_EQ(missing.exit_code, 3);
  EXPECT_NE(missing.err.find("none.yaml"), std::string::npos);
  std::ofstream(folder / "bad.yaml") << "joint_names: [turn]\npoints:\n  - positions: [0, 1]\n";
  const ProgramOutcome bad = verify(folder, "--trajectory bad.yaml");
  EXPECT_EQ(bad.exit_code, 3);
  EXPECT_NE(bad.err.find("bad.yaml: line 3: /points/0/positions: "), std::string::npos) << bad.err;
}

TEST(VerifyVerb, tables_of_numbers_are_plans_too) {
  const TemporaryFolder folder;
  write_swing(folder);
  std::ofstream(folder / "plan.csv") << "time,turn,out\n0,0,0\n2,3.14159265,0\n";
  const ProgramOutcome csv = verify(folder, "--trajectory plan.csv --json");
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
  std::ofstream(folder / "plan.npy") << npy;
  const ProgramOutcome array = verify(folder, "--trajectory plan.npy --json");
  ASSERT_EQ(array.exit_code, 0) << array.err;
  EXPECT_NEAR(Json::parse(array.out)["lower"].get<double>(), 0.05, 0.001);
}

TEST(VerifyVerb, pictures_and_pages_are_written) {
  const TemporaryFolder folder;
  write_swing(folder);
  ASSERT_EQ(verify(folder, "--trajectory past.yaml -o p.html -o p.png -s 1").exit_code, 0);
  const auto begin_of = [&](const std::string& file) {
    std::ifstream stream(folder / file);
    std::string text(15, '\0');
    stream.read(text.data(), 15);
    return text;
  };
  EXPECT_EQ(begin_of("p.html"), "<!doctype html>");
  EXPECT_EQ(begin_of("p.png").substr(1, 3), "PNG");
}

/// Meshes were shown as squares of six metres.
TEST(VerifyVerb, pages_show_meshes) {
  const TemporaryFolder folder;
  write_swing(folder);
  std::ofstream(folder / "mesh.yaml") << R"(world:
  collision_objects:
    - id: fin
      meshes: [{vertices: [[3, 3, 0], [4, 3, 0], [3, 4, 0], [3, 3, 1], [5, 5, 5]],
                triangles: [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]}]
)";
  const ProgramOutcome outcome =
      run_shell("cd '" + folder / "" +
                "' && $MINKRAY verify --robot swing.urdf --scene mesh.yaml --trajectory past.yaml "
                "-o p.html && grep -c '\"t\":\\[0,2,1,0,1,3,1,2,3,0,3,2\\]' p.html");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
}

/// A tip that runs into a wall was shown from behind the wall.
TEST(VerifyVerb, pictures_show_the_body_that_hits) {
  const TemporaryFolder folder;
  write_swing(folder);
  for (const std::string side : {"1.55", "-1.55"}) {
    std::ofstream(folder / "wall.yaml")
        << "world: {collision_objects: [{id: wall, primitives: [{type: box, dimensions: [4, 0.02, "
           "4]}], primitive_poses: [{position: [0, " +
               side + ", 0]}]}]}\n";
    std::ofstream(folder / "into.yaml")
        << "joint_names: [turn, out]\npoints: [{positions: [0, 0.3]}, {positions: [" +
               std::string(side[0] == '-' ? "-" : "") + "1.5707963, 0.3]}]\n";
    const ProgramOutcome outcome =
        run_shell("cd '" + folder / "" +
                  "' && $MINKRAY verify --robot swing.urdf --scene wall.yaml --trajectory "
                  "into.yaml -o p.pfm -s 1");
    ASSERT_EQ(outcome.exit_code, 1) << outcome.out << outcome.err;
    std::ifstream file(folder / "p.pfm", std::ios::binary);
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

/// A Python that has NumPy; empty if there is none.
std::string python_with_numpy() {
  for (const std::string python : {"python3", "/usr/bin/python3"})
    if (run_shell(python + " -c 'import numpy'").exit_code == 0) return python;
  return "";
}

std::string checker() {
  return std::string(source_folder()) + "/tools/minkray-check";
}

class Proofs : public ::testing::Test {
 protected:
  void SetUp() override {
    python_ = python_with_numpy();
    if (python_.empty()) GTEST_SKIP() << "needs NumPy";
    write_swing(folder_);
  }
  ProgramOutcome check(const std::string& words) {
    return run_shell("cd '" + folder_ / "" + "' && " + python_ + " '" + checker() + "' " + words);
  }
  TemporaryFolder folder_;
  std::string python_;
};

TEST_F(Proofs, of_free_motions_and_of_collisions_hold) {
  for (const std::string plan : {"past", "rates", "hit", "bulge"}) {
    const ProgramOutcome made = verify(folder_, "--trajectory " + plan + ".yaml -o proof.json");
    ASSERT_LE(made.exit_code, 1) << made.err;
    const ProgramOutcome outcome = check("proof.json --files");
    EXPECT_EQ(outcome.exit_code, 0) << plan << outcome.out << outcome.err;
    EXPECT_NE(outcome.out.find(made.exit_code == 0 ? "holds: free" : "holds: collides"),
              std::string::npos)
        << outcome.out;
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
    return run_shell("cd '" + folder_ / "" + "' && $MINKRAY verify --robot swing.urdf " +
                     "--scene ring.json --trajectory " + name + " -o " + name + ".proof.json");
  };
  // The hole's radius is 1.38, but for the straight edges of the mesh.
  const ProgramOutcome free = plan("free.json", "0.05");
  EXPECT_EQ(free.exit_code, 0) << free.out << free.err;
  const ProgramOutcome of_free = check("free.json.proof.json --files");
  EXPECT_NE(of_free.out.find("holds: free"), std::string::npos) << of_free.out << of_free.err;
  const ProgramOutcome hit = plan("hit.json", "0.4");
  EXPECT_EQ(hit.exit_code, 1) << hit.out << hit.err;
  const ProgramOutcome of_hit = check("hit.json.proof.json --files");
  EXPECT_NE(of_hit.out.find("holds: collides"), std::string::npos) << of_hit.out << of_hit.err;
}

TEST_F(Proofs, are_of_the_files_that_were_verified) {
  ASSERT_EQ(verify(folder_, "--trajectory past.yaml -o proof.json").exit_code, 0);
  std::ofstream(folder_ / "past.yaml", std::ios::app) << "# changed\n";
  const ProgramOutcome outcome = check("proof.json");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.out.find("past.yaml: was changed"), std::string::npos) << outcome.out;
}

TEST_F(Proofs, that_cannot_be_read_are_not_wrong) {
  EXPECT_EQ(check("none.json").exit_code, 3);
  EXPECT_EQ(check(".").exit_code, 3);
  EXPECT_EQ(check("").exit_code, 2);
  EXPECT_EQ(check("past.yaml").exit_code, 1);
  std::ofstream(folder_ / "numpy.py") << "raise ImportError\n";
  const ProgramOutcome bare = run_shell("cd '" + folder_ / "" + "' && PYTHONPATH=. " + python_ +
                                        " '" + checker() + "' past.yaml");
  EXPECT_EQ(bare.exit_code, 3);
  EXPECT_EQ(bare.err, "minkray-check: needs NumPy (python3-numpy)\n");
  std::remove((folder_ / "numpy.py").c_str());
  std::ofstream(folder_ / "list.json") << R"([1e999,"sha256":")" << std::string(64, '0') << "\"}\n";
  EXPECT_EQ(check("list.json").exit_code, 1);
  // A name that is a number was the program's own output, which was read and closed.
  ASSERT_EQ(verify(folder_, "--trajectory past.yaml -o proof.json").exit_code, 0);
  const ProgramOutcome output = run_shell("cd '" + folder_ / "" + "' && " + python_ + R"( -c '
import hashlib, re
text = open("proof.json").read()
text = re.sub("\"name\":\"[^\"]*\",\"sha256\"", "\"name\":1,\"sha256\"", text[:text.rindex(",\"sha256")])
print(text + ",\"sha256\":\"" + hashlib.sha256(text.encode()).hexdigest() + "\"}")' > named.json)");
  ASSERT_EQ(output.exit_code, 0) << output.err;
  EXPECT_EQ(check("named.json").out, "named.json: does not hold: files: must have names\n");
}

TEST_F(Proofs, with_a_changed_digit_are_refused_unless_they_are_true) {
  ASSERT_EQ(verify(folder_, "--trajectory rates.yaml -o proof.json").exit_code, 0);
  const ProgramOutcome outcome =
      run_shell("cd '" + folder_ / "" + "' && " + python_ + " '" + std::string(source_folder()) +
                "/tests/renderer/verify/mutate_proof.py' '" + checker() + "' proof.json 120");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
}

TEST(Checker, has_fewer_than_600_lines) {
  std::ifstream stream(checker());
  std::size_t lines = 0;
  for (std::string line; std::getline(stream, line);) ++lines;
  EXPECT_GT(lines, 100u);
  EXPECT_LT(lines, 600u);
}

}  // namespace
}  // namespace minkray
