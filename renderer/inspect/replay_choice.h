// SPDX-License-Identifier: MIT
// In which order a page takes up pixels whose casts can be replayed, until it is full: first one of
// every kind of answer, then grids that get finer and finer.
#pragma once

#include "renderer/inspect/pixel_answers.h"

namespace minkray {

/// All pixels whose casts are shown, each once, as indices in rows. First come, for every object
/// and status and, by each solver, last path, the pixel whose ray took most iterations.
std::vector<std::size_t> replay_order(const PixelAnswers& answers);

}  // namespace minkray
