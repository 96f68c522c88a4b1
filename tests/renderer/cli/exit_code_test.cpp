// SPDX-License-Identifier: MIT
// The program as a whole: its exit codes, and what goes to stdout and to stderr.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>

#include "renderer/scene/scene_info.h"
#include "tests/support/source_files.h"

namespace minkray {
namespace {

struct Outcome {
  int exit_code;
  std::string out, err;
};

/// Runs minkray with arguments for a shell.
Outcome run(const std::string& arguments) {
  const std::string base = testing::TempDir() + "minkray-cli-" +
                           testing::UnitTest::GetInstance()->current_test_info()->name();
  const std::string command = "'" MINKRAY_PROGRAM "' " + arguments;
  const int status =
      std::system(("( " + command + " ) >'" + base + ".out' 2>'" + base + ".err'").c_str());
  Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of_file(base + ".out"),
                  text_of_file(base + ".err")};
  std::filesystem::remove(base + ".out");
  std::filesystem::remove(base + ".err");
  return outcome;
}

std::string scene(const std::string& name) {
  return "'" + (source_folder() / "scenes" / name).string() + "'";
}

TEST(Cli, results_are_on_stdout_and_done_is_0) {
  const Outcome help = run("--help");
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_NE(help.out.find("Exit codes: 0 done"), std::string::npos);
  EXPECT_EQ(help.err, "");
  const Outcome schema = run("info --schema");
  EXPECT_EQ(schema.exit_code, 0);
  EXPECT_EQ(schema.out, schema_text());
  EXPECT_EQ(schema.err, "");
  const Outcome info = run("info " + scene("shape-zoo.json"));
  EXPECT_EQ(info.exit_code, 0);
  EXPECT_NE(info.out.find("Every shape and every operator"), std::string::npos);
  EXPECT_EQ(info.err, "");
  EXPECT_EQ(run("--version").exit_code, 0);
}

TEST(Cli, certificates_are_summed_up_on_stderr) {
  const Outcome cast = run("cast --certify '" MINKRAY_TEST_CASES "/hard-casts.jsonl'");
  EXPECT_EQ(cast.exit_code, 0);
  EXPECT_EQ(cast.err, "certificates: 47 hold, 0 do not; 0 answers without (distances, turning)\n");
  const std::string picture = testing::TempDir() + "minkray-certified.png";
  const Outcome render =
      run("render " + scene("figure-1.json") + " -r 32x18 -s 1 -q --certify -o '" + picture + "'");
  EXPECT_EQ(render.exit_code, 0) << render.err;
  EXPECT_NE(render.err.find("without proof 0\n"), std::string::npos) << render.err;
  std::filesystem::remove(picture);
}

TEST(Cli, wrong_usage_is_2) {
  for (const std::string arguments :
       {"", "no-such-verb", "info", "info --no-such-option", "info --shapes --schema",
        "info a.json --schema", "info a.json --markdown"}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_NE(outcome.err, "") << arguments;
  }
}

TEST(Cli, bad_input_is_3_and_all_mistakes_are_on_stderr) {
  const std::string file = testing::TempDir() + "minkray-cli-bad.json";
  const auto write = [&](const std::string& text) {
    std::FILE* out = std::fopen(file.c_str(), "wb");
    std::fwrite(text.data(), 1, text.size(), out);
    std::fclose(out);
  };
  write(R"({"version": 2, "camera": {"position": [0, 0, 0], "look_at": [0, 0, 0]},
            "lights": [], "materials": [], "objects": {}})");
  const Outcome bad = run("info '" + file + "'");
  EXPECT_EQ(bad.exit_code, 3);
  EXPECT_EQ(bad.out, "");
  EXPECT_EQ(bad.err, file + ": /version: must be 1 (got 2)\n" + file +
                         ": /camera/look_at: must not be the camera's position\n" + file +
                         ": /objects: must be a list (got an object)\n");
  std::filesystem::remove(file);
  EXPECT_EQ(run("info '" + file + "'").exit_code, 3);
  EXPECT_EQ(run("info '" + testing::TempDir() + "'").exit_code, 3);
}

TEST(Cli, what_cannot_be_written_is_4) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "needs /dev/full";
  const std::string base = "info --schema > /dev/full";
  EXPECT_EQ(run(base).exit_code, 4);
}

}  // namespace
}  // namespace minkray
