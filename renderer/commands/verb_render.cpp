// SPDX-License-Identifier: MIT
// minkray render: a picture of a scene.
#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>

#include "core/parallel/parallel.h"
#include "renderer/base/errors.h"
#include "renderer/cli/options.h"
#include "renderer/cli/verbs.h"
#include "renderer/jobs/audit_report.h"
#include "renderer/jobs/render_frames.h"
#include "renderer/jobs/render_picture.h"
#include "renderer/jobs/render_request.h"
#include "renderer/jobs/timed.h"
#include "renderer/json/mistakes.h"
#include "renderer/share/merge.h"

namespace minkray {
namespace {

/// True if all outputs are files of this very share. Shares are numerous and rendered repeatedly on
/// machines that fail.
bool is_there(const RenderJob& job, const std::vector<std::string>& outputs) {
  return std::all_of(outputs.begin(), outputs.end(),
                     [&](const std::string& file) { return is_part_file_of(file, facts_of(job)); });
}

ExitCode run(RenderArguments& options) {
  Ranks ranks;
  options.choose_output(ranks);
  const CastOptions cast = cast_options(options.image.solver);
  RenderJob job = job_of(options, ranks);
  const FrameRange frames = frames_of(options, ranks);

  RenderStatistics statistics;
  const bool verbose = options.image.import.verbose;
  timed(verbose, "load", statistics.load_seconds, [&] { job.scene = options.image.load_scene(); });
  set_options(job, options);
  options.image.tell_output();
  timed(verbose, "build", statistics.build_seconds,
        [&] { job.world = make_world(job.scene, cast, options.build); });
  statistics.describe(job.scene, job.world);

  std::optional<RayAudit> audit;
  if (options.certify && job.world.instances().move())
    throw WrongUsage(
        "--certify: requires objects at rest (here objects move while the shutter is open)");
  if (options.certify) job.options.integrator.observer = &audit.emplace(job.scene, job.world);

  if (ranks.count() > 1) {
    render_picture_on(ranks, job, options, statistics);
    if (ranks.rank() != 0) return ExitCode::done;
  } else if (options.frames) {
    render_frames(job, options, frames, statistics);
  } else if (options.resume && options.is_share() && is_there(job, options.image.outputs)) {
    if (!options.image.quiet)
      std::cerr << printable(options.image.outputs.front()) << ": exists; not rendered again\n";
    return ExitCode::done;
  } else {
    render_picture(job, options, options.image.outputs, statistics);
  }
  report(statistics, options.stats);
  if (!audit) return ExitCode::done;
  report(*audit);
  return audit->failures().empty() ? ExitCode::done : ExitCode::comparison_failed;
}

}  // namespace

void add_render(Parser& parser, ExitCode& exit_code) {
  const Verb verb = parser.add_verb("render");
  const auto options = std::make_shared<RenderArguments>();
  options->add_to(verb);
  verb.on_call([options, &exit_code] {
    with_threads(options->image.threads, [&] { exit_code = run(*options); });
  });
}

}  // namespace minkray
