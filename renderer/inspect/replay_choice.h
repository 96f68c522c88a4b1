// SPDX-License-Identifier: MIT
// Order in which pixels get a replay until the page is full: one per kind of result first, then
// ever finer grids.
#pragma once

#include "renderer/inspect/pixel_answers.h"

namespace minkray {

/// All pixels whose casts are shown, each once, as indices in rows. First come, for every object
/// and status and, by each solver, last path, the pixel whose ray took most iterations.
std::vector<std::size_t> replay_order(const PixelAnswers& answers);

}  // namespace minkray
