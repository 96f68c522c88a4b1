// SPDX-License-Identifier: MIT
// One picture by all ranks of an MPI job: rank 0 hands out tiles, every rank (including rank 0)
// renders them into files as `render --tile` does, and rank 0 merges the files. A job that was
// killed continues with the existing files.
#pragma once

#include <optional>

#include "renderer/jobs/render_job.h"
#include "renderer/share/merge.h"
#include "renderer/share/ranks.h"

namespace minkray {

/// Folder of the tiles' files, next to the picture.
std::string parts_folder(const std::string& output);

/// Number of tiles such that each has about 64 x 64 pixels: enough for even loads on many ranks,
/// few enough that the cost of files is negligible. Depends on the picture only, so that a job may
/// continue with another number of ranks.
int default_tile_count(const PixelRect& picture);

/// Returns the picture on rank 0, nothing on the others. Ends the process if it is interrupted.
/// Remove the parts when the picture is written.
std::optional<Merged> render_on(Ranks& ranks, const RenderJob& job, int tiles,
                                const std::string& output);

/// Removes the files of the picture's tiles, and their folder. If the folder contains anything
/// else, it stays and a note on stderr reports that.
void remove_parts(const std::string& output, int tiles);

}  // namespace minkray
