// SPDX-License-Identifier: MIT
// No command writes over what it reads, nor writes one file twice: every output option of every
// command, as its help lists them, onto every input, by every kind of name that a file may have.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <set>

#include "renderer/cli/verbs.h"
#include "tests/renderer/cli/nothing_lost.h"
#include "tests/support/expect_exit.h"
#include "tests/support/source_files.h"

namespace minkray {
namespace {

namespace fs = std::filesystem;

/// A command that reads a file by one of its options.
struct Reading {
  std::string option, file, words;
};

struct Writing {
  std::string file;        ///< of the right ending
  std::string words = {};  ///< that the option needs
};

struct Command {
  std::string verb;
  std::vector<Reading> readings;
  std::map<std::string, Writing> outputs;  ///< by option
  bool can_run = true;                     ///< false if an optional part is not built
};

/// Every command that writes files.
std::vector<Command> writing_commands() {
  const std::string robot = "r.urdf -r 8x6 ", rows = "r.urdf -r 8x6 --joints rows.csv ";
  const std::vector<Reading> scene = {{"scene", "r.urdf", robot}, {"--joints", "rows.csv", rows}};
  const auto with = [](std::vector<Reading> readings, const std::string& words) {
    for (Reading& one : readings) one.words += words;
    return readings;
  };
  std::vector<Reading> several = scene;
  several.push_back({"others", "scene.json", "r.urdf scene.json -r 8x6 "});
  std::vector<Reading> pictures = several;
  pictures.push_back({"--camera-file", "camera.json", robot + "--camera-file camera.json "});
  return {
      {"render",
       with(pictures, "-s 1 -q"),
       {{"--output", {"o.png"}},
        {"--contact-sheet", {"sheet.png", " --frames 0..1 --output 'o#.png'"}}}},
      {"merge", {{"parts", "part.exr", "part.exr"}}, {{"--output", {"o.png"}}}},
      {"heatmap", with(pictures, "-q"), {{"--output", {"o.png"}}}},
      {"inspect", with(pictures, "-s 1 -q"), {{"--output", {"o.html"}}}},
      {"compare", with(several, "--rays 10 --directions 20 -q"), {{"--output", {"o.png"}}}},
      {"scan",
       {{"scene", "r.urdf", "r.urdf --pattern spinning:2x4 -q"},
        {"others", "scene.json", "r.urdf scene.json --pattern spinning:2x4 -q"},
        {"--joints", "rows.csv", "r.urdf --pattern spinning:2x4 -q --joints rows.csv"},
        {"--rays", "rays.npy", "r.urdf -q --rays rays.npy"},
        {"--pattern", "pattern.csv", "r.urdf -q --pattern pattern.csv"},
        {"--pinhole", "camera.json", "r.urdf -q --pinhole camera.json"},
        {"--path", "poses.csv", "r.urdf --pattern spinning:2x4 -q --path poses.csv"}},
       {{"--output", {"o.ply"}}, {"--ids", {"o.json", " --output o.ply"}}}},
      {"distance",
       {{"files", "r.urdf", "r.urdf"},
        {"files", "scene.json", "r.urdf scene.json"},
        {"--srdf", "r.srdf", "r.urdf --srdf r.srdf"}},
       {{"--output", {"o.csv"}}}},
      {"clearance",
       {{"robot", "r.urdf", "r.urdf --path rows.csv"},
        {"others", "scene.json", "r.urdf scene.json --path rows.csv"},
        {"--path", "rows.csv", "r.urdf --path rows.csv"},
        {"--obstacle", "scene.json", "r.urdf --path rows.csv --obstacle scene.json"},
        {"--srdf", "r.srdf", "r.urdf --path rows.csv --srdf r.srdf"}},
       {{"--steps", {"o.csv"}}, {"--sweep", {"o.json"}}}},
      {"verify",
       {{"--robot", "r.urdf", "--robot r.urdf --trajectory rows.csv"},
        {"--trajectory", "rows.csv", "--robot r.urdf --trajectory rows.csv"},
        {"--scene", "scene.json", "--robot r.urdf --trajectory rows.csv --scene scene.json"},
        {"--srdf", "r.srdf", "--robot r.urdf --trajectory rows.csv --srdf r.srdf"}},
       {{"--output", {"o.json"}}}},
      {"field",
       with({{"scene", "r.urdf", robot},
             {"others", "r.urdf", "r.urdf r.urdf -r 8x6 "},  // the scene has particles
             {"--joints", "rows.csv", rows},
             {"--probe", "probe.json", robot + "--probe probe.json "}},
            "-q"),
       {{"--output", {"o.png"}}}},
      {"trace", with(pictures, "--pixel 1,1"), {{"--svg", {"o.svg"}}}},
      {"distance-2d", {{"file", "pair.json", "pair.json"}}, {{"--output", {"o.svg"}}}},
      {"generate", {{"", "", "spheres -n 3"}}, {{"--output", {"o.json"}}}},
      {"import",
       {{"file", "r.urdf", "r.urdf -q"},
        {"others", "r.urdf", "r.urdf r.urdf -q"},
        {"--joints", "rows.csv", "r.urdf -q --joints rows.csv"}},
       {{"--output", {"o.json"}}}},
      {"league",
       {{"--cases", "queries.jsonl", "--cases queries.jsonl"}},
       {{"--html", {"o.html"}}, {"--json", {"o.json"}}},
       false},
  };
}

/// The options of a command's help whose value is of a kind, "FILE" or "OUTPUT", by long name.
std::set<std::string> options_taking(const std::string& verb, const std::string& kind) {
  const std::string help = run_minkray(verb + " --help").out;
  const std::regex entry("\n  (-[a-zA-Z0-9,-]+|[a-z]+) " + kind + "\\b");
  std::set<std::string> options;
  for (std::sregex_iterator match(help.begin(), help.end(), entry), end; match != end; ++match) {
    const std::string names = (*match)[1];
    const std::size_t first = names.find("--");
    options.insert(first == names.npos ? names
                                       : names.substr(first, names.find(',', first) - first));
  }
  return options;
}

constexpr const char* plain_scene = R"({"version": 1,
  "camera": {"position": [0, -9, 3], "look_at": [0, 0, 0], "fov_y_degrees": 30, "resolution": [8, 6]},
  "lights": [{"type": "environment", "file": "sky.png"}],
  "materials": [{"name": "m", "type": "lambert", "color": {"type": "image", "file": "paint.png"}}],
  "objects": [{"name": "a", "material": "m", "shape": {"type": "hull", "file": "t.obj"}},
              {"name": "b", "material": "m", "split": "groups", "shape": {"type": "hull", "file": "u.obj"}}],
  "particles": [{"name": "p", "material": "m", "shape": {"type": "sphere", "radius": 0.1}, "file": "p.csv"}]})";

constexpr const char* robot_text = R"(<robot name="r">
  <link name="a"><visual><geometry><mesh filename="t.obj"/></geometry></visual>
    <collision><geometry><mesh filename="g.gltf"/></geometry></collision></link>
  <link name="b"><visual><geometry><box size="1 1 1"/></geometry></visual>
    <collision><geometry><box size="1 1 1"/></geometry></collision></link>
  <joint name="j" type="prismatic"><parent link="a"/><child link="b"/><origin xyz="3 0 0"/><axis xyz="1 0 0"/>
    <limit lower="-10" upper="10" effort="1" velocity="1"/></joint></robot>)";

/// Four vertices of a cube's corner, as glTF with its buffer in a separate file.
std::string gltf_text() {
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 6, "type": "VEC3"}],
    "bufferViews": [{"buffer": 0, "byteLength": 72}], "buffers": [{"byteLength": 72, "uri": "g.bin"}]})";
}

class Outputs : public NothingLost {
 protected:
  Outputs() {
    const std::string mesh =
        "o x\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n";
    folder_.write("t.obj", mesh);
    folder_.write("u.obj", mesh);
    folder_.write("p.csv", "1,2,3\n");
    folder_.write("r.urdf", robot_text);
    folder_.write("rows.csv", "time,j\n0,0\n1,1\n");
    folder_.write("r.srdf", R"(<robot name="r"><disable_collisions link1="a" link2="b"/></robot>)");
    folder_.write("pattern.csv", "time,azimuth,zenith\n0,1,90\n");
    folder_.write("poses.csv", "time,x,y,z\n0,0,0,0\n");
    folder_.write("camera.json",
                  R"({"fx": 4, "fy": 4, "cx": 4, "cy": 3, "width": 8, "height": 6})");
    folder_.write("probe.json", R"({"type": "hull", "file": "u.obj"})");
    folder_.write("pair.json", R"({"a": {"type": "hull", "file": "t.obj"},
                                   "b": {"type": "sphere", "radius": 1}})");
    folder_.write("queries.jsonl", "\n");
    folder_.write("g.gltf", gltf_text());
    const float points[18] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    folder_.write("g.bin", {reinterpret_cast<const char*>(points), sizeof points});
    folder_.write("m.xml", R"(<mujoco><include file="inner.xml"/><worldbody>
      <geom type="mesh" mesh="t"/></worldbody></mujoco>)");
    folder_.write("inner.xml", R"(<mujoco><asset><mesh file="t.obj"/></asset></mujoco>)");
    fs::create_directory(folder_ / "box");
    folder_.write("w.world", R"(<sdf version="1.6"><world name="w"><include><uri>model://box</uri>
      </include></world></sdf>)");
    folder_.write("box/model.config",
                  R"(<model><name>box</name><sdf version="1.6">model.sdf</sdf></model>)");
    folder_.write("box/model.sdf", R"(<sdf version="1.6"><model name="m"><link name="l"><visual
      name="v"><geometry><mesh><uri>t.obj</uri></mesh></geometry></visual></link></model></sdf>)");
    fs::copy_file(folder_ / "t.obj", folder_ / "box/t.obj");
    std::string npy = "{'descr': '<f4', 'fortran_order': False, 'shape': (1, 6), }";
    npy.resize(128 - 10 - 1, ' ');
    const float ray[6] = {0, 0, 9, 0, 0, -1};
    npy = std::string("\x93NUMPY\x01\x00\x76\x00", 10) + npy + "\n" +
          std::string(reinterpret_cast<const char*>(ray), sizeof ray);
    folder_.write("rays.npy", npy);
    write_ball_scene(folder_ / "ball.json");
    expect_exit(0, shell(R"(set -e
      "$MINKRAY" render ball.json -s 1 -r 8x6 -q -o sky.png -o paint.png --checkpoint 0
      "$MINKRAY" render ball.json -s 1 -r 8x6 -q --tile 1/1 -o part.exr --checkpoint 0
      mkdir sub; ln -s . here)"));
    folder_.write("scene.json", plain_scene);
    remember();
  }

  void remember() {
    before_.clear();
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path()))
      if (entry.is_regular_file()) before_[entry.path().string()] = text_of_file(entry.path());
  }

  /// New other names of a file, with the extension that an output needs.
  std::vector<std::string> other_names(const std::string& file, const std::string& ending) {
    const fs::path link = folder_.path() / ("link" + ending),
                   hard = folder_.path() / ("hard" + ending);
    std::error_code error;
    fs::remove(link, error);
    fs::remove(hard, error);
    fs::create_symlink(fs::path(file), link);
    fs::create_hard_link(folder_.path() / file, hard);
    return {link.filename().string(), hard.filename().string(), "here/" + link.filename().string()};
  }

  void expect_refused(const std::string& words, const std::string& option,
                      const std::string& name) {
    const ProgramOutcome outcome = minkray(words);
    EXPECT_EQ(outcome.exit_code, 2) << words << "\n" << outcome.err;
    EXPECT_EQ(outcome.err.find(option + ": " + name + " is read or written already, as "), 0u)
        << words << "\n"
        << outcome.err;
    ++refused_;
  }

  void expect_nothing_changed(const std::string& verb) {
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path())) {
      const std::string name = entry.path().filename().string();
      if (!entry.is_regular_file() || name.starts_with("hard") || name.starts_with("link"))
        continue;
      const auto known = before_.find(entry.path().string());
      if (known == before_.end())
        ADD_FAILURE() << verb << " wrote " << name;
      else
        EXPECT_EQ(text_of_file(entry.path()), known->second) << verb << " wrote over " << name;
    }
  }

  /// The words of an option with a file.
  static std::string output(const std::string& option, const std::string& file) {
    return " " + option + " '" + file + "'";
  }
  std::map<std::string, std::string> before_;
  int refused_ = 0;
};

TEST_F(Outputs, no_option_takes_a_text_that_help_does_not_name) {
  for (const VerbRow& row : verbs)
    EXPECT_EQ(options_taking(std::string(row.name), "TEXT"), std::set<std::string>()) << row.name;
}

TEST_F(Outputs, every_file_option_of_every_command_is_in_the_table) {
  std::map<std::string, Command> commands;
  for (const Command& command : writing_commands()) commands[command.verb] = command;
  for (const VerbRow& row : verbs) {
    const std::string verb(row.name);
    const std::set<std::string> written = options_taking(verb, "OUTPUT");
    if (written.empty()) {
      EXPECT_FALSE(commands.contains(verb)) << verb;
      continue;
    }
    ASSERT_TRUE(commands.contains(verb)) << verb << " writes files";
    std::set<std::string> outputs, inputs;
    for (const auto& [option, writing] : commands[verb].outputs) outputs.insert(option);
    for (const Reading& one : commands[verb].readings)
      if (!one.option.empty()) inputs.insert(one.option);
    EXPECT_EQ(written, outputs) << verb;
    std::set<std::string> files = options_taking(verb, "FILE");
    files.merge(options_taking(verb, "PATTERN"));  // a scan pattern may be a file
    EXPECT_EQ(files, inputs) << verb;
  }
}

TEST_F(Outputs, every_command_runs_where_no_output_is_an_input) {
  for (const Command& command : writing_commands()) {
    if (!command.can_run) continue;
    for (const Reading& one : command.readings) {
      for (const auto& [option, writing] : command.outputs) {
        const std::string words =
            command.verb + " " + one.words + writing.words + output(option, writing.file);
        const ProgramOutcome outcome = minkray(words);
        EXPECT_EQ(outcome.exit_code, 0) << words << "\n" << outcome.err;
      }
    }
  }
}

TEST_F(Outputs, none_is_a_file_that_an_option_names) {
  for (const Command& command : writing_commands()) {
    for (const auto& [option, writing] : command.outputs)
      for (const Reading& one : command.readings) {
        if (one.file.empty()) continue;
        const std::string words = command.verb + " " + one.words + writing.words;
        std::vector<std::string> names = other_names(one.file, fs::path(writing.file).extension());
        for (const char* before : {"", "./", "sub/../", "here/"})
          names.push_back(before + one.file);
        for (const std::string& name : names)
          expect_refused(words + output(option, name), option, name);
      }
    expect_nothing_changed(command.verb);
  }
  EXPECT_GT(refused_, 200);
}

TEST_F(Outputs, none_is_a_file_that_an_input_names) {
  struct Source {
    std::string file;
    std::vector<std::string> named;
  };
  const std::vector<Source> sources = {
      {"scene.json", {"t.obj", "u.obj", "sky.png", "paint.png", "p.csv"}},
      {"r.urdf", {"t.obj", "g.gltf", "g.bin"}},
      {"m.xml", {"inner.xml", "t.obj"}},
      {"w.world", {"box/model.config", "box/model.sdf", "box/t.obj"}},
      {"g.gltf", {"g.bin"}}};
  for (const Command& command : writing_commands()) {
    const Reading& first = command.readings.front();
    if (!command.can_run || (first.option != "scene" && command.verb != "import")) continue;
    for (const auto& [option, writing] : command.outputs)
      for (const Source& source : sources) {
        if (source.file == "scene.json" && command.verb == "import") continue;
        const std::string words =
            command.verb + " " +
            std::regex_replace(first.words, std::regex("r\\.urdf"), source.file) + writing.words;
        for (const std::string& named : source.named)
          for (const std::string& name : other_names(named, fs::path(writing.file).extension()))
            expect_refused(words + output(option, name), option, name);
      }
    expect_nothing_changed(command.verb);
  }
  EXPECT_GT(refused_, 200);
}
/// The files that options besides the scene name have files of their own.
TEST_F(Outputs, none_is_a_mesh_of_an_obstacle_a_probe_or_a_pair) {
  for (const auto& [words, option, ending, named] :
       std::vector<std::tuple<std::string, std::string, std::string, std::string>>{
           {"distance r.urdf scene.json", "--output", ".csv", "u.obj"},
           {"distance r.urdf scene.json", "--output", ".csv", "g.bin"},
           {"clearance r.urdf --path rows.csv --obstacle scene.json", "--steps", ".csv", "u.obj"},
           {"clearance r.urdf --path rows.csv --obstacle scene.json", "--sweep", ".json",
            "paint.png"},
           {"clearance r.urdf --path rows.csv", "--sweep", ".json", "g.bin"},
           {"field ball.json -q --probe probe.json", "--output", ".png", "u.obj"},
           {"distance-2d pair.json", "--output", ".svg", "t.obj"}})
    for (const std::string& name : other_names(named, ending))
      expect_refused(words + output(option, name), option, name);
  expect_nothing_changed("distance, clearance, field and distance-2d");
}

TEST_F(Outputs, none_is_written_twice) {
  for (const Command& command : writing_commands()) {
    const std::string words = command.verb + " " + command.readings.front().words;
    for (const auto& [option, writing] : command.outputs)
      for (const auto& [other, its_writing] : command.outputs) {
        if (option >= other) continue;
        for (const char* before : {"", "./", "sub/../", "here/"}) {
          const ProgramOutcome outcome = minkray(words + output(option, "x.json") +
                                                 output(other, before + std::string("x.json")));
          EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
          EXPECT_TRUE(has(outcome.err, "is read or written already, as")) << words;
        }
      }
  }
  expect_refused("render ball.json -o a.png -o ./a.png", "--output", "./a.png");
  expect_refused("merge part.exr -o a.exr -o here/a.exr", "--output", "here/a.exr");
  expect_refused("heatmap ball.json -o a.png -o sub/../a.png", "--output", "sub/../a.png");
  expect_refused("scan ball.json --pattern spinning:2x4 -o a.ply -o ./a.ply", "--output",
                 "./a.ply");
  expect_nothing_changed("a command");
}

/// Files next to an output with a name of their own.
TEST_F(Outputs, frames_checkpoints_and_records_are_outputs_too) {
  fs::copy_file(folder_ / "ball.json", folder_ / "a.png.checkpoint");
  fs::copy_file(folder_ / "ball.json", folder_ / "f#.png.frames");
  fs::copy_file(folder_ / "ball.json", folder_ / "f07.png");
  fs::create_symlink("ball.json", folder_.path() / "g3.png");
  remember();
  expect_refused("render a.png.checkpoint -o a.png", "--output", "a.png.checkpoint");
  expect_refused("render 'f#.png.frames' --frames 0..3 -o 'f#.png'", "--output", "f#.png.frames");
  expect_refused("render f07.png --frames 0..9 -o 'f##.png'", "--output", "f07.png");
  expect_refused("render ball.json --frames 0..9 -o 'g#.png'", "--output", "g3.png");
  expect_refused("render ball.json --frames 0..12 -o 'h#.png' -o 'here/h##.png'", "--output",
                 "here/h10.png");
  expect_nothing_changed("render");
}

TEST_F(Outputs, devices_and_pipes_may_be_named_twice) {
  expect_exit(0, minkray("scan ball.json --pattern spinning:2x4 -q -o o.ply --ids /dev/null"));
  expect_exit(0, minkray("clearance r.urdf --path rows.csv --steps /dev/null --sweep /dev/null"));
}

}  // namespace
}  // namespace minkray
