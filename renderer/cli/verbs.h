// SPDX-License-Identifier: MIT
// The subcommands of the command line, each in its own verb_*.cpp. The list of all of them is here
// and nowhere else.
#pragma once

#include "renderer/cli/exit_code.h"

namespace minkray {

class Parser;

/// Adds a subcommand to the parser. When the user calls it, it runs within Parser::parse, writes
/// results to stdout and all else to stderr, and may set the exit code (done by default) or throw
/// one of renderer/errors.h.
using AddVerb = void (*)(Parser& parser, ExitCode& exit_code);

void add_cast(Parser& parser, ExitCode& exit_code);
void add_clearance(Parser& parser, ExitCode& exit_code);
void add_compare(Parser& parser, ExitCode& exit_code);
void add_completion(Parser& parser, ExitCode& exit_code);
void add_distance(Parser& parser, ExitCode& exit_code);
void add_distance_2d(Parser& parser, ExitCode& exit_code);
void add_field(Parser& parser, ExitCode& exit_code);
void add_generate(Parser& parser, ExitCode& exit_code);
void add_heatmap(Parser& parser, ExitCode& exit_code);
void add_import(Parser& parser, ExitCode& exit_code);
void add_info(Parser& parser, ExitCode& exit_code);
void add_inspect(Parser& parser, ExitCode& exit_code);
void add_league(Parser& parser, ExitCode& exit_code);
void add_man(Parser& parser, ExitCode& exit_code);
void add_merge(Parser& parser, ExitCode& exit_code);
void add_paper(Parser& parser, ExitCode& exit_code);
void add_render(Parser& parser, ExitCode& exit_code);
void add_scan(Parser& parser, ExitCode& exit_code);
void add_trace(Parser& parser, ExitCode& exit_code);

/// They stand in the order in which --help shows them.
inline constexpr AddVerb verbs[] = {
    add_render, add_merge, add_heatmap,    add_inspect,     add_compare,
    add_cast,   add_scan,  add_distance,   add_clearance,   add_field,
    add_league, add_trace, add_paper,      add_distance_2d, add_generate,
    add_import, add_info,  add_completion, add_man,
};

}  // namespace minkray
