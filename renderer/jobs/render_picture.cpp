// SPDX-License-Identifier: MIT
#include "renderer/jobs/render_picture.h"

#include "renderer/base/errors.h"
#include "renderer/base/interrupt.h"
#include "renderer/jobs/growing_picture.h"
#include "renderer/jobs/shared_render.h"
#include "renderer/jobs/timed.h"
#include "renderer/jobs/write_picture.h"

namespace minkray {

Image render_picture(const RenderJob& job, const RenderArguments& options,
                     const std::vector<std::string>& outputs, RenderStatistics& statistics) {
  const InterruptGuard guard;
  Checkpoint checkpoint = checkpoint_of(job, outputs.front());
  RenderedJob done;
  GrowingPicture growing(job, options, outputs);
  timed(options.image.import.verbose, "trace", statistics.trace_seconds,
        [&] { done = run(job, checkpoint, growing.spectator()); });
  statistics.counts += done.rendering.counts;
  statistics.noise = done.rendering.noise;
  const FinishedPicture picture{std::move(done.rendering.image), std::move(done.labels),
                                job.options.region(), job.options.resolution, std::move(done.exr)};
  timed(options.image.import.verbose, "write", statistics.write_seconds,
        [&] { write_picture(outputs, picture, options.display()); });
  checkpoint.remove();
  growing.finish(picture.image);
  show_preview(to_look_at(picture, options.display()), options.image.preview);
  return picture.image;
}

void render_picture_on(Ranks& ranks, const RenderJob& job, const RenderArguments& options,
                       RenderStatistics& statistics) {
  const std::string& output = options.image.outputs.front();
  const int tiles = options.tiles.value_or(default_tile_count(job.options.picture()));
  if (!can_be_tiled(job.options.picture(), tiles))
    throw WrongUsage("--tiles: the picture has too few pixels for " + std::to_string(tiles));
  const InterruptGuard guard;
  const Stopwatch watch;
  std::optional<Merged> merged = render_on(ranks, job, tiles, output);
  statistics.trace_seconds = watch.seconds();
  if (!merged) return;
  statistics.counts = merged->counts;
  merged->exr.texts[fact::command] = job.command;
  const Stopwatch write_watch;
  write_picture(options.image.outputs,
                {merged->image(), labels_of(merged->exr.texts), merged->exr.window,
                 job.options.resolution, merged->exr},
                options.display());
  statistics.write_seconds = write_watch.seconds();
  remove_parts(output, tiles);
}

}  // namespace minkray
