// SPDX-License-Identifier: MIT
// minkray compare: every object of a scene against Embree.
#include <memory>

#include "core/parallel/parallel.h"
#include "renderer/arguments/choices.h"
#include "renderer/arguments/compare_options.h"
#include "renderer/arguments/import_arguments.h"
#include "renderer/cli/options.h"
#include "renderer/cli/verbs.h"

namespace minkray {

void add_compare(Parser& parser, ExitCode& exit_code) {
  const Verb verb = parser.add_verb("compare");
  const auto options = std::make_shared<CompareArguments>();
  ImageArguments& image = options->image;
  image.seed = "1";
  image.files = &verb.files();
  add_scene_option(verb, image.scene);
  add_other_files(verb, image.import);
  add_import_options(verb, image.import);
  verb.add_option("--rays", options->rays,
                  "Rays per object; default: 100000, or fewer above 200 objects")
      .between(1, 1 << 30);
  verb.add_option(
          "--directions", options->directions,
          "Number of directions in which support points are computed; these points make the two "
          "meshes of each object\n"
          "Default: 500 (100 above 500 objects)")
      .between(20, 1 << 20);
  verb.add_option(
          "-o,--output", image.outputs,
          "Picture to write: the gap between the two meshes at each pixel, and marks at rays "
          "that contradict a mesh")
      .one_value_each()
      .writes_file();
  verb.add_option("-r,--resolution", image.resolution,
                  "Picture size in pixels (default: the scene's)")
      .takes("WxH");
  verb.add_option("-t,--threads", image.threads, "Threads; 0: one per core")
      .between(0, 1024)
      .show_default();
  verb.add_option("--seed", image.seed, "Random seed, 0 to 2^64 - 1").takes("N").show_default();
  add_solver_option(verb, image.solver);
  verb.add_flag("--json", options->json,
                "Print JSON, with histograms of the gaps between each shape and its meshes");
  verb.add_flag("-q,--quiet", image.quiet, "Print no progress");
  verb.on_call([options, &exit_code] {
    with_threads(options->image.threads, [&] { compare(*options, exit_code); });
  });
}

}  // namespace minkray
