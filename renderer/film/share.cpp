// SPDX-License-Identifier: MIT
#include "renderer/film/share.h"

#include "core/files/text.h"
#include "renderer/base/errors.h"

namespace minkray {
namespace {

struct Halves {
  PixelRect first, second;
  int in_first;  ///< number of shares in the first
};

/// Cuts the longer side in proportion to the shares; there are at least two.
Halves halved(const PixelRect& rect, int count) {
  Halves halves{rect, rect, count / 2};
  const auto cut = [&](int from, int to) {
    return from + static_cast<int>(std::int64_t{to - from} * halves.in_first / count);
  };
  if (rect.width() >= rect.height())
    halves.first.x1 = halves.second.x0 = cut(rect.x0, rect.x1);
  else
    halves.first.y1 = halves.second.y0 = cut(rect.y0, rect.y1);
  return halves;
}

}  // namespace

Share parse_share(const std::string& text, const std::string& option) {
  const auto wrong = [&](const std::string& why) {
    return WrongUsage(option + ": " + why + " (got " + text + ")");
  };
  const std::size_t slash = text.find('/');
  Share share;
  if (slash == text.npos || !read_number(text.substr(0, slash), share.index) ||
      !read_number(text.substr(slash + 1), share.count))
    throw wrong("must be i/n, such as 3/8");
  if (share.count < 1 || share.count > most_shares)
    throw wrong("n must be from 1 to " + std::to_string(most_shares));
  if (share.index < 1 || share.index > share.count) throw wrong("i must be from 1 to n");
  return share;
}

PixelRect tile_of(const PixelRect& whole, const Share& share) {
  PixelRect rect = whole;
  int index = share.index - 1;
  int count = share.count;
  while (count > 1 && !rect.empty()) {
    const auto [first, second, in_first] = halved(rect, count);
    const bool is_in_first = index < in_first;
    rect = is_in_first ? first : second;
    index -= is_in_first ? 0 : in_first;
    count = is_in_first ? in_first : count - in_first;
  }
  return rect;
}

bool can_be_tiled(const PixelRect& whole, int count) {
  if (whole.empty()) return false;
  if (count == 1) return true;
  const auto [first, second, in_first] = halved(whole, count);
  return can_be_tiled(first, in_first) && can_be_tiled(second, count - in_first);
}

[[gnu::noinline]] void BlockTotal::add(const Vec3<float>& block_sum) {
  total_ += block_sum.cast<double>();
}

}  // namespace minkray
