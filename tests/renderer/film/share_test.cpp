// SPDX-License-Identifier: MIT
#include "renderer/film/share.h"

#include <gtest/gtest.h>

#include <vector>

#include "renderer/base/errors.h"

namespace minkray {
namespace {

TEST(Share, tiles_cover_the_picture_exactly_once) {
  const PixelRect picture{5, 3, 64, 40};
  for (const int count : {1, 2, 3, 5, 8, 13, 64, 100, 300}) {
    std::vector<int> covered(static_cast<std::size_t>(picture.x1 * picture.y1));
    int smallest = picture.width() * picture.height(), largest = 0;
    for (int index = 1; index <= count; ++index) {
      const PixelRect tile = tile_of(picture, {index, count});
      ASSERT_FALSE(tile.empty()) << index << "/" << count;
      smallest = std::min(smallest, tile.width() * tile.height());
      largest = std::max(largest, tile.width() * tile.height());
      for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x)
          ++covered[static_cast<std::size_t>(y * picture.x1 + x)];
    }
    for (int y = 0; y < picture.y1; ++y)
      for (int x = 0; x < picture.x1; ++x)
        ASSERT_EQ(covered[static_cast<std::size_t>(y * picture.x1 + x)],
                  x >= picture.x0 && y >= picture.y0 ? 1 : 0)
            << x << " " << y << " of " << count;
    if (count <= 13) {
      EXPECT_LT(largest, 1.3 * smallest) << count;
    }
  }
}

TEST(Share, too_many_tiles_are_known_to_be_too_many) {
  int possible = 0;
  for (const PixelRect picture :
       {PixelRect{0, 0, 2, 2}, PixelRect{0, 0, 7, 1}, PixelRect{3, 1, 12, 9}})
    for (int count = 1; count < 80; ++count) {
      bool all = true;
      for (int index = 1; index <= count; ++index) all &= !tile_of(picture, {index, count}).empty();
      EXPECT_EQ(can_be_tiled(picture, count), all) << count;
      possible += all ? 1 : 0;
    }
  EXPECT_GT(possible, 20);
  EXPECT_TRUE(can_be_tiled({0, 0, 65536, 32768}, most_shares));
}

TEST(Share, blocks_of_samples_are_handed_out_exactly_once) {
  for (const int samples : {1, 2, 3, 63, 64, 65, 1000, 1 << 24}) {
    const SampleBlocks blocks{samples};
    EXPECT_EQ(blocks.begin(0), 0);
    EXPECT_EQ(blocks.begin(blocks.count()), samples);
    for (int block = 0; block < blocks.count(); ++block)
      EXPECT_LT(blocks.begin(block), blocks.begin(block + 1));
    for (int count = 1; count <= blocks.count(); ++count) {
      EXPECT_EQ(blocks.first_of({1, count}), 0);
      EXPECT_EQ(blocks.end_of({count, count}), blocks.count());
      for (int index = 1; index <= count; ++index)
        EXPECT_LT(blocks.first_of({index, count}), blocks.end_of({index, count}));
    }
  }
}

TEST(Share, is_written_as_i_of_n) {
  EXPECT_EQ(parse_share("3/8", "--tile"), (Share{3, 8}));
  for (const char* wrong : {"", "3", "/", "3/", "/8", "0/8", "9/8", "-1/8", "3/8/2", "3 /8", "a/b",
                            "1/99999999999", "1/1048577"})
    EXPECT_THROW(parse_share(wrong, "--tile"), WrongUsage) << wrong;
}

// GCC 12 left out the rounding of two of the three channels; merged shares then differed from the
// picture in every tenth pixel.
TEST(Share, blocks_are_rounded_to_float_before_they_are_added) {
  const Vec3<double> sum(0.1, 0.2, 0.3);
  BlockTotal total;
  total.add(sum.cast<float>());
  const Vec3<double> more(1e-9, 1e-9, 1e-9);
  total.add(more.cast<float>());
  const auto expected = [](double a, double b) {
    const volatile float x = static_cast<float>(a), y = static_cast<float>(b);
    return static_cast<float>((static_cast<double>(x) + static_cast<double>(y)) / 3);
  };
  const Vec3<float> mean = total.mean(3);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(mean[i], expected(sum[i], more[i]));
}

}  // namespace
}  // namespace minkray
