// SPDX-License-Identifier: MIT
// Rendering a picture or a share of one such that nothing is lost: with checkpoints, going on where
// an earlier run ended, and in the OpenEXR form that is written.
#pragma once

#include <string_view>

#include "renderer/film/labels.h"
#include "renderer/io/exr.h"
#include "renderer/share/checkpoint.h"

namespace minkray {

/// What is the same for all shares of a picture.
struct RenderJob {
  Scene scene;
  World world;
  RenderOptions options;
  std::vector<std::string_view> channels;  ///< names of data channels
  std::string command;
  double checkpoint_seconds = 60;
  bool resume = false;
  bool denoise = false;
  bool wants_planes = true;  ///< whether any output has them; they take as much memory again
  bool quiet = false;
};

/// Who hears how a picture grows; each function may be missing.
struct Spectator {
  std::function<void(const Rendering&, int samples)> passed;  ///< as RenderJournal has them
  std::function<void(const Rendering&, std::size_t tile)> tile_finished;
};

struct RenderedJob {
  Rendering rendering;
  ExrImage exr;  ///< without planes if they are not wanted; with facts: the picture's, the share's,
                 ///< what it cost
  std::vector<Label> labels;
  double seconds = 0;
};

/// The facts of the job's picture and of which share of it it is.
Facts facts_of(const RenderJob& job);

/// The checkpoint beside the first of a job's outputs.
Checkpoint checkpoint_of(const RenderJob& job, const std::string& output);

/// Renders; goes on from the checkpoint if the job says so and there is one. Ends the process if it
/// is interrupted, with what is done in the checkpoint. Remove the checkpoint when all is written.
RenderedJob run(const RenderJob& job, Checkpoint& checkpoint, const Spectator& spectator = {});

}  // namespace minkray
