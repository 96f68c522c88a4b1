// SPDX-License-Identifier: MIT
// State of a pair that the caller keeps between two calls, as opaque numbers.
#pragma once

#include <algorithm>
#include <cstring>

#include "core/pair/pair_memory.h"
#include "renderer/library/handles/c_header.h"

namespace minkray {

/// Reads the memory, and writes it back when destroyed. The memory may be null.
class KeptMemory {
 public:
  explicit KeptMemory(minkray_pair_memory* kept) : kept_(kept) {
    if (!kept) return;
    Plain plain;
    std::memcpy(&plain, kept, sizeof plain);
    std::copy_n(plain.axis, 3, memory_.axis.data());
    std::copy_n(plain.feature_a, 4, memory_.feature_a);
    std::copy_n(plain.feature_b, 4, memory_.feature_b);
    memory_.count = std::clamp(plain.count, 0, 4);
  }
  ~KeptMemory() {
    if (!kept_) return;
    Plain plain = {};
    std::copy_n(memory_.axis.data(), 3, plain.axis);
    std::copy_n(memory_.feature_a, 4, plain.feature_a);
    std::copy_n(memory_.feature_b, 4, plain.feature_b);
    plain.count = memory_.count;
    std::memcpy(kept_, &plain, sizeof plain);
  }
  KeptMemory(const KeptMemory&) = delete;
  KeptMemory& operator=(const KeptMemory&) = delete;

  PairMemory* get() { return kept_ ? &memory_ : nullptr; }

 private:
  struct Plain {
    double axis[3];
    std::int32_t feature_a[4], feature_b[4], count, unused;
  };
  static_assert(sizeof(Plain) == sizeof(minkray_pair_memory));

  minkray_pair_memory* kept_;
  PairMemory memory_;
};

}  // namespace minkray
