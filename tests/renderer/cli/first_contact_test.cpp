// SPDX-License-Identifier: MIT
// First steps after installing Minkray: scenes by name, pictures without -o, previews, completions
// and man pages.
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <tuple>

#include "renderer/cli/verbs.h"
#include "renderer/paper/solvers.h"
#include "tests/support/expect_exit.h"
#include "tests/support/source_files.h"

namespace minkray {
namespace {

TEST(FirstContact, the_program_alone_shows_three_commands_to_try) {
  const ProgramOutcome page = run_shell("$MINKRAY");
  EXPECT_EQ(page.exit_code, 0);
  EXPECT_EQ(page.err, "");
  std::istringstream lines(page.out);
  int commands = 0;
  for (std::string line; std::getline(lines, line);) commands += line.starts_with("  minkray ");
  EXPECT_EQ(commands, 3);
}

TEST(FirstContact, a_scene_is_found_by_its_name_and_its_picture_goes_to_that_name) {
  const TemporaryFolder folder;
  expect_exit(0, run_minkray(folder, "render shape-zoo -r 32x18 -s 1"),
              {"the picture goes to shape-zoo.png\n"});
  EXPECT_EQ(folder.files(), std::vector<std::string>{"shape-zoo.png"});
  const std::string picture = text_of_file(folder / "shape-zoo.png");
  const std::string by_path = "'" + (source_folder() / "scenes/shape-zoo.json").string() + "'";
  expect_exit(0, run_minkray(folder, "render " + by_path + " -r 32x18 -s 1 -q -o b.png"));
  EXPECT_EQ(text_of_file(folder / "b.png"), picture);
  expect_exit(0, run_minkray(folder, "heatmap shape-zoo -r 32x18 -q"));
  EXPECT_EQ(folder.files(),
            (std::vector<std::string>{"b.png", "shape-zoo-heatmap.png", "shape-zoo.png"}));
}

TEST(FirstContact, no_picture_is_promised_where_none_will_be_made) {
  for (const std::string arguments :
       {"render shape-zoo -r 10", "heatmap shape-zoo --channel cost",
        "render shape-zoo --crop 0,0,9999,9", "render no/such.json"}) {
    const ProgramOutcome outcome = run_minkray(arguments);
    EXPECT_NE(outcome.exit_code, 0) << arguments;
    EXPECT_FALSE(has(outcome.err, "the picture goes to"));
  }
}

TEST(FirstContact, an_unknown_name_is_told_with_the_names_there_are) {
  expect_exit(3, run_minkray("render showcsae -o /dev/null"),
              {"showcsae: must be", "shape-zoo, showcase", "did you mean `showcase`?"});
}

/// Message of the program for a command line that it rejects.
std::string refusal(const std::string& words, int exit_code = 2) {
  const ProgramOutcome outcome = run_minkray(words);
  EXPECT_EQ(outcome.exit_code, exit_code) << words << ": " << outcome.err;
  EXPECT_EQ(outcome.out, "") << words;
  return outcome.err;
}

TEST(FirstContact, words_that_are_not_known_are_told_with_what_to_write) {
  const std::pair<const char*, const char*> typed[] = {
      {"rendr", "unknown command `rendr`; did you mean `render`?"},
      {"-v", "unknown option `-v`; did you mean `--version`?"},
      {"-V", "did you mean `--version`?"},
      {"version", "did you mean `--version`?"},
      {"hlep", "did you mean `help`?"},
      {"lidar", "did you mean `scan`?"},
      {"convert", "did you mean `import`?"},
      {"frobnicate", "minkray --help lists all commands"},
      {"--solver", "unknown option `--solver`"},
      {"help rendr", "did you mean `render`?"},
      {"render shape-zoo --samples 4", "unknown option `--samples`; did you mean `--spp N`?"},
      {"render shape-zoo --width 320", "did you mean `--resolution WIDTHxHEIGHT`?"},
      {"render shape-zoo --camera 1,2,3", "set it in the scene file: \"camera\""},
      {"render shape-zoo --smaples 4", "did you mean `--spp N`?"},
      {"render shape-zoo --toenmap agx", "did you mean `--tonemap`?"},
      {"render shape-zoo --no-such-thing", "minkray render --help lists all"},
      {"cast queries.jsonl other.json", "unexpected argument `other.json`"},
      {"render shape-zoo -o a.exr --aov depth", "did you mean `Z`?"},
      {"render shape-zoo -o a.exr --aov normals", "did you mean `N`?"},
      {"render shape-zoo --tonemap aces", "did you mean `filmic`?"},
      {"render shape-zoo --solver papr", "did you mean `paper`?"},
      {"render shape-zoo --integrator pathtracing", "did you mean `path`?"},
      {"trace shape-zoo --pixl 3,3", "did you mean `--pixel`?"},
      {"man rendr", "render"}};
  for (const auto& [words, expected] : typed) EXPECT_TRUE(has(refusal(words), expected)) << words;
}

TEST(FirstContact, files_and_words_of_other_programs_are_told_with_ours) {
  const TemporaryFolder folder;
  const auto scene = [&](const std::string& shape, const std::string& material,
                         const std::string& light) {
    return R"({"version": 1, "camera": {"position": [0, -5, 1], "look_at": [0, 0, 0]}, "lights": [{"type": ")" +
           light + R"("}], "materials": [{"name": "m", "type": ")" + material +
           R"("}], "objects": [{"name": "o", "material": "m", "shape": {"type": ")" + shape +
           R"("}}]})";
  };
  const std::tuple<std::string, std::string, std::string> files[] = {
      {"a.json", scene("cube", "lambert", "point"), "did you mean \"box\"?"},
      {"a.json", scene("mesh", "lambert", "point"), "an object has a \"mesh\" instead"},
      {"a.json", scene("torus", "lambert", "point"), "a torus is not convex"},
      {"a.json", scene("sphere", "glass", "point"), "did you mean \"dielectric\"?"},
      {"a.json", scene("sphere", "metal", "point"), "did you mean \"conductor\"?"},
      {"a.json", scene("sphere", "lambert", "area"), "an object with an \"emissive\" material"},
      {"a.json", scene("sphere", "lambert", "area light"),
       "an object with an \"emissive\" material"},
      {"a.json", scene("sphere", "area light", "point"), "did you mean \"emissive\"?"},
      {"a.json", scene("xyzzy", "lambert", "point"), "hull_of, transform, plane"},
      {"a.json", scene("floor", "lambert", "point"), "did you mean \"plane\"?"},
      {"a.json", scene("sphere", "lambert", "spot"), "there are no spot lights"},
      {"a.json", "// mine\n{\"version\": 1}", "JSON has no comments"},
      {"a.json", "{\"version\": 1 // mine\n}", "JSON has no comments"},
      {"a.json", "{\"version\": 1} # mine\n", "JSON has no comments"},
      {"a.png", "\x89PNG\r\n", "is a picture (PNG)"},
      {"a.blend", "BLENDER-v402", "is a Blender file: export it as glTF"},
      {"a.stl", "solid a\n", "is a mesh (STL): use it as the \"file\" of a \"mesh\""}};
  for (const auto& [name, text, expected] : files) {
    const std::string message = refusal("info '" + folder.write(name, text) + "'", 3);
    EXPECT_TRUE(has(message, expected)) << text;
  }
  // The picture's own name would be that of its output.
  EXPECT_TRUE(
      has(refusal("render '" + folder.write("a.png", "\x89PNG\r\n") + "'", 3), "is a picture"));
  const std::string robot =
      folder.write("r.xml", "<mujoco><worldbody><geom size=\"1\"/></worldbody></mujoco>");
  EXPECT_TRUE(has(refusal("info '" + robot + "' --keyframe squat", 3),
                  "--keyframe: no keyframe named squat; the file has no keyframes"));
}

TEST(FirstContact, help_is_a_command_too) {
  const std::string all = run_minkray("--help").out;
  EXPECT_TRUE(has(all, "Subcommands:"));
  EXPECT_EQ(run_minkray("help").out, all);
  EXPECT_EQ(run_minkray("help help").out, all);
  for (const VerbRow& row : minkray::verbs) {
    const std::string name(row.name);
    const ProgramOutcome help = run_minkray("help " + name);
    EXPECT_EQ(help.exit_code, 0) << name;
    EXPECT_EQ(help.out, run_minkray(name + " --help").out) << name;
  }
}

TEST(FirstContact, help_has_lines_of_80_columns_two_examples_and_no_task_of_the_sources) {
  std::vector<std::string> pages = {run_minkray("--help").out, run_shell("$MINKRAY").out};
  for (const VerbRow& row : minkray::verbs) {
    pages.push_back(run_minkray(std::string(row.name) + " --help").out);
    std::size_t examples = 0;
    for (std::size_t at = 0;
         (at = pages.back().find("\n  minkray " + std::string(row.name), at)) != std::string::npos;
         ++at)
      ++examples;
    EXPECT_EQ(examples, 2u) << row.name;
  }
  for (const std::string& page : pages) {
    EXPECT_FALSE(has(page, "./run"));
    std::istringstream lines(page);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
  }
}

/// The options of the examples are there.
TEST(FirstContact, examples_use_options_that_there_are) {
  for (const VerbRow& row : minkray::verbs) {
    const std::string help = run_minkray(std::string(row.name) + " --help").out;
    for (const std::string_view example : row.examples) {
      const std::string text(example);
      const std::regex option(" (--?[a-z][a-z0-9-]*)");
      for (std::sregex_iterator match(text.begin(), text.end(), option), end; match != end; ++match)
        EXPECT_TRUE(
            std::regex_search(help, std::regex("\n  ([^ ]*,)?" + (*match)[1].str() + "[ ,\n]")))
            << text;
    }
  }
}

TEST(FirstContact, a_joint_beyond_its_limits_is_told_on_stderr) {
  const TemporaryFolder folder;
  const std::string robot = folder.write(
      "r.urdf",
      R"(<robot name="r"><link name="a"><visual><geometry><box size="1 1 1"/></geometry></visual></link><link name="b"/>
      <joint name="j" type="revolute"><parent link="a"/><child link="b"/><limit lower="-1" upper="1" effort="1"
      velocity="1"/></joint></robot>)");
  const std::string render =
      "$MINKRAY render '" + robot + "' -r 8x6 -s 1 -o '" + folder / "a.png" + "' --joint j=";
  EXPECT_TRUE(has(run_shell(render + "9").err, "limit of the joint \"j\": at 9, outside -1 to 1"));
  EXPECT_FALSE(has(run_shell(render + "0.5").err, "limit"));
}

TEST(FirstContact, of_a_mesh_the_triangle_that_is_hit_is_traced) {
  const TemporaryFolder folder;
  const auto scene = [&](const char* objects) {
    return folder.write("m.json",
                        std::string(R"({"version": 2, "camera": {"position": [0.1, 0.2, 5],
      "look_at": [0.1, 0.2, 0], "up": [0, 1, 0]}, "objects": [)") +
                            objects + "]}");
  };
  const std::string mesh = scene(R"({"name": "m", "mesh": {"vertices": [[9, 9, 0], [9, 8, 0],
      [8, 9, 0], [-1, -1, 0], [1, -1, 0], [0, 2, 0]], "triangles": [[0, 1, 2], [3, 4, 5]]}})");
  const std::string trace = "trace '" + mesh + "' -r 3x3 --pixel ";
  const std::string hit = run_minkray(trace + "1,1").out;
  EXPECT_TRUE(has(hit, "object \"m\", triangle 1: hit, t = 5")) << hit;
  EXPECT_TRUE(has(run_minkray(trace + "1,1 --json").out, "\"triangle\":1"));
  EXPECT_TRUE(has(refusal(trace + "0,0", 3), "the ray hits no mesh"));
  scene(R"({"shape": {"type": "plane"}})");
  EXPECT_TRUE(has(refusal(trace + "1,1", 3), "has no shape with iterations"));
}

TEST(FirstContact, each_verb_that_takes_a_solver_says_which_there_are) {
  for (const std::string verb : {"render", "heatmap", "compare", "inspect", "cast", "trace"}) {
    // Lines are broken where they are too long.
    const std::string help =
        std::regex_replace(run_minkray(verb + " --help").out, std::regex("\\s+"), " ");
    for (const auto& solver : named_solvers)
      EXPECT_TRUE(has(help, std::string(solver.name) + ": " + std::string(solver.doc)))
          << verb << " " << solver.name;
  }
}

TEST(FirstContact, without_an_output_nobody_elses_file_is_replaced) {
  const TemporaryFolder folder;
  write_ball_scene(folder / "ball.json");
  const std::string render = "$MINKRAY render ball.json -q -r 16x9 -s 1";
  expect_exit(0, run_in(folder, render));
  expect_exit(0, run_in(folder, render));  // Minkray's own picture is
  std::ofstream(folder / "ball.png") << "a photograph";
  expect_exit(2, run_in(folder, render), {"ball.png exists and was not written by Minkray"});
  EXPECT_EQ(text_of_file(folder / "ball.png"), "a photograph");
  expect_exit(2, run_minkray(folder, "render ball.json --tile 1/2 -q"));
}

TEST(FirstContact, a_preview_is_drawn_with_half_blocks_where_there_is_no_terminal) {
  const TemporaryFolder folder;
  write_ball_scene(folder / "ball.json");
  const std::string render = "$MINKRAY render ball.json -q -r 160x90 -s 1 --preview";
  const ProgramOutcome blocks = run_in(folder, render);
  EXPECT_EQ(blocks.exit_code, 0) << blocks.err;
  std::size_t halves = 0;
  for (std::size_t at = 0; (at = blocks.out.find("\xe2\x96\x80", at)) != std::string::npos; ++at)
    ++halves;
  EXPECT_EQ(halves, 80u * 23u);  // 80 columns, 45 rows of pixels
  EXPECT_TRUE(run_in(folder, render + "=kitty").out.starts_with("\x1b_Gf=100"));
  EXPECT_TRUE(run_in(folder, render + "=sixel").out.starts_with("\x1bPq"));
  expect_exit(2, run_in(folder, render + "=hologram"));
}

/// The verbs that --help lists.
std::vector<std::string> names_of_verbs() {
  const std::string help = run_minkray("--help").out;
  std::vector<std::string> names;
  std::istringstream lines(help.substr(help.find("Subcommands:")));
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line) && line.starts_with("  "))
    if (line[2] != ' ') names.push_back(line.substr(2, line.find(' ', 2) - 2));
  return names;
}

/// The long options that a verb's --help lists, each where its entry begins.
std::set<std::string> options_in_help(const std::string& verb) {
  const std::string help = run_minkray(verb + " --help").out;
  const std::regex entry("\n  (-[a-z0-9,-]+)"), option("--[a-z][a-z0-9-]*");
  std::set<std::string> options;
  for (std::sregex_iterator match(help.begin(), help.end(), entry), end; match != end; ++match) {
    const std::string names = (*match)[1];
    for (std::sregex_iterator name(names.begin(), names.end(), option); name != end; ++name)
      options.insert(name->str());
  }
  return options;
}

TEST(ManPages, every_verb_has_one_with_just_the_options_of_its_help) {
  const std::vector<std::string> names = names_of_verbs();
  ASSERT_GT(names.size(), 10u);
  const std::string all = run_minkray("man").out;
  for (const std::string& verb : names) {
    std::string page = run_minkray("man " + verb).out;
    page = std::regex_replace(page, std::regex("\\\\-"), "-");
    EXPECT_TRUE(page.starts_with(".TH \"minkray-" + verb + "\"")) << page.substr(0, 80);
    std::set<std::string> options;
    const std::regex entry("\n\\.TP\n\\.BR? \"?(-[a-z0-9, -]+)"), option("--[a-z][a-z0-9-]*");
    for (std::sregex_iterator match(page.begin(), page.end(), entry), end; match != end; ++match) {
      const std::string list = (*match)[1];
      for (std::sregex_iterator name(list.begin(), list.end(), option); name != end; ++name)
        options.insert(name->str());
    }
    EXPECT_EQ(options, options_in_help(verb)) << verb;
    EXPECT_TRUE(has(all, "minkray\\-" + std::regex_replace(verb, std::regex("-"), "\\-") + " (1)"))
        << verb;
  }
  expect_exit(2, run_minkray("man no-such-verb"));
}

TEST(Completion, bash_offers_the_options_of_each_verbs_help) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_minkray("completion bash > '" + folder / "minkray" + "'").exit_code, 0);
  for (const std::string& verb : names_of_verbs()) {
    const ProgramOutcome offered =
        run_shell("bash -c 'source \"" + folder / "minkray" + "\"; COMP_WORDS=(minkray " + verb +
                  " --); COMP_CWORD=2; _minkray; printf \"%s\\n\" \"${COMPREPLY[@]}\"'");
    std::set<std::string> options;
    std::istringstream lines(offered.out);
    for (std::string line; std::getline(lines, line);) options.insert(line);
    EXPECT_EQ(options, options_in_help(verb)) << verb << offered.err;
  }
}

TEST(Completion, bash_offers_verbs_and_the_values_of_an_option) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_minkray("completion bash > '" + folder / "minkray" + "'").exit_code, 0);
  const auto offered = [&](const std::string& words, int at) {
    return run_shell("bash -c 'source \"" + folder / "minkray" + "\"; COMP_WORDS=(" + words +
                     "); COMP_CWORD=" + std::to_string(at) +
                     "; _minkray; echo \"${COMPREPLY[@]}\"'")
        .out;
  };
  EXPECT_EQ(offered("minkray heat", 1), "heatmap\n");
  EXPECT_EQ(offered("minkray render --build \"\"", 3), "quality speed\n");
  EXPECT_EQ(offered("minkray completion z", 2), "zsh\n");
}

TEST(Completion, every_shell_knows_every_long_option) {
  for (const std::string shell : {"bash", "zsh", "fish"}) {
    const std::string text = run_minkray("completion " + shell).out;
    for (const std::string& verb : names_of_verbs())
      for (const std::string& option : options_in_help(verb))
        EXPECT_TRUE(has(text, shell == "fish" ? " -l " + option.substr(2) : option))
            << shell << " " << verb << " " << option;
    if (has_program(shell)) {
      const TemporaryFolder folder;
      std::ofstream(folder / "completion") << text;
      EXPECT_EQ(run_shell(shell + " -n '" + folder / "completion" + "'").exit_code, 0) << shell;
    }
  }
}

}  // namespace
}  // namespace minkray
