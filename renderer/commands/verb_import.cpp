// SPDX-License-Identifier: MIT
// minkray import: converts a robot's file to a scene file.
#include <iostream>
#include <memory>

#include "renderer/arguments/image_arguments.h"
#include "renderer/arguments/import_arguments.h"
#include "renderer/cli/file_ending.h"
#include "renderer/cli/options.h"
#include "renderer/cli/verbs.h"
#include "renderer/import/import.h"
#include "renderer/import/model_info.h"
#include "renderer/io/output_file.h"
#include "renderer/scene_json/write_scene.h"

namespace minkray {
namespace {

struct ImportVerbOptions {
  CommandFiles* files = nullptr;
  std::string file, output;
  std::string resolution;  ///< empty: the options' resolution
  ImportOptions import;
  bool quiet = false;
};

void import(const ImportVerbOptions& options) {
  check_ending(options.output, ".json", "--output");
  check_writable(options.output);
  ImportOptions import = options.import;
  if (!options.resolution.empty()) import.picture = parse_resolution(options.resolution);
  const Imported imported = import_scene(options.file, import);
  options.files->read(imported.files);
  const std::string text = scene_text(imported.scene);
  write_file(options.output, text);
  if (options.quiet) return;
  if (imported.model) std::cerr << model_as_text(*imported.model);
  for (const Model& model : imported.other_models) std::cerr << model_as_text(model);
}

}  // namespace

void add_import(Parser& parser, ExitCode&) {
  const Verb verb = parser.add_verb("import");
  const auto options = std::make_shared<ImportVerbOptions>();
  options->files = &verb.files();
  verb.add_option("file", options->file, "Robot file: " + foreign_formats())
      .required()
      .reads_file();
  add_other_files(verb, options->import);
  verb.add_option("-o,--output", options->output, "Scene file to write, .json")
      .required()
      .writes_file();
  add_import_options(verb, options->import);
  verb.add_option("-r,--resolution", options->resolution,
                  "Picture size for which the camera is placed (default 960x720)")
      .takes("WxH");
  verb.add_flag("-q,--quiet", options->quiet, "Print no report");
  verb.on_call([options] { import(*options); });
}

}  // namespace minkray
