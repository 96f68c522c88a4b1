// SPDX-License-Identifier: MIT
// The command line: minkray VERB ARGS...
#include <CLI/CLI.hpp>
#include <csignal>
#include <exception>
#include <iostream>
#include <new>
#include <sstream>
#include <string>

#include "renderer/base/errors.h"
#include "renderer/cli/verbs.h"
#include "renderer/json/mistakes.h"

namespace {

using minkray::ExitCode;

/// For someone who only typed the program's name.
constexpr const char* first_page =
    "Minkray casts rays at exact convex shapes. Three commands to try:\n"
    "\n"
    "  minkray render shape-zoo          a picture of every shape: shape-zoo.png\n"
    "  minkray heatmap showcase          what each pixel of it costs: showcase-heatmap.png\n"
    "  minkray info --shapes             what a scene's shapes may be\n"
    "\n"
    "minkray --help lists all verbs, minkray VERB --help tells what one of them takes.\n";

/// CLI11 says of an unknown verb only that one is required.
void check_verb(const CLI::App& app, const std::string& name) {
  std::string names;
  for (const CLI::App* verb : app.get_subcommands(nullptr)) {
    if (verb->get_name() == name) return;
    names += (names.empty() ? "" : ", ") + verb->get_name();
  }
  throw minkray::WrongUsage("minkray: must be one of " + names + " (got " +
                            minkray::printable(name, 40) + ")");
}

ExitCode run(int argc, char** argv) {
  CLI::App app("Minkray casts rays at exact convex shapes.", "minkray");
  app.set_version_flag("--version", "minkray " MINKRAY_VERSION);
  app.require_subcommand(1);
  if (argc <= 1) {
    std::cout << first_page;
    return ExitCode::done;
  }
  app.footer(
      "Exit codes: 0 done, 1 a comparison or certificate failed, 2 wrong usage,\n"
      "3 bad scene or input, 4 could not write. Results are on stdout, everything else on stderr.");
  ExitCode exit_code = ExitCode::done;
  for (const minkray::AddVerb add : minkray::verbs) add(app, exit_code);

  if (argc > 1 && argv[1][0] != '-') check_verb(app, argv[1]);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::ostringstream complaints;
    exit_code =
        app.exit(error, std::cout, complaints) == 0 ? ExitCode::done : ExitCode::wrong_usage;
    std::cerr << minkray::printable_lines(complaints.str());
  }
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
    std::cerr << "minkray: there is not enough memory for this\n";
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
