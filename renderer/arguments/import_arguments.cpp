// SPDX-License-Identifier: MIT
#include "renderer/arguments/import_arguments.h"

#include "renderer/cli/options.h"
#include "renderer/import/import.h"
#include "renderer/scene_json/read_split.h"

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
            options.geometry = kind_named(geometry_choices, name);
          },
          std::string("Robot shapes to use (default ") +
              std::string(name_in(geometry_choices, options.geometry)) +
              "):" + lines_of_help(geometry_choices))
      .one_of(names_in(geometry_choices))
      .group(group);
  verb.add_option(
          "--split",
          [&options](const std::string& name) { options.split = kind_named(mesh_splits, name); },
          "How to split a mesh into convex hulls:" + lines_of_help(mesh_splits))
      .one_of(names_in(mesh_splits))
      .group(group);
  verb.add_option(
          "--meshes",
          [&options](const std::string& name) { options.meshes = kind_named(mesh_choices, name); },
          "How to represent robot meshes:" + lines_of_help(mesh_choices) +
              "\nDefault: hull if --split is given, or if the command is distance, clearance or "
              "verify and the robot is an MJCF file; otherwise exact")
      .one_of(names_in(mesh_choices))
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
