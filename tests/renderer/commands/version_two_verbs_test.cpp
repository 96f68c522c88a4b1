// SPDX-License-Identifier: MIT
// Commands read scene files of version 2 all alike: with comments, includes and defaults.
#include <gtest/gtest.h>

#include <tuple>

#include "tests/support/expect_exit.h"
#include "tests/support/temporary_folder.h"

namespace minkray {
namespace {

TEST(VersionTwoFiles, are_read_by_all_commands) {
  const TemporaryFolder folder;
  folder.write("part.json", R"({"version": 2, "materials": [{"name": "m", "type": "lambert",
      "color": "#ff0000"}], "objects": [{"name": "ball", "material": "m",
      "shape": {"type": "sphere", "radius": 1}}]})");
  folder.write("s.json", R"(// mine
      {"version": 2, "include": "part.json", // a ball
       "camera": {"resolution": [16, 9], "keys": [{"time": 0, "fov_y_degrees": 40},
                                                  {"time": 1, "fov_y_degrees": 60}]},
       "objects": [{"name": "far", "include": "part.json", "transform": {"translate": [9, 0, 0]}}]})");
  folder.write("bad.json", R"({"version": 2, "objects": [{"include": "worse.json"}]})");
  folder.write("worse.json", R"({"version": 2, "objects": [{"shape": {"type": "cube"}}]})");
  folder.write("q.jsonl",
               R"({"scene": "s.json", "ray": {"origin": [-9, 0, 0], "direction": [1, 0, 0]}})");
  folder.write("shipped.jsonl",
               R"({"scene": "smallest", "ray": {"origin": [-9, 0, 0], "direction": [1, 0, 0]}})");
  folder.write("r.urdf", R"(<robot name="r"><link name="base"><collision><origin xyz="4 0 0"/>
      <geometry><sphere radius="1"/></geometry></collision></link></robot>)");
  // Each with its exit code, and what is in its output.
  const std::tuple<std::string, int, std::string> commands[] = {
      {"info s.json", 0, "objects     2"},
      {"info s.json --json", 0, "\"objects\": 2"},
      {"render s.json -s 1 -q -o a.png", 0, ""},
      {"render s.json -s 1 -q -o 'a#.png' --frames 0..2", 0, ""},
      {"heatmap s.json -q -o h.png", 0, ""},
      {"scan s.json --pattern spinning:2x4 -q -o a.csv", 0, ""},
      {"trace s.json --pixel 3,3 --json", 0, "\"iterations\""},
      {"cast q.jsonl", 0, "\"object_name\":\"ball\""},
      {"cast shipped.jsonl", 0, "\"object_name\":\"rounded 1\""},
      {"distance r.urdf s.json", 0, "far/ball"},
      {"import s.json -o again.json", 0, ""},
      {"info again.json", 0, "objects     2"},
      {"render s.json r.urdf -s 1 -q -o b.png", 0, ""},
      {"info bad.json", 3,
       "worse.json: /objects/0/shape/type: must be the name of a shape (got \"cube\"; did you mean "
       "\"box\"?)"},
      {"render bad.json -q -o c.png", 3, "worse.json: /objects/0/shape/type"},
      {"distance r.urdf bad.json", 3, "worse.json: /objects/0/shape/type"}};
  for (const auto& [words, exit_code, expected] : commands) {
    const ProgramOutcome outcome = run_minkray(folder, words);
    EXPECT_EQ(outcome.exit_code, exit_code) << words << ": " << outcome.err;
    EXPECT_TRUE(has((outcome.out + outcome.err), expected))
        << words << ": " << outcome.out << outcome.err;
  }
  // The picture is the same for any number of threads, as the default camera and light are.
  expect_exit(0, run_minkray(folder,
                             "render s.json -s 2 -q -t 1 -o 1.pfm && $MINKRAY render "
                             "s.json -s 2 -q -t 7 -o "
                             "7.pfm && cmp 1.pfm 7.pfm"));
  // No output takes the place of an included file.
  expect_exit(
      2, run_in(folder, "ln -s part.json part.png && $MINKRAY render s.json -s 1 -o part.png"));
}

}  // namespace
}  // namespace minkray
