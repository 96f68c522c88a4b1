// SPDX-License-Identifier: MIT
// The commands of docs/robots.md, unchanged.
#include <gtest/gtest.h>

#include <sstream>

#include "tests/support/program.h"
#include "tests/support/robot_models.h"

namespace minkray {
namespace {

/// Lines between "```sh" and "```".
std::vector<std::string> commands_in(const std::string& page) {
  std::vector<std::string> commands;
  std::istringstream lines(text_of_file(source_folder() / page));
  bool is_open = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```"))
      is_open = line == "```sh";
    else if (is_open)
      commands.push_back(line);
  }
  return commands;
}

TEST(RobotsPage, every_command_of_the_robots_page_runs) {
  if (!has_robot_models()) GTEST_SKIP() << "run scenes/fetch-models";
  const TemporaryFolder folder;
  const std::vector<std::string> commands = commands_in("docs/robots.md");
  EXPECT_GE(commands.size(), 7u);
  for (const std::string& command : commands) {
    const bool is_ours = command.starts_with("./run ");
    ASSERT_TRUE(is_ours || command.starts_with("printf ")) << command;
    const ProgramOutcome outcome =
        run_in(folder, "ln -sfn '" + (source_folder() / "scenes").string() + "' scenes && " +
                           (is_ours ? "$MINKRAY " + command.substr(6) : command));
    EXPECT_EQ(outcome.exit_code, 0) << command << "\n" << outcome.err;
  }
  const std::vector<std::string> files = folder.files();
  for (const char* made :
       {"humanoid.png", "humanoid.json", "sweep.npy", "sweep.ply", "ids.json", "moving.pcd"})
    EXPECT_NE(std::ranges::find(files, made), files.end()) << made;
}

}  // namespace
}  // namespace minkray
