// SPDX-License-Identifier: MIT
// minkray distance-2d: the distance algorithm in the plane, drawn step by step.
#include <filesystem>
#include <iostream>
#include <memory>

#include "renderer/arguments/choices.h"
#include "renderer/claims/panels.h"
#include "renderer/cli/file_ending.h"
#include "renderer/cli/options.h"
#include "renderer/cli/verbs.h"
#include "renderer/io/output_file.h"
#include "renderer/json/object_reader.h"
#include "renderer/json/parse.h"
#include "renderer/member_json/shape_json.h"

namespace minkray {
namespace {

struct Distance2DVerbOptions {
  CommandFiles* files = nullptr;
  std::string file;
  std::string out;
  std::string subalgorithm = "projection";
};

void distance_2d(const Distance2DVerbOptions& options) {
  check_ending(options.out, ".svg", "--output");
  check_writable(options.out);
  Mistakes mistakes(options.file);
  MeshFiles meshes(std::filesystem::path(options.file).parent_path());
  std::optional<Shape> a, b;
  if (const auto text = read_text_file(options.file, mistakes))
    if (const auto json = parse_json(*text, mistakes)) {
      ObjectReader object(*json, JsonPath(), mistakes);
      object.allow({"description"});
      if (const Json* shape = object.require("a", "a shape"))
        a = read_shape(*shape, object.path("a"), mistakes, meshes);
      if (const Json* shape = object.require("b", "a shape"))
        b = read_shape(*shape, object.path("b"), mistakes, meshes);
      object.finish();
    }
  throw_if_any(mistakes);
  options.files->read(meshes.meshes());
  DistanceResult<double, 2> result;
  const std::string svg =
      distance_panels_svg(*a, *b, kind_named(named_subalgorithms, options.subalgorithm), result);
  write_file(options.out, svg);
  std::cout << name_of(result.status) << ", distance " << result.distance << " after "
            << result.iterations << " iterations\n";
}

}  // namespace

void add_distance_2d(Parser& parser, ExitCode&) {
  const Verb verb = parser.add_verb("distance-2d");
  const auto options = std::make_shared<Distance2DVerbOptions>();
  options->files = &verb.files();
  verb.add_option(
          "file", options->file,
          "JSON file with shapes \"a\" and \"b\"; solids are projected onto the plane z = 0")
      .required()
      .reads_file();
  verb.add_option("-o,--output", options->out, "SVG file to write").required().writes_file();
  verb.add_option("--subalgorithm", options->subalgorithm, "Distance subalgorithm of GJK")
      .one_of(names_in(named_subalgorithms))
      .show_default();
  verb.on_call([options] { distance_2d(*options); });
}

}  // namespace minkray
