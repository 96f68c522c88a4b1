// SPDX-License-Identifier: MIT
// Runs over the tiles of a picture on all threads.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <mutex>
#include <vector>

#include "core/parallel/parallel.h"
#include "renderer/film/tile_order.h"
#include "renderer/image/image.h"

namespace minkray {

/// Callbacks of a rendering; each may be empty.
struct RenderWatch {
  /// Called after each tile, one at a time, with the fraction done and the rays so far.
  std::function<void(double fraction, std::uint64_t rays)> progress;
  /// Called often, by all threads. Returns true to stop early; a single pixel may take minutes.
  std::function<bool()> stop;
  /// Called before each progress with the picture's noise so far: Rendering::noise.
  std::function<void(double noise)> noise = {};

  bool stopped() const { return stop && stop(); }
};

/// Small enough for even loads, large enough for coherent rays.
inline constexpr int tile_size = 16;

/// The tiles of a region of a picture, in rows.
class TileGrid {
 public:
  explicit TileGrid(const PixelRect& region)
      : region_(region),
        columns_(tiles_along(region.width())),
        rows_(tiles_along(region.height())) {}

  std::size_t count() const { return columns_ * rows_; }
  std::size_t columns() const { return columns_; }
  std::size_t rows() const { return rows_; }
  PixelRect operator[](std::size_t tile) const {
    const int x = region_.x0 + static_cast<int>(tile % columns_) * tile_size;
    const int y = region_.y0 + static_cast<int>(tile / columns_) * tile_size;
    return {x, y, std::min(x + tile_size, region_.x1), std::min(y + tile_size, region_.y1)};
  }

 private:
  static std::size_t tiles_along(int pixels) {
    return static_cast<std::size_t>((pixels + tile_size - 1) / tile_size);
  }
  PixelRect region_;
  std::size_t columns_, rows_;
};

/// Tiles that are there already, and who hears of those that are rendered.
struct TileJournal {
  std::vector<bool> done;  ///< by tile; empty: none
  /// Called after each tile, one at a time.
  std::function<void(std::size_t tile)> finished;
};

/// Calls render_tile(PixelRect) -> counts for the tiles of `region` that are not done yet,
/// possibly at once, and joins the counts with +=; counts.total() are rays. Returns true if all
/// tiles were done without being stopped. Tiles that were stopped go neither to the counts nor to
/// the journal.
template <class Counts, class RenderTile>
bool for_tiles(const PixelRect& region, Counts& counts, const RenderWatch& watch,
               const RenderTile& render_tile, const TileJournal& journal = {}) {
  const TileGrid tiles(region);
  std::mutex mutex;
  auto done = static_cast<std::size_t>(std::count(journal.done.begin(), journal.done.end(), true));
  const std::vector<std::uint32_t> order = along_curve(tiles.columns(), tiles.rows());
  parallel_for(tiles.count(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && !watch.stopped(); ++i) {
      const std::size_t tile = order[i];
      if (!journal.done.empty() && journal.done[tile]) continue;
      const Counts more = render_tile(tiles[tile]);
      const std::lock_guard lock(mutex);
      if (watch.stopped()) return;
      counts += more;
      ++done;
      if (journal.finished) journal.finished(tile);
      if (watch.progress)
        watch.progress(static_cast<double>(done) / static_cast<double>(tiles.count()),
                       counts.total());
    }
  });
  return done == tiles.count();
}

}  // namespace minkray
