// SPDX-License-Identifier: MIT
// Shows a picture during rendering: pass by pass in its files and in the terminal, tile by tile in
// tev.
#pragma once

#include <optional>

#include "renderer/io/tev.h"
#include "renderer/jobs/render_arguments.h"
#include "renderer/jobs/render_job.h"

namespace minkray {

/// Refers to the job, the arguments and the outputs.
class GrowingPicture {
 public:
  /// Throws CannotWrite if the viewer of --tev cannot be reached.
  GrowingPicture(const RenderJob& job, const RenderArguments& arguments,
                 const std::vector<std::string>& outputs);

  /// Callbacks for `run`, valid as long as this object.
  Spectator spectator();

  /// Shows the final picture, as written to the files.
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
