// SPDX-License-Identifier: MIT
#include "renderer/share.h"

#include <charconv>

#include "renderer/errors.h"

namespace minkray {

Share parse_share(const std::string& text, const std::string& option) {
  const auto wrong = [&](const std::string& why) {
    return WrongUsage(option + ": " + why + " (got " + text + ")");
  };
  Share share;
  const char* const end = text.data() + text.size();
  const auto [slash, first_error] = std::from_chars(text.data(), end, share.index);
  if (first_error != std::errc() || slash == end || *slash != '/')
    throw wrong("must be i/n, such as 3/8");
  const auto [rest, second_error] = std::from_chars(slash + 1, end, share.count);
  if (second_error != std::errc() || rest != end) throw wrong("must be i/n, such as 3/8");
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
    const int in_first = count / 2;
    const auto cut = [&](int from, int to) {
      return from + static_cast<int>(std::int64_t{to - from} * in_first / count);
    };
    const bool is_in_first = index < in_first;
    if (rect.width() >= rect.height()) {
      (is_in_first ? rect.x1 : rect.x0) = cut(rect.x0, rect.x1);
    } else {
      (is_in_first ? rect.y1 : rect.y0) = cut(rect.y0, rect.y1);
    }
    index -= is_in_first ? 0 : in_first;
    count = is_in_first ? in_first : count - in_first;
  }
  return rect;
}

[[gnu::noinline]] void BlockTotal::add(const Vec3<float>& block_sum) {
  total_ += block_sum.cast<double>();
}

}  // namespace minkray
