// SPDX-License-Identifier: MIT
// Interface of a mutator that supports a format between libFuzzer and its own changes of bytes.
#pragma once

#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

#include "tests/fuzz/change/choice.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace minkray::fuzz {

/// One of this many changes is made to bytes, whatever the format: readers must bear those as
/// well.
inline constexpr std::size_t one_of_bytes = 5;

/// The input changed by `changes`, or by its bytes where that cannot be; answers its new size.
template <class Changes>
std::size_t mutate(Changes& changes, std::uint8_t* data, std::size_t size, std::size_t max_size,
                   unsigned seed) {
  Choice choice(seed);
  if (!choice.one_in(one_of_bytes)) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    const std::optional<std::string> changed = changes.change(bytes, choice);
    if (changed && !changed->empty() && changed->size() <= max_size) {
      std::memcpy(data, changed->data(), changed->size());
      return changed->size();
    }
  }
  return LLVMFuzzerMutate(data, size, max_size);
}

}  // namespace minkray::fuzz
