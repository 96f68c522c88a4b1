// SPDX-License-Identifier: MIT
// minkray heatmap: picture of each pixel's cost.
#include <iostream>
#include <memory>
#include <optional>

#include "core/parallel/parallel.h"
#include "core/support/named_kind.h"
#include "renderer/arguments/choices.h"
#include "renderer/arguments/image_arguments.h"
#include "renderer/base/errors.h"
#include "renderer/base/interrupt.h"
#include "renderer/cli/options.h"
#include "renderer/cli/verbs.h"
#include "renderer/film/heatmap.h"
#include "renderer/jobs/progress_line.h"

namespace minkray {
namespace {

struct HeatmapVerbOptions {
  ImageArguments image;
  std::optional<std::string> channel;
  std::optional<std::string> side_by_side;  ///< comma-separated solvers; none: only image.solver
};

const HeatChannelDescription& channel_of(const std::string& name) {
  if (const HeatChannelDescription* known = row_named(heat_channels, name)) return *known;
  throw WrongUsage("--channel: must be one of " + listed(names_in(heat_channels)) + " (got " +
                   name + ")");
}

constexpr const char* heatmap_suffix = "-heatmap.png";

void run(HeatmapVerbOptions& options) {
  options.image.choose_output(heatmap_suffix);
  if (options.channel) channel_of(*options.channel);
  const std::vector<std::string> solvers =
      pieces_of(options.side_by_side.value_or(options.image.solver), ',');
  const char* const solver_option = options.side_by_side ? "--side-by-side" : "--solver";
  for (const std::string& solver : solvers) cast_options(solver, solver_option);
  check_outputs(options.image.outputs);
  const Scene scene = options.image.load_scene();
  const HeatChannelDescription& shown =
      options.channel ? channel_of(*options.channel) : description_of(default_channel(scene));
  const HeatChannel channel = shown.kind;
  const RenderOptions render_options = options.image.render_options(scene, solvers.size());
  options.image.tell_output();

  std::vector<HeatField> fields;
  std::vector<HeatPanel> panels;
  std::uint64_t exhausted = 0, casts = 0;
  {
    const InterruptGuard guard;
    fields.reserve(solvers.size());
    for (const std::string& solver : solvers) {
      const World world = make_world(scene, cast_options(solver));
      ProgressLine line(!options.image.quiet);
      fields.push_back(
          measure_heat(scene, world, channel, render_options,
                       {[&](double fraction, std::uint64_t rays) { line.show(fraction, rays); },
                        InterruptGuard::interrupted}));
      InterruptGuard::end_if_interrupted();
      exhausted += fields.back().work.exhausted;
      casts += fields.back().work.casts;
      panels.push_back({solvers.size() > 1 ? "solver " + solver : "", &fields.back()});
    }
    const Image picture = heat_picture(panels, channel);
    write_images(options.image.outputs, picture, heat_numbers(panels));
    show_preview(picture, options.image.preview);
  }

  if (!options.image.quiet)
    for (std::size_t i = 0; i < solvers.size(); ++i)
      std::cout << shown.name << " (solver " << solvers[i] << ")\n"
                << heat_report(fields[i], channel);
  warn_of_exhausted(exhausted, casts);
}

}  // namespace

void add_heatmap(Parser& parser, ExitCode&) {
  const Verb verb = parser.add_verb("heatmap");
  const auto options = std::make_shared<HeatmapVerbOptions>();
  options->image.add_to(verb, heatmap_suffix);
  verb.add_option("--channel", options->channel,
                  "What to show (default: iterations, or nodes in scenes of meshes):" +
                      lines_of_help(heat_channels))
      .takes("NAME");
  const Option solver = add_solver_option(verb, options->image.solver);
  verb.add_option("--side-by-side", options->side_by_side,
                  "Solvers to show side by side with one colour scale, such as paper,auto")
      .takes("NAMES")
      .excludes(solver);
  verb.on_call([options] { with_threads(options->image.threads, [&] { run(*options); }); });
}

}  // namespace minkray
