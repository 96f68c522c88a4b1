// SPDX-License-Identifier: MIT
#include <algorithm>
#include <iostream>

#include "renderer/arguments/compare_options.h"
#include "renderer/base/interrupt.h"
#include "renderer/compare/compare_scene.h"
#include "renderer/jobs/progress_line.h"
#include "renderer/scene/scene_instances.h"

namespace minkray {
namespace {

/// Default number of rays and directions per object, lower for scenes with many objects to limit
/// the time.
int rays_for(std::size_t objects) {
  constexpr std::size_t in_all = 20'000'000, most = 100'000, least = 2'000;
  return static_cast<int>(std::clamp(in_all / std::max<std::size_t>(objects, 1), least, most));
}
int directions_for(std::size_t objects) {
  return objects > 500 ? 100 : 500;
}

}  // namespace

void compare(const CompareArguments& options, ExitCode& exit_code) {
  CompareSceneOptions compare_options;
  compare_options.object.cast.solver = cast_options(options.image.solver).solver;
  check_outputs(options.image.outputs);
  const Scene scene = options.image.load_scene();
  Mistakes mistakes(options.image.scene);
  find_incomparable(scene, mistakes);
  throw_if_any(mistakes);
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

}  // namespace minkray
