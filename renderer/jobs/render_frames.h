// SPDX-License-Identifier: MIT
// Pictures of a scene at several times, rendered and written one after another.
#pragma once

#include "renderer/jobs/frames.h"
#include "renderer/jobs/render_arguments.h"
#include "renderer/jobs/render_job.h"
#include "renderer/jobs/render_statistics.h"

namespace minkray {

/// Renders the requested frames, and the contact sheet if requested. Moves the job's scene and
/// world from frame to frame.
void render_frames(RenderJob& job, const RenderArguments& options, const FrameRange& frames,
                   RenderStatistics& statistics);

}  // namespace minkray
