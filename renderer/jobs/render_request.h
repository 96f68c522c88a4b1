// SPDX-License-Identifier: MIT
// Converts the arguments of `minkray render` to a job. All functions throw WrongUsage for options
// that do not fit together, before anything is rendered.
#pragma once

#include "renderer/jobs/frames.h"
#include "renderer/jobs/render_arguments.h"
#include "renderer/jobs/render_job.h"

namespace minkray {

/// Returns the job without scene and world, and without values that depend on them.
RenderJob job_of(const RenderArguments& options, const Ranks& ranks);

/// Returns the frames to render; meaningless if there is only one picture.
FrameRange frames_of(const RenderArguments& options, const Ranks& ranks);

/// Sets the values that depend on the job's scene: the picture's size, and the share to render.
void set_options(RenderJob& job, const RenderArguments& options);

}  // namespace minkray
