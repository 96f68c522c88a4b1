// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>

#include "core/bvh/split.h"
#include "core/parallel/parallel_reduce.h"

namespace minkray {
namespace {

constexpr int bits_an_axis = 10;
/// Sorted by so many bits at a time: their counts stay in the first cache.
constexpr int bits_a_pass = 10;

/// A place on the curve in the upper half, an index in the lower one.
using Keyed = std::uint64_t;

/// The bits of x with two zeros before each.
std::uint32_t spread(std::uint32_t x) {
  x = (x | (x << 16)) & 0x030000ffu;
  x = (x | (x << 8)) & 0x0300f00fu;
  x = (x | (x << 4)) & 0x030c30c3u;
  return (x | (x << 2)) & 0x09249249u;
}

/// Sorts by the upper halves and is stable.
void sort_by_place(std::vector<Keyed>& keys) {
  constexpr std::size_t buckets = std::size_t{1} << bits_a_pass;
  std::vector<Keyed> other(keys.size());
  for (int shift = 32; shift < 32 + 3 * bits_an_axis; shift += bits_a_pass) {
    const auto bucket = [&](Keyed key) {
      return static_cast<std::size_t>(key >> shift) & (buckets - 1);
    };
    std::vector<std::size_t> starts(buckets + 1, 0);
    for (const Keyed key : keys) ++starts[bucket(key) + 1];
    for (std::size_t i = 0; i < buckets; ++i) starts[i + 1] += starts[i];
    for (const Keyed key : keys) other[starts[bucket(key)]++] = key;
    keys.swap(other);
  }
}

}  // namespace

CurveSplitter::CurveSplitter(std::span<Primitive> primitives) {
  const auto middles = parallel_reduce<BuildBox>(
      0, primitives.size(),
      [&](BuildBox& box, std::size_t i) { box.extend(primitives[i].middle()); },
      [](BuildBox& box, const BuildBox& of_range) { box.extend(of_range); });
  constexpr float cells = 1 << bits_an_axis;
  const Float4 scale = Float4(cells) / (middles.upper - middles.lower);
  const auto place = [&](const Primitive& primitive) {
    const Float4 at = (primitive.middle() - middles.lower) * scale;
    // NaN (no extent at all) must fall through to the first cell.
    const Float4 cell = min(select(at > Float4(0.0f), at, Float4(0.0f)), Float4(cells - 1));
    const auto bits = [&](int axis) { return spread(static_cast<std::uint32_t>(cell.lane(axis))); };
    return bits(0) << 2 | bits(1) << 1 | bits(2);
  };
  std::vector<Keyed> keys(primitives.size());
  constexpr std::size_t range_size = 8192;
  const auto for_all = [&](const auto& body) {
    parallel_for(primitives.size(), range_size, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) body(i);
    });
  };
  for_all([&](std::size_t i) { keys[i] = Keyed{place(primitives[i])} << 32 | i; });
  sort_by_place(keys);
  const std::vector<Primitive> unsorted(primitives.begin(), primitives.end());
  codes_.resize(primitives.size());
  for_all([&](std::size_t i) {
    primitives[i] = unsorted[static_cast<std::uint32_t>(keys[i])];
    codes_[i] = static_cast<std::uint32_t>(keys[i] >> 32);
  });
}

BuildHalves CurveSplitter::split(const BuildRange& range) const {
  const std::uint32_t first = codes_[range.begin], last = codes_[range.end - 1];
  std::size_t middle = range.begin + range.count() / 2;
  if (first != last && range.depth < free_split_depth) {
    // All before have this bit clear, all behind have it set, and agree in those above.
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
