// SPDX-License-Identifier: MIT
#include "renderer/cli/import_arguments.h"

#include "renderer/cli/options.h"
#include "renderer/import/import.h"

namespace minkray {

std::string scene_argument() {
  return "A scene file (JSON), the name of a scene that comes with Minkray, or a robot's file: " +
         foreign_formats();
}

void add_import_options(const Verb& verb, ImportOptions& options, bool rows) {
  constexpr const char* group = "Robots";
  verb.add_option(
          "--geometry",
          [&options](const std::string& name) {
            options.geometry = name == "collision" ? GeometryChoice::collision
                               : name == "all"     ? GeometryChoice::all
                                                   : GeometryChoice::visual;
          },
          std::string("visual: what is seen, and what collides where nothing is") +
              (options.geometry == GeometryChoice::visual ? " (default); collision; all"
                                                          : "; collision (default); all"))
      .one_of({"visual", "collision", "all"})
      .group(group);
  verb.add_option(
          "--split",
          [&options](const std::string& name) {
            options.split = name == "groups"       ? MeshSplit::groups
                            : name == "components" ? MeshSplit::components
                                                   : MeshSplit::none;
          },
          "A hull for each part of a mesh: groups (as its file names them) or components (as they "
          "hang together); none: one hull (default)")
      .one_of({"none", "groups", "components"})
      .group(group);
  verb.add_option("--keyframe", options.keyframe, "MJCF: the name of a keyframe, or its number")
      .group(group);
  verb.add_option("--joint", options.joints,
                  "NAME=VALUE, may be given again; angles in radians, several numbers between "
                  "commas")
      .one_value_each()
      .group(group);
  if (rows)
    verb.add_option(
            "--joints", options.joint_rows,
            "A CSV file: joints' names in its first line, values in the others; or JSON: a "
            "list of {\"time\": 0, \"elbow\": 1.2}; several rows move the robot (for --frames), "
            "by \"time\" or 24 a second")
        .group(group);
  verb.add_option("--package-dir,--model-dir", options.package_dirs,
                  "Where package:// and model:// are looked for; may be given again")
      .one_value_each()
      .group(group);
  verb.add_flag("--skip-missing-meshes", options.skip_missing_meshes,
                "Leave out meshes that are not there; info tells how many")
      .group(group);
}

}  // namespace minkray
