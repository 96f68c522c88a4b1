// SPDX-License-Identifier: MIT
// The program as a whole: its exit codes, and what goes to stdout and to stderr.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <regex>

#include "renderer/info/scene_info.h"
#include "renderer/json/mistakes.h"
#include "tests/support/expect_exit.h"
#include "tests/support/source_files.h"
#include "tests/support/temporary_folder.h"

namespace minkray {
namespace {

std::string scene(const std::string& name) {
  return "'" + (source_folder() / "scenes" / name).string() + "'";
}

TEST(Cli, results_are_on_stdout_and_done_is_0) {
  const ProgramOutcome help = run_minkray("--help");
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_TRUE(has(help.out, "Exit codes: 0 done"));
  EXPECT_EQ(help.err, "");
  const ProgramOutcome schema = run_minkray("info --schema");
  EXPECT_EQ(schema.exit_code, 0);
  EXPECT_EQ(schema.out, schema_text());
  EXPECT_EQ(schema.err, "");
  const ProgramOutcome info = run_minkray("info " + scene("shape-zoo.json"));
  EXPECT_EQ(info.exit_code, 0);
  EXPECT_TRUE(has(info.out, "Every shape and every operator"));
  EXPECT_EQ(info.err, "");
}

TEST(Cli, info_counts_what_objects_are_and_what_they_are_made_of) {
  const std::string text = run_minkray("info " + scene("showcase.json")).out;
  expect_parts(text, {" 1 box, and 3 inside other shapes\n", "  6 sphere inside other shapes\n"});
}

TEST(Cli, the_version_names_the_commit) {
  const ProgramOutcome version = run_minkray("--version");
  EXPECT_EQ(version.exit_code, 0);
  const bool has_history =
      std::filesystem::exists(source_folder() / ".git") &&
      std::system(
          ("git -C '" + source_folder().string() + "' rev-parse HEAD >/dev/null 2>&1").c_str()) ==
          0;
  const std::string commit = has_history ? R"( \([0-9a-f]{12}\+?\))" : "";
  EXPECT_TRUE(
      std::regex_match(version.out, std::regex("minkray [0-9]+\\.[0-9]+\\.[0-9]+" + commit + "\n")))
      << version.out;
}

TEST(Cli, certificates_are_summed_up_on_stderr) {
  const ProgramOutcome cast = run_minkray(
      "cast --certify '" + (source_folder() / "tests/cases/hard-casts.jsonl").string() + "'");
  EXPECT_EQ(cast.exit_code, 0);
  EXPECT_EQ(cast.err,
            "certificates: 100 hold, 0 fail; 0 results have none (distances, shapes that turn, "
            "moving meshes)\n");
  const TemporaryFolder folder;
  const std::string picture = folder / "certified.png";
  expect_exit(0,
              run_minkray("render " + scene("figure-1.json") + " -r 32x18 -s 1 -q --certify -o '" +
                          picture + "'"),
              {"without proof 0\n"});
}

TEST(Cli, the_league_is_a_program_of_its_own) {
  expect_exit(2, run_minkray("league --only 'no such case'"), {"league: "});
}

TEST(Cli, wrong_usage_is_2) {
  for (const std::string arguments :
       {"no-such-verb", "info", "info --no-such-option", "info --shapes --schema",
        "info a.json --schema", "info a.json --markdown", "league --limit 0",
        "league --random few"}) {
    const ProgramOutcome outcome = run_minkray(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_NE(outcome.err, "") << arguments;
  }
}

TEST(Cli, bad_input_is_3_and_all_mistakes_are_on_stderr) {
  const TemporaryFolder folder;
  const std::string file = folder.write("bad.json", R"({"version": 3,
            "camera": {"position": [0, 0, 0], "look_at": [0, 0, 0]}, "lights": [], "materials": [], "objects": {}})");
  const ProgramOutcome bad = run_minkray("info '" + file + "'");
  EXPECT_EQ(bad.exit_code, 3);
  EXPECT_EQ(bad.out, "");
  EXPECT_EQ(bad.err, file + ": /version: must be 1 or 2 (got 3)\n" + file +
                         ": /camera/look_at: must not be the camera's position\n" + file +
                         ": /objects: must be a list (got an object)\n");
  std::filesystem::remove(file);
  expect_exit(3, run_minkray("info '" + file + "'"));
  expect_exit(3, run_minkray("info '" + folder.path().string() + "'"));
}

TEST(Cli, what_cannot_be_written_is_4) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "needs /dev/full";
  const std::string base = "info --schema > /dev/full";
  expect_exit(4, run_minkray(base));
}

TEST(Cli, names_of_files_do_not_steer_the_terminal) {
  const TemporaryFolder folder;
  const std::string name = "c\x1b[31m\xc2\x9b.json";
  std::ofstream(folder / name) << "{\"version\": 2}";
  for (const std::string arguments :
       {"info 'FILE'", "info 'FILE.none'", "cast 'FILE'", "cast 'FILE.none'",
        "render 'FILE' -o a.png", "merge 'FILE' -o a.exr", "cast a.json 'FILE'",
        "import 'FILE' -o a.json", "'FILE'", "info '--FILE'"}) {
    std::string words = arguments;
    words.replace(words.find("FILE"), 4, folder / name);
    const ProgramOutcome outcome = run_minkray(words);
    EXPECT_NE(outcome.exit_code, 0) << arguments;
    EXPECT_TRUE(has(outcome.err, "c?[31m?.json"));
    EXPECT_EQ(outcome.err, printable_lines(outcome.err)) << arguments;
  }
}

/// A query that is as short as they get.
const std::string short_query =
    R"({"query":"distance","a":{"type":"point","position":[0,0,0]},"b":{"type":"sphere","radius":1}})";

std::size_t lines_of(std::string_view text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST(Cli, queries_cut_off_anywhere_are_told_and_all_others_answered) {
  const TemporaryFolder folder;
  {
    std::ofstream file(folder / "q.jsonl");
    for (std::size_t length = 1; length < short_query.size(); ++length)
      file << short_query.substr(0, length) << "\n" << short_query << "\n";
  }
  const ProgramOutcome outcome = run_minkray("cast '" + folder / "q.jsonl" + "'");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_EQ(lines_of(outcome.out), short_query.size() - 1);
  EXPECT_EQ(lines_of(outcome.err), short_query.size() - 1);
  for (std::size_t line = 1; line < 2 * (short_query.size() - 1); line += 2) {
    EXPECT_TRUE(has(outcome.err, "q.jsonl:" + std::to_string(line) + ": ")) << line;
  }
}

TEST(Cli, a_file_of_queries_cut_off_anywhere_is_answered_up_to_there) {
  const std::string text = short_query + "\n" + short_query + "\n";
  const TemporaryFolder folder;
  // Every seventh byte, and all around the lines' ends: each is a process.
  for (std::size_t length = 0; length <= text.size(); ++length) {
    const std::size_t in_line = length % (short_query.size() + 1);
    if (length % 7 != 0 && in_line > 1 && in_line + 2 < short_query.size()) continue;
    std::ofstream(folder / "q.jsonl", std::ios::binary) << text.substr(0, length);
    const ProgramOutcome outcome = run_minkray("cast '" + folder / "q.jsonl" + "'");
    const bool is_cut = in_line != 0 && in_line != short_query.size();
    const std::size_t answers = (length + 1) / (short_query.size() + 1);
    EXPECT_EQ(outcome.exit_code, is_cut ? 3 : 0) << length;
    EXPECT_EQ(lines_of(outcome.out), answers) << length;
    EXPECT_EQ(lines_of(outcome.err), is_cut ? 1u : 0u) << outcome.err;
  }
}

}  // namespace
}  // namespace minkray
