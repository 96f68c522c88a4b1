// SPDX-License-Identifier: MIT
#include "renderer/jobs/render_job.h"

#include <algorithm>
#include <ctime>
#include <iostream>

#include "core/files/text.h"
#include "core/parallel/parallel.h"
#include "renderer/base/interrupt.h"
#include "renderer/film/cryptomatte.h"
#include "renderer/film/data_channels.h"
#include "renderer/film/features.h"
#include "renderer/jobs/progress_line.h"
#include "renderer/json/mistakes.h"
#include "renderer/share/part_file.h"

namespace minkray {
namespace {

/// Ends the process if it was interrupted, when the checkpoint is on the disk.
void end_if_interrupted(const Rendering& rendering, Checkpoint& checkpoint) {
  if (!InterruptGuard::interrupted()) return;
  checkpoint.interrupted(rendering);
  if (const std::string complaint = checkpoint.complaint(); !complaint.empty())
    std::cerr << "warning: no checkpoint: " << printable(complaint) << "\n";
  InterruptGuard::end_if_interrupted();
}

bool is_among(std::string_view name, const std::vector<std::string_view>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

Facts facts_of(const RenderJob& job) {
  Facts facts = picture_facts(job.scene, job.world, job.options);
  if (!job.channels.empty()) facts[fact::aov] = listed(job.channels, {}, ",");
  facts[fact::tile] = job.options.tile.text();
  facts[fact::sample_share] = job.options.sample_share.text();
  if (job.denoise) facts[fact::denoised] = "yes";
  return facts;
}

Checkpoint checkpoint_of(const RenderJob& job, const std::string& output) {
  return {Checkpoint::path_for(output), job.options, facts_of(job), job.checkpoint_seconds};
}

RenderedJob run(const RenderJob& job, Checkpoint& checkpoint, const Spectator& spectator) {
  RenderJournal journal;
  if (!job.resume && job.checkpoint_seconds > 0) checkpoint.check_replaceable();
  if (job.resume && checkpoint.exists()) {
    journal = checkpoint.load();
  } else if (!job.quiet && job.resume) {
    std::cerr << "no checkpoint found: the render starts from the beginning\n";
  } else if (!job.quiet && checkpoint.exists()) {
    std::cerr << "the existing checkpoint is replaced (--resume would continue it)\n";
  }
  journal.finished = [&](const Rendering& rendering, std::size_t tile) {
    checkpoint.tile_finished(rendering, tile);
    if (spectator.tile_finished) spectator.tile_finished(rendering, tile);
  };
  journal.passed = spectator.passed;

  RenderedJob done;
  const Stopwatch watch;
  const std::clock_t begin = std::clock();
  {
    ProgressLine line(!job.quiet);
    done.rendering =
        render(job.scene, job.world, job.options,
               {[&](double fraction, std::uint64_t rays) { line.show(fraction, rays); },
                InterruptGuard::interrupted, [&](double noise) { line.set_noise(noise); }},
               std::move(journal));
  }
  end_if_interrupted(done.rendering, checkpoint);
  std::vector<ExrPlane> data;
  if (!job.channels.empty())
    data = measure_data_channels(job.scene, job.world, job.channels, job.options,
                                 {{}, InterruptGuard::interrupted});
  end_if_interrupted(done.rendering, checkpoint);
  Facts facts = facts_of(job);
  for (ExrPlane& plane : light_planes(done.rendering, job.channels))
    data.push_back(std::move(plane));
  if (is_among("cryptomatte", job.channels)) {
    Cryptomatte mattes =
        measure_cryptomatte(job.scene, job.world, job.options, {{}, InterruptGuard::interrupted});
    end_if_interrupted(done.rendering, checkpoint);
    for (ExrPlane& plane : mattes.planes) data.push_back(std::move(plane));
    facts.merge(mattes.texts);
  }
  if (job.denoise) {
    done.rendering.image = denoised(noisy_picture(job.scene, job.world, job.options, done.rendering,
                                                  {{}, InterruptGuard::interrupted}));
    end_if_interrupted(done.rendering, checkpoint);
  }
  done.seconds = watch.seconds();

  done.labels = labels_of(job.scene, job.options.resolution);
  facts[fact::command] = job.command;
  facts[counts_fact] = counts_text(done.rendering.counts);
  facts[seconds_fact] = std::to_string(done.seconds);
  facts[cpu_seconds_fact] =
      std::to_string(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  facts[threads_fact] = std::to_string(thread_count());
  if (!done.labels.empty()) facts[labels_fact] = labels_text(done.labels);
  if (job.wants_planes) done.exr = exr_of(done.rendering, job.options, std::move(facts));
  for (ExrPlane& plane : data) done.exr.planes.push_back(std::move(plane));
  if (const std::string complaint = checkpoint.complaint(); !complaint.empty())
    std::cerr << "warning: a checkpoint could not be written: " << printable(complaint) << "\n";
  return done;
}

}  // namespace minkray
