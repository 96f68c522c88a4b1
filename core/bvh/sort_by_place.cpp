// SPDX-License-Identifier: MIT
#include "core/bvh/sort_by_place.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "core/parallel/parallel.h"

namespace minkray {
namespace {

/// Bits per pass of the sort. With so few bits, the counts stay in the first-level cache.
constexpr int bits_a_pass = 10;
constexpr std::size_t buckets = std::size_t{1} << bits_a_pass;

/// Number of keys in a range. One thread counts and moves the keys of a range. Ranges have many
/// more keys than counts.
constexpr std::size_t range_size = std::size_t{1} << 16;

using Counts = std::array<std::size_t, buckets>;

/// Replaces each count of keys by the position of the first of these keys in the sorted array.
/// Buckets are in order, and ranges are in order within a bucket.
void make_starts(std::vector<Counts>& of_ranges) {
  std::size_t start = 0;
  for (std::size_t bucket = 0; bucket < buckets; ++bucket)
    for (Counts& counts : of_ranges) start += std::exchange(counts[bucket], start);
}

}  // namespace

void sort_by_place(FirstTouchVector<KeyedPlace>& keys, int bits) {
  FirstTouchVector<KeyedPlace> other;
  other.resize(keys.size());
  std::vector<Counts> of_ranges((keys.size() + range_size - 1) / range_size);
  for (int shift = 32; shift < 32 + bits; shift += bits_a_pass) {
    const auto bucket_of = [&](KeyedPlace key) {
      return static_cast<std::size_t>(key >> shift) & (buckets - 1);
    };
    // Calls on_key(counts, key) for all keys, with the counts of the key's range.
    const auto for_ranges = [&](const auto& on_key) {
      parallel_for(of_ranges.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t range = first; range < last; ++range) {
          const std::size_t begin = range * range_size;
          for (std::size_t i = begin; i < std::min(begin + range_size, keys.size()); ++i)
            on_key(of_ranges[range], keys[i]);
        }
      });
    };
    for (Counts& counts : of_ranges) counts.fill(0);
    for_ranges([&](Counts& counts, KeyedPlace key) { ++counts[bucket_of(key)]; });
    make_starts(of_ranges);
    for_ranges([&](Counts& starts, KeyedPlace key) { other[starts[bucket_of(key)]++] = key; });
    keys.swap(other);
  }
}

}  // namespace minkray
