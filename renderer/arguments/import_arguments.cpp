// SPDX-License-Identifier: MIT
#include "renderer/arguments/import_arguments.h"

#include "renderer/cli/options.h"
#include "renderer/import/import.h"

namespace minkray {

std::string scene_argument() {
  return "A scene file (JSON), the name of a built-in scene (such as showcase), or a robot file: " +
         foreign_formats();
}

void add_other_files(const Verb& verb, ImportOptions& options) {
  // Accepts no names of built-in scenes: the search for them would come before the error about an
  // unknown option.
  verb.add_option("others", options.others,
                  "More scene or robot files, whose objects are added to the scene\n"
                  "Camera and lights come from the first file that is not a robot file\n"
                  "--joint, --joints and --keyframe apply to the first file only")
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
          std::string("Robot shapes to use (default ") +
              (options.geometry == GeometryChoice::visual ? "visual" : "collision") +
              "):\nvisual: visual shapes, or collision shapes if there are none\n"
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
          "How to split a mesh into convex hulls:\nnone: no split (default)\n"
          "groups: one hull per named part of the file\n"
          "components: one hull per connected part")
      .one_of({"none", "groups", "components"})
      .group(group);
  verb.add_option(
          "--meshes",
          [&options](const std::string& name) {
            options.meshes = name == "exact" ? MeshChoice::exact : MeshChoice::hull;
          },
          "How to represent robot meshes:\n"
          "exact: triangles\n"
          "hull: convex hulls\n"
          "Default: hull if --split is given, or if the command is distance, clearance or verify "
          "and the robot is an MJCF file; otherwise exact")
      .one_of({"hull", "exact"})
      .group(group);
  verb.add_option("--keyframe", options.keyframe, "Keyframe to use, by name or number (MJCF)")
      .takes("NAME")
      .group(group);
  verb.add_option("--joint", options.joints,
                  "Joint value (rad, or scene units for sliding joints); repeatable\n"
                  "Ball, free and planar joints take several values, comma-separated")
      .takes("NAME=VALUE")
      .one_value_each()
      .group(group);
  if (rows)
    verb.add_option(
            "--joints", options.joint_rows,
            "File of joint values: CSV (a row of names, then rows of values) or JSON\n"
            "Several rows animate the robot: one row every 1/24 s, or at the times (s) in a "
            "column or member \"time\"\n"
            "Where a command needs a single moment, it uses time 0")
        .reads_file()
        .group(group);
  verb.add_option("--package-dir,--model-dir", options.package_dirs,
                  "Folder to search for package:// and model:// files; repeatable")
      .takes_folder()
      .one_value_each()
      .group(group);
  verb.add_flag("--lenient", options.lenient,
                "Skip invalid shapes and materials (minkray info lists the skipped ones)")
      .group(group);
  verb.add_flag("--skip-missing-meshes", options.skip_missing_meshes,
                "Skip missing mesh files (minkray info reports the number)")
      .group(group);
  return verb.add_flag("-v,--verbose", options.verbose,
                       "If meshes are missing, name all of them, not only their number\n"
                       "render: also report how long loading, building, tracing and writing take\n"
                       "verify: also print all notes on the input files");
}

}  // namespace minkray
