// SPDX-License-Identifier: MIT
// The loop over a picture's pixels, shared by pictures, heatmaps and data channels: tiles on all
// threads, blocks of neighbouring pixels in tiles, rows in blocks. The work at a pixel depends on
// the pixel alone, so results are bit-identical for any threads, crop and block size.
#pragma once

#include "renderer/film/tiles.h"

namespace minkray {

/// A pixel of the picture, and its place among those of the region that is made, in rows.
struct Pixel {
  int x = 0, y = 0;
  std::size_t index = 0;
};

/// The pixel's place in rows of the region, which it must lie in.
inline Pixel pixel_of(const PixelRect& region, int x, int y) {
  return {x, y,
          static_cast<std::size_t>(y - region.y0) * static_cast<std::size_t>(region.width()) +
              static_cast<std::size_t>(x - region.x0)};
}

inline std::size_t pixel_count(const PixelRect& region) {
  return static_cast<std::size_t>(region.width()) * static_cast<std::size_t>(region.height());
}

/// Largest number of columns and rows of neighbouring pixels per call.
struct BlockSize {
  int width = 1, height = 1;
};

/// Neighbouring pixels of one tile, as places of `region`.
class PixelBlock {
 public:
  PixelBlock(const PixelRect& region, const PixelRect& pixels) : region_(region), pixels_(pixels) {}

  std::size_t count() const { return pixel_count(pixels_); }

  /// Calls visit(pixel) for all of them, in rows.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (int y = pixels_.y0; y < pixels_.y1; ++y)
      for (int x = pixels_.x0; x < pixels_.x1; ++x) visit(pixel_of(region_, x, y));
  }

 private:
  const PixelRect& region_;
  PixelRect pixels_;
};

/// Calls on_block(block, counts) for the blocks of all tiles of `region` that are not done yet,
/// those of one tile one after another. Counts, watch, journal and result are those of for_tiles.
/// The watch is called once per tile: code that takes long at one pixel calls it again.
template <class Counts, class OnBlock>
bool for_blocks(const PixelRect& region, const BlockSize& size, Counts& counts,
                const RenderWatch& watch, const OnBlock& on_block,
                const TileJournal& journal = {}) {
  const auto do_tile = [&](const PixelRect& tile) {
    Counts of_tile;
    for (int y = tile.y0; y < tile.y1; y += size.height)
      for (int x = tile.x0; x < tile.x1; x += size.width)
        on_block(PixelBlock(region, {x, y, std::min(x + size.width, tile.x1),
                                     std::min(y + size.height, tile.y1)}),
                 of_tile);
    return of_tile;
  };
  return for_tiles(region, counts, watch, do_tile, journal);
}

/// Calls for single pixels: on_pixel(pixel, counts).
template <class Counts, class OnPixel>
bool for_pixels(const PixelRect& region, Counts& counts, const RenderWatch& watch,
                const OnPixel& on_pixel) {
  return for_blocks(region, {}, counts, watch, [&](const PixelBlock& block, Counts& of_tile) {
    block.for_each([&](const Pixel& pixel) { on_pixel(pixel, of_tile); });
  });
}

}  // namespace minkray
