// SPDX-License-Identifier: MIT
// What is to be seen of a picture while it is rendered: pass by pass in its files and in the
// terminal, tile by tile in tev.
#pragma once

#include <optional>

#include "renderer/cli/render_arguments.h"
#include "renderer/cli/render_job.h"
#include "renderer/io/tev.h"

namespace minkray {

/// Refers to the job, the arguments and the outputs.
class GrowingPicture {
 public:
  /// Throws CannotWrite if --tev names a viewer that is not there.
  GrowingPicture(const RenderJob& job, const RenderArguments& arguments,
                 const std::vector<std::string>& outputs);

  /// Who is told by `run`; of use as long as this is there.
  Spectator spectator();

  /// The last word: what the files got.
  void finish(const Image& image);

 private:
  void passed(const Rendering& rendering, int samples);
  void tile_finished(const Rendering& rendering, std::size_t tile);

  const RenderJob& job_;
  const RenderArguments& arguments_;
  const std::vector<std::string>& outputs_;
  std::optional<TevPicture> tev_;
};

}  // namespace minkray
