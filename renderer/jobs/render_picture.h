// SPDX-License-Identifier: MIT
// Renders one picture and writes its files, by this process alone or by all ranks.
#pragma once

#include <string>
#include <vector>

#include "renderer/jobs/render_arguments.h"
#include "renderer/jobs/render_job.h"
#include "renderer/jobs/render_statistics.h"

namespace minkray {

/// Renders the job's picture or share into `outputs`, and returns the light that was written.
Image render_picture(const RenderJob& job, const RenderArguments& options,
                     const std::vector<std::string>& outputs, RenderStatistics& statistics);

/// Renders on all ranks of the MPI job; rank 0 writes.
void render_picture_on(Ranks& ranks, const RenderJob& job, const RenderArguments& options,
                       RenderStatistics& statistics);

}  // namespace minkray
