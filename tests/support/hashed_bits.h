// SPDX-License-Identifier: MIT
// Hashes of the results of queries, and of their paths and costs, compared with those that a file
// records.
#pragma once

#include <gtest/gtest.h>

#include "core/math/vec.h"
#include "renderer/base/hash.h"
#include "tests/support/recorded_hashes.h"

namespace minkray::testing {

struct HashedBits {
  Hash answers, costs;

  template <class Number>
  static void add(Hash& hash, const Number& number) {
    hash.add({reinterpret_cast<const char*>(&number), sizeof number});
  }
  static void add(Hash& hash, const Vec3<double>& v) {
    for (int k = 0; k < 3; ++k) add(hash, double(v[k]));
  }
};

/// The bits of all ways of querying `of`, by the ways' names: fails if they differ from the
/// recorded ones, or records them. Skips if the library's sines have other last bits.
template <class Bits>
void expect_as_recorded(RecordedHashes& recorded, const std::string& of,
                        const std::map<std::string, Bits>& bits) {
  std::map<std::string, std::string> found;
  for (const auto& [way, hashes] : bits) {
    found[of + ": " + way + " answers"] = hashes.answers.text();
    found[of + ": " + way + " costs"] = hashes.costs.text();
  }
  if (is_recording()) return recorded.replace(of + ": ", found);
  if (!recorded.is_comparable())
    GTEST_SKIP() << "recorded with " << recorded.build() << ": other last bits are no mistake";
  if (!has_recorded_sines()) GTEST_SKIP() << "recorded on a processor with FMA and AVX2";
  for (const auto& [name, hash] : found)
    EXPECT_EQ(hash, recorded.find(name))
        << name << (recorded.find(name).empty() ? " were never recorded" : " have changed")
        << "; see ./run golden";
}

}  // namespace minkray::testing
