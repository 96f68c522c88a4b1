// SPDX-License-Identifier: MIT
// The pixels of a picture in tiles, on all threads.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <mutex>

#include "core/parallel/parallel.h"
#include "renderer/image.h"

namespace minkray {

/// What a rendering is watched by; either may be missing.
struct RenderWatch {
  /// Told after each tile, one at a time: the fraction done and the rays so far.
  std::function<void(double fraction, std::uint64_t rays)> progress;
  /// Asked often, by all threads: whether to end early. A single pixel may take minutes.
  std::function<bool()> stop;

  bool stopped() const { return stop && stop(); }
};

/// Small enough for even loads, large enough for coherent rays.
inline constexpr int tile_size = 16;

/// Calls render_tile(PixelRect) -> counts for the tiles of `part`, possibly at once, and joins the
/// counts with +=; counts.total() are rays. Answers whether all tiles were done without being
/// stopped.
template <class Counts, class RenderTile>
bool for_tiles(const PixelRect& part, Counts& counts, const RenderWatch& watch,
               const RenderTile& render_tile) {
  const auto tiles_along = [](int pixels) {
    return static_cast<std::size_t>((pixels + tile_size - 1) / tile_size);
  };
  const std::size_t columns = tiles_along(part.width()), rows = tiles_along(part.height());
  const std::size_t tile_count = columns * rows;
  std::mutex mutex;
  std::size_t done = 0;
  for_parts(tile_count, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t tile = begin; tile < end && !watch.stopped(); ++tile) {
      const int x = part.x0 + static_cast<int>(tile % columns) * tile_size;
      const int y = part.y0 + static_cast<int>(tile / columns) * tile_size;
      const Counts more = render_tile(
          PixelRect{x, y, std::min(x + tile_size, part.x1), std::min(y + tile_size, part.y1)});
      const std::lock_guard lock(mutex);
      counts += more;
      if (watch.stopped()) return;
      ++done;
      if (watch.progress)
        watch.progress(static_cast<double>(done) / static_cast<double>(tile_count), counts.total());
    }
  });
  return done == tile_count;
}

}  // namespace minkray
