// SPDX-License-Identifier: MIT
// The arguments of `minkray render` made into a job. All of these throw WrongUsage for what does
// not go together, before anything is rendered.
#pragma once

#include "renderer/cli/frames.h"
#include "renderer/cli/render_arguments.h"
#include "renderer/cli/render_job.h"

namespace minkray {

/// The job without scene and world, and without what depends on them.
RenderJob job_of(const RenderArguments& options, const Ranks& ranks);

/// Which frames are to be rendered; of no meaning if there is to be one picture.
FrameRange frames_of(const RenderArguments& options, const Ranks& ranks);

/// Fills in what depends on the job's scene: the picture's size, and which share of it to render.
void set_options(RenderJob& job, const RenderArguments& options);

}  // namespace minkray
