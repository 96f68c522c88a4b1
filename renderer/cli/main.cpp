// SPDX-License-Identifier: MIT
// Command line: minkray COMMAND ARGS...
#include <algorithm>
#include <csignal>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <vector>

#include "renderer/base/build.h"
#include "renderer/base/errors.h"
#include "renderer/cli/options.h"
#include "renderer/cli/program_beside.h"
#include "renderer/cli/verbs.h"
#include "renderer/cli/words_meant.h"
#include "renderer/json/mistakes.h"

namespace {

using minkray::ExitCode;
using minkray::Parser;

/// Shown if only the program's name was typed.
constexpr const char* first_page =
    "Minkray casts rays at exact convex shapes. Three commands to try:\n"
    "\n"
    "  minkray render shape-zoo          a picture of every shape: shape-zoo.png\n"
    "  minkray heatmap showcase          the cost of each pixel: showcase-heatmap.png\n"
    "  minkray info --shapes             the shapes that a scene can contain\n"
    "\n"
    "`minkray help` lists all commands; `minkray help COMMAND` describes one.\n";

/// Reports unknown commands and options before a command; the parser only reports that a command is
/// required.
void check_command(const Parser& parser, const std::string& name) {
  std::vector<std::string> known = parser.verb_names();
  if (std::ranges::find(known, name) != known.end()) return;
  known.insert(known.end(), {"help", "--help", "--version"});
  const std::string meant = minkray::command_meant(name, known);
  throw minkray::WrongUsage(
      std::string(name.starts_with('-') ? "unknown option `" : "unknown command `") +
      minkray::printable(name, 40) + "`" +
      (meant.empty() ? " (minkray --help lists all commands)" : "; " + meant));
}

/// Converts "help" and "help COMMAND" to the equivalent options.
std::vector<std::string> words_of(int argc, char** argv) {
  std::vector<std::string> words(argv, argv + argc);
  if (argc < 2 || words[1] != "help") return words;
  if (argc == 2 || words[2] == "help") return {words[0], "--help"};
  return {words[0], words[2], "--help"};
}

ExitCode run(int argc, char** argv) {
  Parser parser("Minkray casts rays at exact convex shapes.", "minkray");
  parser.set_version(std::string(minkray::version_and_commit()));
  const std::vector<std::string> words = words_of(argc, argv);
  if (words.size() <= 1) {
    std::cout << first_page;
    return ExitCode::done;
  }
  parser.set_footer(
      "Exit codes: 0 done, 1 a comparison or certificate failed (verify: collision),\n"
      "2 wrong usage, 3 bad scene or input, 4 could not write, 6 verify: undecided.\n"
      "Results go to stdout, everything else to stderr.");
  ExitCode exit_code = ExitCode::done;
  const std::span<const minkray::VerbHere> here = minkray::verbs_here();
  for (const minkray::VerbRow& verb : minkray::verbs) {
    const auto found = std::ranges::find(here, verb.name, &minkray::VerbHere::name);
    if (found != here.end())
      found->add(parser, exit_code);
    else if (words[1] == verb.name)
      minkray::run_beside(std::string(verb.name), verb.program, words);
    else
      parser.add_verb(std::string(verb.name));
  }

  const std::string& first = words[1];
  if (first != "-h" && first != "--help" && first != "--version") check_command(parser, first);
  const std::string complaints = parser.parse(words);
  if (!complaints.empty()) exit_code = ExitCode::wrong_usage;
  std::cerr << minkray::printable_lines(complaints);
  std::cout.flush();
  if (!std::cout) throw minkray::CannotWrite("stdout: cannot be written");
  return exit_code;
}

ExitCode run_and_report(int argc, char** argv) {
  const auto report = [](const std::exception& error, ExitCode exit_code) {
    std::cerr << minkray::printable_lines(error.what()) << '\n';
    return exit_code;
  };
  try {
    return run(argc, argv);
  } catch (const minkray::WrongUsage& error) {
    return report(error, ExitCode::wrong_usage);
  } catch (const minkray::CannotWrite& error) {
    return report(error, ExitCode::cannot_write);
  } catch (const std::bad_alloc&) {
    std::cerr << "minkray: out of memory\n";
    return ExitCode::bad_input;
  } catch (const std::exception& error) {
    return report(error, ExitCode::bad_input);
  }
}

}  // namespace

int main(int argc, char** argv) {
  // Beyond a limit of file sizes, writing fails with an error as on a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
  return static_cast<int>(run_and_report(argc, argv));
}
