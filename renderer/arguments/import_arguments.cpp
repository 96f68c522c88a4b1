// SPDX-License-Identifier: MIT
#include "renderer/arguments/import_arguments.h"

#include "renderer/cli/options.h"
#include "renderer/import/import.h"

namespace minkray {

std::string scene_argument() {
  return "A scene file (JSON), the name of a scene that comes with Minkray, or a robot's file: " +
         foreign_formats();
}

void add_other_files(const Verb& verb, ImportOptions& options) {
  // No names of built-in scenes here: they would be searched for before unknown options are
  // reported.
  verb.add_option("others", options.others,
                  "More files for the same scene\n"
                  "Camera and lights come from the first scene file; robot files do not count\n"
                  "--joint, --joints and --keyframe apply to SCENE only")
      .reads_file();
}

Option add_import_options(const Verb& verb, ImportOptions& options, bool rows) {
  constexpr const char* group = "Robots";
  verb.add_option(
          "--geometry",
          [&options](const std::string& name) {
            options.geometry = name == "collision" ? GeometryChoice::collision
                               : name == "all"     ? GeometryChoice::all
                                                   : GeometryChoice::visual;
          },
          std::string("Shapes of robots to use (default ") +
              (options.geometry == GeometryChoice::visual ? "visual" : "collision") +
              "):\nvisual: visual shapes; collision shapes if there are none\n"
              "collision: collision shapes\nall: both")
      .one_of({"visual", "collision", "all"})
      .group(group);
  verb.add_option(
          "--split",
          [&options](const std::string& name) {
            options.split = name == "groups"       ? MeshSplit::groups
                            : name == "components" ? MeshSplit::components
                                                   : MeshSplit::none;
          },
          "Split of a mesh into convex hulls:\nnone: not split (default)\n"
          "groups: one per named part of the file\ncomponents: one per connected part")
      .one_of({"none", "groups", "components"})
      .group(group);
  verb.add_option(
          "--meshes",
          [&options](const std::string& name) {
            options.meshes = name == "exact" ? MeshChoice::exact : MeshChoice::hull;
          },
          "Robot meshes (default: hull if --split is given; otherwise exact, but hull for "
          "contacts of MJCF robots):\n"
          "exact: triangles\nhull: convex hulls")
      .one_of({"hull", "exact"})
      .group(group);
  verb.add_option("--keyframe", options.keyframe, "Keyframe by name or number (MJCF)")
      .takes("NAME")
      .group(group);
  verb.add_option("--joint", options.joints,
                  "Joint value (rad or length; several, comma-separated, for ball and free "
                  "joints); repeatable")
      .takes("NAME=VALUE")
      .one_value_each()
      .group(group);
  if (rows)
    verb.add_option("--joints", options.joint_rows,
                    "Joint values: CSV (names, then values) or JSON rows; optional \"time\" (s)\n"
                    "Several rows animate the robot; without times: 24 rows per second")
        .reads_file()
        .group(group);
  verb.add_option("--package-dir,--model-dir", options.package_dirs,
                  "Folder to search for package:// and model:// files; repeatable")
      .takes_folder()
      .one_value_each()
      .group(group);
  verb.add_flag("--lenient", options.lenient,
                "Skip invalid shapes, materials; minkray info lists them")
      .group(group);
  verb.add_flag("--skip-missing-meshes", options.skip_missing_meshes,
                "Skip missing mesh files; info reports how many")
      .group(group);
  return verb.add_flag("-v,--verbose", options.verbose,
                       "Report steps and their times; list all missing meshes");
}

}  // namespace minkray
