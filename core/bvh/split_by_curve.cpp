// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>

#include "core/bvh/sort_by_place.h"
#include "core/bvh/split.h"
#include "core/parallel/parallel_reduce.h"

namespace minkray {
namespace {

constexpr int bits_an_axis = 10;
/// Spreads the bits of x: puts two zeros before each bit.
std::uint32_t spread(std::uint32_t x) {
  x = (x | (x << 16)) & 0x030000ffu;
  x = (x | (x << 8)) & 0x0300f00fu;
  x = (x | (x << 4)) & 0x030c30c3u;
  return (x | (x << 2)) & 0x09249249u;
}

}  // namespace

CurveSplitter::CurveSplitter(FirstTouchVector<Primitive>& primitives) {
  const auto middles = parallel_reduce<BuildBox>(
      0, primitives.size(),
      [&](BuildBox& box, std::size_t i) { box.extend(primitives[i].middle()); },
      [](BuildBox& box, const BuildBox& of_range) { box.extend(of_range); });
  constexpr float cells = 1 << bits_an_axis;
  const Float4 scale = Float4(cells) / (middles.upper - middles.lower);
  const auto place = [&](const Primitive& primitive) {
    const Float4 at = (primitive.middle() - middles.lower) * scale;
    // NaN (if the middles have no extent) must select the first cell.
    const Float4 cell = min(select(at > Float4(0.0f), at, Float4(0.0f)), Float4(cells - 1));
    const auto bits = [&](int axis) { return spread(static_cast<std::uint32_t>(cell.lane(axis))); };
    return bits(0) << 2 | bits(1) << 1 | bits(2);
  };
  FirstTouchVector<KeyedPlace> keys;
  keys.resize(primitives.size());
  constexpr std::size_t range_size = 8192;
  const auto for_all = [&](const auto& body) {
    parallel_for(primitives.size(), range_size, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) body(i);
    });
  };
  for_all([&](std::size_t i) { keys[i] = KeyedPlace{place(primitives[i])} << 32 | i; });
  sort_by_place(keys, 3 * bits_an_axis);
  FirstTouchVector<Primitive> sorted;
  sorted.resize(primitives.size());
  codes_.resize(primitives.size());
  for_all([&](std::size_t i) {
    sorted[i] = primitives[static_cast<std::uint32_t>(keys[i])];
    codes_[i] = static_cast<std::uint32_t>(keys[i] >> 32);
  });
  primitives.swap(sorted);
}

BuildHalves CurveSplitter::split(const BuildRange& range) const {
  const std::uint32_t first = codes_[range.begin], last = codes_[range.end - 1];
  std::size_t middle = range.begin + range.count() / 2;
  if (first != last && range.depth < free_split_depth) {
    // All codes of the range agree in the bits above this one. The bit is clear in the first half
    // and set in the second.
    const std::uint32_t bit = std::bit_floor(first ^ last);
    const auto begin = codes_.begin() + static_cast<std::ptrdiff_t>(range.begin);
    const auto end = codes_.begin() + static_cast<std::ptrdiff_t>(range.end);
    middle = static_cast<std::size_t>(
        std::partition_point(begin, end, [&](std::uint32_t code) { return !(code & bit); }) -
        codes_.begin());
  }
  return {{range.begin, middle, range.depth + 1, {}}, {middle, range.end, range.depth + 1, {}}};
}

}  // namespace minkray
