// SPDX-License-Identifier: MIT
// The commands that the documents show are there: verbs, tasks, their options, and scripts.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "renderer/cli/verbs.h"
#include "tests/support/program.h"
#include "tests/support/source_files.h"

namespace minkray {
namespace {

namespace fs = std::filesystem;

struct ShownCommand {
  std::string page;
  std::vector<std::string> words;
};

/// README.md and the pages of docs/ that describe the current state: not the changelog, records
/// and decisions, which describe the past.
std::vector<SourceFile> pages() {
  std::vector<SourceFile> pages = {{"README.md", text_of_file(source_folder() / "README.md")}};
  for (const SourceFile& file : files_in("docs"))
    if (file.name.ends_with(".md") && std::ranges::count(file.name, '/') == 1)
      pages.push_back(file);
  return pages;
}

/// Text between backquotes, which may continue in the next line, and each line by itself; in
/// pieces where a shell or a comment would cut them.
std::vector<ShownCommand> shown_commands() {
  const std::regex quoted("`([^`]+)`"), cut(R"re(;|\||&&|\s#\s|\n)re"), blank(R"re(\s+)re");
  std::vector<ShownCommand> commands;
  for (const SourceFile& page : pages()) {
    const std::string lines = std::regex_replace(page.text, std::regex("```"), "\n");
    std::string text = lines;
    for (std::sregex_iterator span(lines.begin(), lines.end(), quoted), end; span != end; ++span)
      text += "\n" + std::regex_replace((*span)[1].str(), blank, " ");
    for (std::sregex_token_iterator piece(text.begin(), text.end(), cut, -1), end; piece != end;
         ++piece) {
      std::istringstream line(piece->str());
      ShownCommand command{page.name, {}};
      for (std::string word; line >> word;) command.words.push_back(word);
      if (!command.words.empty()) commands.push_back(command);
    }
  }
  return commands;
}

bool is_verb(const std::string& name) {
  return std::ranges::find(verbs, name, &VerbRow::name) != std::end(verbs);
}

/// True for a verb's or a task's name, not for a placeholder such as VERB.
bool is_name(const std::string& word) {
  return std::regex_match(word, std::regex("[a-z][a-z0-9-]*"));
}

/// True if help lists the option, with other names of it or alone.
bool has_option(const std::string& verb, const std::string& option) {
  static std::map<std::string, std::string> helps;
  std::string& help = helps[verb];
  if (help.empty()) help = run_minkray(verb + " --help").out;
  return std::regex_search(help, std::regex("\n  [^ ][^ ]*" + option + "[ ,{]")) ||
         std::regex_search(help, std::regex("\n  " + option + "[ ,{]"));
}

TEST(Documents, every_verb_task_and_option_that_they_show_is_there) {
  std::size_t commands = 0, options = 0;
  for (const ShownCommand& command : shown_commands()) {
    const std::string& program = command.words[0];
    if ((program != "./run" && program != "minkray") || command.words.size() < 2) continue;
    const std::string& name = command.words[1];
    if (!is_name(name)) continue;
    std::string text;
    for (const std::string& word : command.words) text += word + " ";
    const bool is_task = program == "./run" && fs::exists(source_folder() / ".ci/tasks" / name);
    EXPECT_TRUE(is_task || is_verb(name)) << command.page << ": " << text;
    ++commands;
    if (is_task || !is_verb(name)) continue;
    const std::regex option(R"re((^|[ \[])(--[a-z][a-z0-9-]*))re");
    for (std::sregex_iterator match(text.begin(), text.end(), option), end; match != end; ++match) {
      EXPECT_TRUE(has_option(name, (*match)[2])) << command.page << ": " << text;
      ++options;
    }
  }
  EXPECT_GT(commands, 100u);  // the test has found the commands
  EXPECT_GT(options, 80u);
}

// With --help a task begins no work; some of it takes hours.
TEST(Documents, every_task_says_what_it_does) {
  const std::string run = "'" + (source_folder() / "run").string() + "' ";
  std::size_t tasks = 0;
  for (const SourceFile& task : files_in(".ci/tasks")) {
    const std::string name = fs::path(task.name).filename().string();
    const ProgramOutcome help = run_shell(run + name + " --help");
    EXPECT_EQ(help.exit_code, 0) << name;
    EXPECT_TRUE(help.out.starts_with("./run " + name + " ")) << name << ": " << help.out;
    EXPECT_EQ(help.err, "") << name;
    ++tasks;
  }
  EXPECT_GT(tasks, 20u);  // the test has found them
}

TEST(Documents, every_script_that_they_show_can_be_run) {
  std::size_t scripts = 0;
  for (const ShownCommand& command : shown_commands()) {
    const fs::path script = command.words[0];
    const std::string folder = script.begin()->string();
    if (folder != "bench" && folder != "scenes" && folder != "renderer") continue;
    // Sources and scenes are named without arguments; what has no ending is a script.
    const bool is_run =
        script.extension() == ".py" ? command.words.size() > 1 : !script.has_extension();
    const fs::path file = source_folder() / script;
    if (!is_run || fs::is_directory(file) || !script.has_filename()) continue;
    if (script.string().starts_with("scenes/meshes/")) continue;  // is fetched, or not there
    std::error_code error;
    const fs::perms owner = fs::status(file, error).permissions() & fs::perms::owner_exec;
    EXPECT_TRUE(fs::is_regular_file(file) && owner != fs::perms::none)
        << command.page << " shows " << script << ", which is no file that can be run";
    ++scripts;
  }
  EXPECT_GT(scripts, 5u);  // the test has found them
}

}  // namespace
}  // namespace minkray
