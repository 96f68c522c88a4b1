// SPDX-License-Identifier: MIT
// minkray info: contents of a scene, and what scenes may contain.
#include <iomanip>
#include <iostream>
#include <memory>

#include "renderer/arguments/image_arguments.h"
#include "renderer/arguments/import_arguments.h"
#include "renderer/base/errors.h"
#include "renderer/cli/options.h"
#include "renderer/cli/verbs.h"
#include "renderer/import/import.h"
#include "renderer/import/meshes_of_scene.h"
#include "renderer/import/model_info.h"
#include "renderer/info/scene_info.h"

namespace minkray {
namespace {

struct InfoVerbOptions {
  std::string scene;
  ImportOptions import;
  bool shapes = false;
  bool schema = false;
  bool json = false;
  bool markdown = false;
};

void info(const InfoVerbOptions& options) {
  const int asked = !options.scene.empty() + options.shapes + options.schema;
  if (asked != 1) throw WrongUsage("info: give either a scene, --shapes or --schema");
  if (options.markdown && !options.shapes) throw WrongUsage("info: --markdown needs --shapes");
  if (options.schema) {
    std::cout << schema_text();
  } else if (options.shapes) {
    std::cout << (options.json       ? shapes_as_json()
                  : options.markdown ? shapes_as_markdown()
                                     : shapes_as_text());
  } else {
    const Imported imported = import_scene(options.scene, options.import);
    const Scene& scene = imported.scene;
    const bool is_robot = imported.model.has_value();
    std::vector<ModelMesh> meshes;
    if (!is_robot) meshes = meshes_of_scene(options.scene);
    for (const std::string& other : options.import.others)
      if (!is_foreign(other))
        for (ModelMesh& mesh : meshes_of_scene(other)) meshes.push_back(std::move(mesh));
    if (options.json) {
      const bool has_meshes = !is_robot || !meshes.empty();
      Json others = Json::array();
      for (const Model& model : imported.other_models) others.push_back(model_as_json(model));
      std::cout << info_as_json(scene, is_robot ? model_as_json(*imported.model) : nullptr,
                                has_meshes ? meshes_as_json(meshes) : nullptr, std::move(others));
    } else {
      if (is_robot) std::cout << model_as_text(*imported.model);
      for (const Model& model : imported.other_models) std::cout << model_as_text(model);
      std::cout << info_as_text(scene) << meshes_as_text(meshes);
    }
  }
}

}  // namespace

void add_info(Parser& parser, ExitCode&) {
  const Verb verb = parser.add_verb("info");
  const auto options = std::make_shared<InfoVerbOptions>();
  add_scene_option(verb, options->scene).required(false);
  add_other_files(verb, options->import);
  add_import_options(verb, options->import);
  verb.add_flag("--shapes", options->shapes, "List all kinds of shapes and their parameters");
  verb.add_flag("--schema", options->schema, "Print the JSON Schema of scene files");
  verb.add_flag("--json", options->json, "Print JSON");
  verb.add_flag("--markdown", options->markdown, "Print a Markdown table (with --shapes)");
  verb.on_call([options] { info(*options); });
}

}  // namespace minkray
