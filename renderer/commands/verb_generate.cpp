// SPDX-License-Identifier: MIT
// minkray generate: benchmark scenes of any size.
#include <memory>

#include "core/support/named_kind.h"
#include "renderer/arguments/image_arguments.h"
#include "renderer/cli/file_ending.h"
#include "renderer/cli/options.h"
#include "renderer/cli/verbs.h"
#include "renderer/generate/generate.h"
#include "renderer/scene/scene_instances.h"

namespace minkray {
namespace {

struct GenerateVerbOptions {
  std::string kind;
  std::string out;
  std::size_t count = 1000;
  std::string seed = "0";
};

}  // namespace

void add_generate(Parser& parser, ExitCode&) {
  const Verb verb = parser.add_verb("generate");
  const auto options = std::make_shared<GenerateVerbOptions>();
  verb.add_option("kind", options->kind, "Kind of scene:" + lines_of_help(generated_kinds))
      .required()
      .one_of(names_in(generated_kinds));
  verb.add_option("-n,--count", options->count, "Number of shapes")
      .between(std::size_t{1}, most_instances)
      .show_default();
  verb.add_option(
          "-o,--output", options->out,
          "Scene file to write, .json\n"
          "If there are more than 1000 poses, they are all written to a .f32 file next to it (not "
          "for hulls and tumbling)")
      .required()
      .writes_file();
  verb.add_option("--seed", options->seed, "Random seed, 0 to 2^64 - 1").takes("N").show_default();
  verb.on_call([options] {
    check_ending(options->out, ".json", "--output");
    generate_scene({options->kind, options->count, parse_seed(options->seed)}, options->out);
  });
}

}  // namespace minkray
