// SPDX-License-Identifier: MIT
// The list of all commands, with the program that contains each. Each command has its own
// verb_*.cpp. The program `minkray` contains few commands, so that it compiles fast
// (docs/decisions/build.md); for the others it runs another program from the same folder.
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
  std::string_view examples[2];
  std::string_view exit_codes = {};  ///< line of help, for commands with exit codes of their own
};

/// Rows in the order of --help.
inline constexpr VerbRow verbs[] = {
    {"render",
     "Make a picture of a scene",
     "minkray",
     {"minkray render showcase", "minkray render robot.urdf -o robot.png -r 1280x720 -s 64"}},
    {"merge",
     "Merge part files (from render --tile or --sample-share) into a picture",
     "minkray",
     {"minkray merge part1.exr part2.exr -o picture.png",
      "minkray merge parts/*.exr -o picture.exr --allow-partial"}},
    {"heatmap",
     "Draw the cost of each pixel of a scene, such as solver iterations",
     "minkray",
     {"minkray heatmap showcase",
      "minkray heatmap showcase --side-by-side paper,auto -o cost.png"}},
    {"inspect",
     "Make an HTML page that replays each pixel's ray cast step by step",
     "minkray-inspect",
     {"minkray inspect shape-zoo -o zoo.html", "minkray inspect shape-zoo --serve"}},
    {"compare",
     "Check each object against a mesh inside it and a mesh around it (Embree)",
     "minkray-compare",
     {"minkray compare shape-zoo", "minkray compare scene.json --rays 10000 -o gaps.png"}},
    {"cast",
     "Run ray casts, shape casts and distance queries, one JSON object per line",
     "minkray-tools",
     {"minkray cast queries.jsonl", "minkray cast - --certify < queries.jsonl"}},
    {"scan",
     "Simulate a lidar or a depth camera in a scene",
     "minkray-tools",
     {"minkray scan scene.json --pattern spinning:16x360 -o sweep.ply",
      "minkray scan robot.urdf --pinhole camera.json --on head -o depth.png"}},
    {"distance",
     "Signed distance between two shapes, or between bodies of a robot or scene",
     "minkray-tools",
     {"minkray distance a.json b.json",
      "minkray distance robot.urdf world.sdf --joint elbow=1.2 --within 0.1"}},
    {"clearance",
     "Prove the minimum clearance of a robot along a joint path, or at one pose",
     "minkray-tools",
     {"minkray clearance robot.urdf --path path.csv --obstacle cell.json",
      "minkray clearance robot.urdf --path path.csv --srdf robot.srdf --at-least 0.05"}},
    {"verify",
     "Prove that a planned motion is collision-free, also between waypoints",
     "minkray-tools",
     {"minkray verify --robot arm.urdf --scene scene.yaml --trajectory plan.yaml",
      "minkray verify --robot arm.urdf --trajectory plan.csv -o proof.json"},
     "Exit codes: 0 free, 1 collides, 6 undecided; others as in minkray --help"},
    {"field",
     "Draw the signed distance to the nearest object at each point of a plane",
     "minkray-tools",
     {"minkray field scene.json -o distance.png",
      "minkray field scene.json --normal 0,1,0 --through 0,0,1"}},
    {"trace",
     "Show every iteration of the ray cast for one pixel",
     "minkray-tools",
     {"minkray trace shape-zoo --pixel 100,80",
      "minkray trace shape-zoo --pixel 100,80 --solver paper --svg cast.svg"}},
    {"paper",
     "Rerun the experiments of the papers that Minkray implements",
     "minkray-tools",
     {"minkray paper", "minkray paper --only a --rays 10000"}},
    {"distance-2d",
     "Draw the GJK distance algorithm in 2D, one panel per iteration",
     "minkray-tools",
     {"minkray distance-2d shapes.json -o steps.svg",
      "minkray distance-2d shapes.json -o steps.svg --subalgorithm projection"}},
    {"generate",
     "Generate a scene of many shapes from a seed",
     "minkray-tools",
     {"minkray generate spheres -n 1000 -o spheres.json",
      "minkray generate spheres -n 100000 --seed 7 -o many.json"}},
    {"import",
     "Convert MJCF, URDF, SDF or glTF to a scene file",
     "minkray",
     {"minkray import robot.urdf -o robot.json",
      "minkray import model.xml --keyframe home -o model.json"}},
    {"info",
     "Describe a scene, list the kinds of shapes, or print the scene schema",
     "minkray",
     {"minkray info robot.urdf", "minkray info --shapes"}},
    {"league",
     "Compare Minkray with other solvers on hard cases",
     "minkray-tools",
     {"minkray league", "minkray league --only cylinder -o report.html"}},
    {"completion",
     "Print a completion script for a shell",
     "minkray-tools",
     {"minkray completion bash", "minkray completion zsh"}},
    {"man",
     "Print a man page (to read it: minkray man NAME | man -l -)",
     "minkray-tools",
     {"minkray man render", "minkray man"}},
};

/// Adds a command to the parser; Parser::parse then runs it. The command writes results to stdout
/// and everything else to stderr. The command may set the exit code (default: done) or throw an
/// exception from renderer/base/errors.h.
using AddVerb = void (*)(Parser& parser, ExitCode& exit_code);

struct VerbHere {
  std::string_view name;
  AddVerb add;
};

/// Commands contained in this program. Defined in verbs_of_pictures.cpp for the program `minkray`,
/// and in verbs_of_tools.cpp for programs that contain all commands.
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
void add_verify(Parser& parser, ExitCode& exit_code);

}  // namespace minkray
