// SPDX-License-Identifier: MIT
#include "renderer/jobs/growing_picture.h"

#include <iostream>

#include "renderer/arguments/preview.h"
#include "renderer/json/mistakes.h"
#include "renderer/share/part_file.h"

namespace minkray {

GrowingPicture::GrowingPicture(const RenderJob& job, const RenderArguments& arguments,
                               const std::vector<std::string>& outputs)
    : job_(job), arguments_(arguments), outputs_(outputs) {
  if (arguments.tev.empty()) return;
  const PixelRect region = job.options.region();
  tev_.emplace(arguments.tev, outputs.front(), region.width(), region.height());
}

Spectator GrowingPicture::spectator() {
  Spectator spectator;
  if (arguments_.progressive)
    spectator.passed = [this](const Rendering& rendering, int samples) {
      passed(rendering, samples);
    };
  if (tev_)
    spectator.tile_finished = [this](const Rendering& rendering, std::size_t tile) {
      tile_finished(rendering, tile);
    };
  return spectator;
}

/// The header has the number of samples; data channels are only written with the last ones.
void GrowingPicture::passed(const Rendering& rendering, int samples) {
  RenderOptions so_far = job_.options;
  so_far.samples = samples;
  FinishedPicture picture{rendering.image,
                          labels_of(job_.scene, so_far.resolution),
                          so_far.region(),
                          so_far.resolution,
                          {}};
  if (job_.wants_planes) {
    Facts facts = facts_of(job_);
    facts.erase(fact::aov);
    facts[fact::samples] = std::to_string(samples);
    facts[fact::command] = job_.command;
    facts[counts_fact] = counts_text(rendering.counts);
    picture.exr = exr_of(rendering, so_far, std::move(facts));
  }
  write_picture(outputs_, picture, arguments_.display());
  show_preview(to_look_at(picture, arguments_.display()), arguments_.image.preview,
               PreviewPlace::top_of_screen);
  if (tev_) tev_->show(rendering.image, {0, 0, picture.image.width, picture.image.height});
}

void GrowingPicture::tile_finished(const Rendering& rendering, std::size_t tile) {
  const PixelRect region = job_.options.region();
  const PixelRect part = TileGrid(region)[tile];
  tev_->show(rendering.image,
             {part.x0 - region.x0, part.y0 - region.y0, part.x1 - region.x0, part.y1 - region.y0});
}

void GrowingPicture::finish(const Image& image) {
  if (!tev_) return;
  tev_->show(image, {0, 0, image.width, image.height});
  if (!tev_->complaint().empty())
    std::cerr << "warning: --tev: " << printable(tev_->complaint()) << "\n";
}

}  // namespace minkray
