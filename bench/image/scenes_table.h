// SPDX-License-Identifier: MIT
// Rays in scenes of many kinds, compared with Embree's best way to have the same shapes: goals for
// scenes, row by row.
#pragma once

#include "bench/image/image_bench.h"
#include "bench/image/report.h"

namespace minkray::bench {

/// Adds a goal for each row, and prints and answers the figures behind them.
Json measure_scenes(const ImageBenchOptions& options, std::vector<Goal>& goals);

}  // namespace minkray::bench
