// SPDX-License-Identifier: MIT
// minkray compare: every object of a scene against Embree.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "core/parallel/parallel.h"
#include "renderer/base/interrupt.h"
#include "renderer/cli/image_arguments.h"
#include "renderer/cli/progress_line.h"
#include "renderer/cli/verbs.h"
#include "renderer/compare/compare_scene.h"
#include "renderer/scene/scene_instances.h"
#include "renderer/scene/scene_json.h"

namespace minkray {
namespace {

struct Options {
  ImageArguments image;
  int rays = 0;
  int directions = 0;
  bool json = false;
};

/// Unless told otherwise: as many rays and directions an object as a scene's objects leave time
/// for.
int rays_for(std::size_t objects) {
  constexpr std::size_t in_all = 20'000'000, most = 100'000, least = 2'000;
  return static_cast<int>(std::clamp(in_all / std::max<std::size_t>(objects, 1), least, most));
}
int directions_for(std::size_t objects) {
  return objects > 500 ? 100 : 500;
}

void compare(const Options& options, ExitCode& exit_code) {
  CompareSceneOptions compare_options;
  compare_options.object.cast.solver = cast_options(options.image.solver).solver;
  check_outputs(options.image.outputs);
  const Scene scene = load_scene(options.image.scene);
  if (!options.image.outputs.empty())
    compare_options.picture = options.image.render_options(scene).resolution;
  const std::size_t objects = instance_count(scene);
  compare_options.object.rays = options.rays > 0 ? options.rays : rays_for(objects);
  compare_options.object.sandwich.directions =
      options.directions > 0 ? options.directions : directions_for(objects);
  compare_options.object.seed = parse_seed(options.image.seed);

  SceneComparison comparison;
  {
    const InterruptGuard guard;
    {
      ProgressLine line(!options.image.quiet);
      comparison = compare_scene(scene, compare_options, [&](double fraction, std::uint64_t rays) {
        line.show(fraction, rays);
        return !InterruptGuard::interrupted();
      });
    }
    InterruptGuard::end_if_interrupted();
    if (!options.image.outputs.empty())
      write_images(options.image.outputs, difference_image(comparison.difference),
                   difference_numbers(comparison.difference));
  }
  if (options.json)
    std::cout << comparison_json(comparison).dump(2) << '\n';
  else
    std::cout << comparison_table(comparison);
  if (comparison.violations() > 0 || comparison.pixel_violations() > 0)
    exit_code = ExitCode::comparison_failed;
}

}  // namespace

void add_compare(CLI::App& app, ExitCode& exit_code) {
  CLI::App* verb = app.add_subcommand(
      "compare", "Check every object of a scene against triangle meshes in Embree");
  const auto options = std::make_shared<Options>();
  ImageArguments& image = options->image;
  image.seed = "1";
  verb->add_option("scene", image.scene, "A scene file (JSON)")->required();
  verb->add_option("--rays", options->rays,
                   "Rays an object; by default 100000, less in scenes of over 200 objects")
      ->check(CLI::Range(1, 1 << 30));
  verb->add_option("--directions", options->directions,
                   "Directions that the meshes begin with; by default 500, 100 in scenes of over "
                   "500 objects")
      ->check(CLI::Range(20, 1 << 20));
  verb->add_option("-o,--output", image.outputs,
                   "A picture of how far apart the meshes are, violations marked")
      ->allow_extra_args(false);
  verb->add_option("-r,--resolution", image.resolution, "WxH in pixels, instead of the scene's");
  verb->add_option("-t,--threads", image.threads, "How many threads; 0 for one a core")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  verb->add_option("--seed", image.seed, "Of the random rays")->capture_default_str();
  verb->add_option("--solver", image.solver, "Of the ray casts")->capture_default_str();
  verb->add_flag("--json", options->json, "Print JSON, with histograms of the gaps");
  verb->add_flag("-q,--quiet", image.quiet, "No progress");
  verb->callback([options, &exit_code] {
    with_threads(options->image.threads, [&] { compare(*options, exit_code); });
  });
}

}  // namespace minkray
