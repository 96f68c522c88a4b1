// SPDX-License-Identifier: MIT
// The pixels of a picture in tiles, on all threads.
#pragma once

#include <atomic>
#include <mutex>

#include "core/parallel/parallel.h"
#include "renderer/image.h"

namespace minkray {

/// Small enough for even loads and for quick answers to Ctrl-C, large enough for coherent rays.
inline constexpr int tile_size = 16;

/// Calls render_tile(PixelRect) -> counts for the tiles of `part`, possibly at once, and joins the
/// counts with +=; after each tile, one at a time, finished(fraction, counts so far) may stop the
/// rest by returning false. Answers whether all tiles were done.
template <class Counts, class RenderTile, class Finished>
bool for_tiles(const PixelRect& part, Counts& counts, const RenderTile& render_tile,
               const Finished& finished) {
  const auto tiles_along = [](int pixels) {
    return static_cast<std::size_t>((pixels + tile_size - 1) / tile_size);
  };
  const std::size_t columns = tiles_along(part.width()), rows = tiles_along(part.height());
  const std::size_t tile_count = columns * rows;
  std::mutex mutex;
  std::size_t done = 0;
  std::atomic<bool> stopped = false;
  for_parts(tile_count, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t tile = begin; tile < end; ++tile) {
      if (stopped) return;
      const int x = part.x0 + static_cast<int>(tile % columns) * tile_size;
      const int y = part.y0 + static_cast<int>(tile / columns) * tile_size;
      const Counts more = render_tile(
          PixelRect{x, y, std::min(x + tile_size, part.x1), std::min(y + tile_size, part.y1)});
      const std::lock_guard lock(mutex);
      counts += more;
      ++done;
      const double fraction = static_cast<double>(done) / static_cast<double>(tile_count);
      if (!finished(fraction, counts)) stopped = true;
    }
  });
  return done == tile_count;
}

}  // namespace minkray
