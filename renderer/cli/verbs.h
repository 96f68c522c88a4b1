// SPDX-License-Identifier: MIT
// The subcommands of the command line, each in its own verb_*.cpp. The list of all of them is here
// and nowhere else, with the program that has each: a picture is made by a program that has nothing
// else to compile (docs/decisions/build-time.md). The others lie beside it and are run by it.
#pragma once

#include <span>
#include <string_view>

#include "renderer/cli/exit_code.h"

namespace minkray {

class Parser;

struct VerbRow {
  std::string_view name;
  std::string_view doc;
  const char* program;
};

/// They stand in the order in which --help shows them.
inline constexpr VerbRow verbs[] = {
    {"render", "Make a picture of a scene", "minkray"},
    {"merge", "Make a picture of the part files by render --tile and --sample-share", "minkray"},
    {"heatmap", "Show what each pixel of a scene costs", "minkray"},
    {"inspect", "Make a page that shows each pixel's cast step by step (docs/inspector.md)",
     "minkray-inspect"},
    {"compare", "Check every object of a scene against triangle meshes in Embree",
     "minkray-compare"},
    {"cast", "Answer ray, shape and distance queries, one JSON object a line (docs/cast.md)",
     "minkray-tools"},
    {"scan", "Cast a sensor's rays at a scene: lidars, depths", "minkray-tools"},
    {"distance", "The signed distance of two shapes, with bounds (docs/contact.md)",
     "minkray-tools"},
    {"clearance", "How near a robot comes to itself and to obstacles along a path, proven",
     "minkray-tools"},
    {"field", "Show the signed distance from a scene's objects over a plane (docs/contact.md)",
     "minkray-tools"},
    {"trace", "Show every iteration of the cast for one pixel", "minkray-tools"},
    {"paper", "Rerun the claims of the papers (docs/papers.md)", "minkray-tools"},
    {"distance-2d", "Draw the distance algorithm on two flat shapes, one panel an iteration",
     "minkray-tools"},
    {"generate", "Make a scene of many shapes, the same for the same seed", "minkray-tools"},
    {"import", "Make a scene file of a robot's MJCF, URDF, SDF or glTF", "minkray"},
    {"info", "Tell what is in a scene, or what scenes may hold", "minkray"},
    {"league", "Ask solvers the hard cases and say who is right", "minkray-tools"},
    {"completion", "Print completions for a shell", "minkray-tools"},
    {"man", "Print a man page, for man -l -", "minkray-tools"},
};

/// Adds a subcommand to the parser. When the user calls it, it runs within Parser::parse, writes
/// results to stdout and all else to stderr, and may set the exit code (done by default) or throw
/// one of renderer/errors.h.
using AddVerb = void (*)(Parser& parser, ExitCode& exit_code);

struct VerbHere {
  std::string_view name;
  AddVerb add;
};

/// The verbs that this program has itself. It is defined once for `minkray`
/// (verbs_of_pictures.cpp), and once for the programs that know all verbs (verbs_of_tools.cpp).
std::span<const VerbHere> verbs_here();

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

}  // namespace minkray
