// SPDX-License-Identifier: MIT
#include "renderer/film/pixel_loop.h"

#include <gtest/gtest.h>

#include <atomic>

namespace minkray {
namespace {

/// A region that begins and ends within tiles, and is no multiple of a tile's size.
constexpr PixelRect region{13, 7, 60, 44};

struct Visits {
  std::uint64_t pixels = 0;

  std::uint64_t total() const { return pixels; }
  Visits& operator+=(const Visits& other) {
    pixels += other.pixels;
    return *this;
  }
};

TEST(PixelLoop, each_pixel_comes_once_for_any_block_and_any_number_of_threads) {
  for (const BlockSize size :
       {BlockSize{1, 1}, BlockSize{2, 1}, BlockSize{4, 4}, BlockSize{16, 8}, BlockSize{100, 3}})
    for (const int threads : {1, 3}) {
      std::vector<std::atomic<int>> seen(pixel_count(region));
      Visits visits;
      const auto on_block = [&](const PixelBlock& block, Visits& counts) {
        int pixels = 0;
        block.for_each([&](const Pixel& pixel) {
          ASSERT_LT(pixel.index, seen.size());
          EXPECT_EQ(static_cast<std::size_t>((pixel.y - region.y0) * region.width() + pixel.x -
                                             region.x0),
                    pixel.index);
          ++seen[pixel.index];
          ++pixels;
          ++counts.pixels;
        });
        EXPECT_GT(pixels, 0);
        EXPECT_LE(pixels, size.width * size.height);
      };
      with_threads(threads, [&] { EXPECT_TRUE(for_blocks(region, size, visits, {}, on_block)); });
      for (const std::atomic<int>& times : seen) EXPECT_EQ(times, 1);
      EXPECT_EQ(visits.pixels, pixel_count(region));
    }
}

// Blocks are written pixel by pixel: a block never has pixels of two tiles, and one of them may be
// done already.
TEST(PixelLoop, tiles_that_are_done_are_left_out) {
  const TileGrid tiles(region);
  TileJournal journal{std::vector<bool>(tiles.count()), {}};
  std::vector<std::size_t> finished;
  journal.finished = [&](std::size_t tile) { finished.push_back(tile); };
  for (std::size_t tile = 0; tile < tiles.count(); tile += 2) journal.done[tile] = true;
  std::vector<std::atomic<int>> seen(pixel_count(region));
  Visits visits;
  const auto on_block = [&](const PixelBlock& block, Visits& counts) {
    block.for_each([&](const Pixel& pixel) {
      ++seen[pixel.index];
      ++counts.pixels;
    });
  };
  EXPECT_TRUE(for_blocks(region, {5, 5}, visits, {}, on_block, journal));
  EXPECT_EQ(finished.size(), tiles.count() / 2);
  std::uint64_t open = 0;
  for (std::size_t tile = 0; tile < tiles.count(); ++tile)
    PixelBlock(region, tiles[tile]).for_each([&](const Pixel& pixel) {
      EXPECT_EQ(seen[pixel.index], tile % 2 == 0 ? 0 : 1);
      open += tile % 2;
    });
  EXPECT_EQ(visits.pixels, open);
}

TEST(PixelLoop, the_counts_of_a_tile_that_was_stopped_are_not_told) {
  std::atomic<int> pixels = 0;
  Visits visits;
  const RenderWatch watch{{}, [&] { return pixels > 300; }};
  EXPECT_FALSE(for_pixels(region, visits, watch, [&](const Pixel&, Visits& counts) {
    ++pixels;
    ++counts.pixels;
  }));
  EXPECT_LE(visits.pixels, 300u);
  EXPECT_LT(static_cast<std::size_t>(pixels), pixel_count(region));
}

}  // namespace
}  // namespace minkray
