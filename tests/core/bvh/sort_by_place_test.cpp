// SPDX-License-Identifier: MIT
// Keys are sorted as by a stable sort, by the requested bits, on any number of threads.
#include "core/bvh/sort_by_place.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "core/parallel/parallel.h"

namespace minkray {
namespace {

FirstTouchVector<KeyedPlace> random_keys(std::size_t count, std::uint64_t places) {
  std::mt19937_64 random(7);
  FirstTouchVector<KeyedPlace> keys;
  for (std::size_t i = 0; i < count; ++i) keys.push_back((random() % places) << 32 | i);
  return keys;
}

TEST(SortByPlace, is_a_stable_sort) {
  for (const std::size_t count : {0u, 1u, 2u, 1000u, 65535u, 65536u, 65537u, 300000u})
    for (const std::uint64_t places : {1ull, 5ull, 1ull << 30}) {
      FirstTouchVector<KeyedPlace> keys = random_keys(count, places);
      FirstTouchVector<KeyedPlace> expected = keys;
      std::stable_sort(expected.begin(), expected.end(),
                       [](KeyedPlace a, KeyedPlace b) { return a >> 32 < b >> 32; });
      sort_by_place(keys, 30);
      EXPECT_EQ(keys, expected) << count << " of " << places;
    }
}

TEST(SortByPlace, any_number_of_threads_gives_the_same) {
  const FirstTouchVector<KeyedPlace> keys = random_keys(400000, 1000);
  FirstTouchVector<KeyedPlace> by_one = keys, by_five = keys;
  with_threads(1, [&] { sort_by_place(by_one, 30); });
  with_threads(5, [&] { sort_by_place(by_five, 30); });
  EXPECT_EQ(by_one, by_five);
}

TEST(SortByPlace, higher_bits_do_not_count) {
  FirstTouchVector<KeyedPlace> keys = {KeyedPlace{1} << 42 | 7, KeyedPlace{1} << 32 | 8,
                                       KeyedPlace{1} << 42 | KeyedPlace{1} << 32 | 9};
  const FirstTouchVector<KeyedPlace> expected = keys;
  sort_by_place(keys, 10);
  EXPECT_EQ(keys, expected);
}

}  // namespace
}  // namespace minkray
