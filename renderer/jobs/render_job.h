// SPDX-License-Identifier: MIT
// Renders a picture or a share of one without losing work: writes checkpoints, resumes an earlier
// run, and returns the OpenEXR image to write.
#pragma once

#include <string_view>

#include "renderer/film/labels.h"
#include "renderer/io/exr.h"
#include "renderer/share/checkpoint.h"

namespace minkray {

/// Properties shared by all shares of a picture.
struct RenderJob {
  Scene scene;
  World world;
  RenderOptions options;
  std::vector<std::string_view> channels;  ///< names of data channels
  std::string command;
  double checkpoint_seconds = 60;
  bool resume = false;
  bool denoise = false;
  bool wants_planes = true;  ///< true if any output has planes, which double the memory
  bool quiet = false;
};

/// Callbacks for the progress of a picture; each may be empty.
struct Spectator {
  std::function<void(const Rendering&, int samples)> passed;  ///< as in RenderJournal
  std::function<void(const Rendering&, std::size_t tile)> tile_finished;
};

struct RenderedJob {
  Rendering rendering;
  ExrImage exr;  ///< without planes if they are not wanted; with facts: of the picture, of the
                 ///< share, and its cost
  std::vector<Label> labels;
  double seconds = 0;
};

/// Facts of the job's picture, and of the share to render.
Facts facts_of(const RenderJob& job);

/// Checkpoint next to the first of a job's outputs.
Checkpoint checkpoint_of(const RenderJob& job, const std::string& output);

/// Renders. Resumes from the checkpoint if the job requests it and there is one. If interrupted,
/// stores the work in the checkpoint and ends the process. Remove the checkpoint when all outputs
/// are written.
RenderedJob run(const RenderJob& job, Checkpoint& checkpoint, const Spectator& spectator = {});

}  // namespace minkray
