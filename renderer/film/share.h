// SPDX-License-Identifier: MIT
// One share of a picture: a rectangle of its pixels, or some of each pixel's samples. Depends on
// the picture and on "i/n" alone.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

#include "renderer/image/image.h"

namespace minkray {

/// "3/8": the third of eight; counted from 1.
struct Share {
  int index = 1;
  int count = 1;

  bool is_all() const { return count == 1; }
  std::string text() const { return std::to_string(index) + "/" + std::to_string(count); }
  bool operator==(const Share&) const = default;
};

/// No picture is split into more.
inline constexpr int most_shares = 1 << 20;

/// Parses the share from the text "i/n", with nothing around it. Throws WrongUsage that begins
/// with `option`.
Share parse_share(const std::string& text, const std::string& option);

/// The rectangle of a share: the longer side is halved again and again (unequal counts get unequal
/// halves), so that all are about as large and about as wide as high. The shares cover the
/// rectangle exactly once. Some are empty where there are not enough pixels for that many.
PixelRect tile_of(const PixelRect& whole, const Share& share);

/// True if none of `count` shares is empty.
bool can_be_tiled(const PixelRect& whole, int count);

/// The samples of a pixel in blocks. Each block is summed by itself and rounded to float; the
/// blocks' sums are added in order. That order of additions is the same wherever the blocks were
/// rendered: any split of the samples between blocks gives the same bits.
struct SampleBlocks {
  /// Greatest number of blocks: keeps files of shares small, and lets 64 machines share one pixel.
  static constexpr int most = 64;

  int samples = 1;

  int count() const { return std::min(samples, most); }
  /// The first sample of a block; of block count(): how many samples there are.
  int begin(int block) const { return static_cast<int>(std::int64_t{samples} * block / count()); }
  /// The block that a sample belongs to.
  int of(int sample) const {
    auto block = static_cast<int>(std::int64_t{sample} * count() / samples);
    while (begin(block + 1) <= sample) ++block;
    return block;
  }
  /// The first block of a share; the share after it begins where it ends.
  int first_of(const Share& share) const {
    return static_cast<int>(std::int64_t{count()} * (share.index - 1) / share.count);
  }
  int end_of(const Share& share) const { return first_of({share.index + 1, share.count}); }
};

/// The colour of a pixel from its blocks.
class BlockTotal {
 public:
  /// Defined in a separate file, since GCC 12 drops the rounding when it sees doubles rounded to
  /// float and widened again.
  void add(const Vec3<float>& block_sum);
  Vec3<float> mean(int samples) const { return (total_ / samples).cast<float>(); }

 private:
  Vec3<double> total_ = Vec3<double>::Zero();
};

}  // namespace minkray
