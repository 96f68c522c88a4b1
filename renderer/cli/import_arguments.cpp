// SPDX-License-Identifier: MIT
#include "renderer/cli/import_arguments.h"

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
                  "More files, in the same scene: camera and lights are those of the first scene "
                  "file, joints' values are the first file's")
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
          std::string("Which shapes are taken (default ") +
              (options.geometry == GeometryChoice::visual ? "visual" : "collision") +
              "):\nvisual: what is seen; what collides if nothing is seen\n"
              "collision: what collides\nall: both")
      .one_of({"visual", "collision", "all"})
      .group(group);
  verb.add_option(
          "--split",
          [&options](const std::string& name) {
            options.split = name == "groups"       ? MeshSplit::groups
                            : name == "components" ? MeshSplit::components
                                                   : MeshSplit::none;
          },
          "Whether a mesh becomes several hulls:\nnone: it is one body (default)\n"
          "groups: one for each part that its file names\n"
          "components: one for each part that hangs together")
      .one_of({"none", "groups", "components"})
      .group(group);
  verb.add_option(
          "--meshes",
          [&options](const std::string& name) {
            options.meshes = name == "exact" ? MeshChoice::exact : MeshChoice::hull;
          },
          "What mesh files of robots are (default exact; in MJCF exact for rays, and hull for "
          "contact, as in MuJoCo; hull with --split):\nexact: their triangles\n"
          "hull: their convex hulls")
      .one_of({"hull", "exact"})
      .group(group);
  verb.add_option("--keyframe", options.keyframe, "MJCF: the name of a keyframe, or its number")
      .takes("NAME")
      .group(group);
  verb.add_option("--joint", options.joints,
                  "A joint's value; may be given again. Angles in radians, several numbers between "
                  "commas")
      .takes("NAME=VALUE")
      .one_value_each()
      .group(group);
  if (rows)
    verb.add_option(
            "--joints", options.joint_rows,
            "A CSV file: joints' names in its first line, values in the others; or JSON: a "
            "list of {\"time\": 0, \"elbow\": 1.2}; several rows move the robot (for --frames), "
            "by \"time\" or 24 a second")
        .reads_file()
        .group(group);
  verb.add_option("--package-dir,--model-dir", options.package_dirs,
                  "Where package:// and model:// are looked for; may be given again")
      .takes_folder()
      .one_value_each()
      .group(group);
  verb.add_flag("--lenient", options.lenient,
                "Leave out shapes and materials that are wrong; info lists them")
      .group(group);
  verb.add_flag("--skip-missing-meshes", options.skip_missing_meshes,
                "Leave out meshes that are not there; info tells how many")
      .group(group);
  return verb.add_flag("-v,--verbose", options.verbose,
                       "Tell what is done and how long it takes; list each missing mesh");
}

}  // namespace minkray
