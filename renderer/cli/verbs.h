// SPDX-License-Identifier: MIT
// The subcommands of the command line, each in its own verb_*.cpp. The list of all of them is here
// and nowhere else.
#pragma once

#include "renderer/cli/exit_code.h"

namespace CLI {
class App;
}

namespace minkray {

/// Adds a subcommand to the app. When the user calls it, it runs within App::parse, writes results
/// to stdout and all else to stderr, and may set the exit code (done by default) or throw one of
/// renderer/errors.h.
using AddVerb = void (*)(CLI::App& app, ExitCode& exit_code);

void add_cast(CLI::App& app, ExitCode& exit_code);
void add_compare(CLI::App& app, ExitCode& exit_code);
void add_completion(CLI::App& app, ExitCode& exit_code);
void add_distance(CLI::App& app, ExitCode& exit_code);
void add_distance_2d(CLI::App& app, ExitCode& exit_code);
void add_generate(CLI::App& app, ExitCode& exit_code);
void add_heatmap(CLI::App& app, ExitCode& exit_code);
void add_import(CLI::App& app, ExitCode& exit_code);
void add_info(CLI::App& app, ExitCode& exit_code);
void add_man(CLI::App& app, ExitCode& exit_code);
void add_merge(CLI::App& app, ExitCode& exit_code);
void add_paper(CLI::App& app, ExitCode& exit_code);
void add_render(CLI::App& app, ExitCode& exit_code);
void add_scan(CLI::App& app, ExitCode& exit_code);
void add_trace(CLI::App& app, ExitCode& exit_code);

/// In the order in which --help shows them.
inline constexpr AddVerb verbs[] = {
    add_render,   add_merge,    add_heatmap, add_compare,    add_cast,
    add_scan,     add_distance, add_trace,   add_paper,      add_distance_2d,
    add_generate, add_import,   add_info,    add_completion, add_man,
};

}  // namespace minkray
