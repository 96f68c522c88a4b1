// SPDX-License-Identifier: MIT
// Memory and handles of a process at one moment, and their growth from round to round.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace soak {

/// Resources held at the same point of a round, after all objects of the round are released.
struct Held {
  double seconds = 0;        ///< since the beginning
  std::size_t in_use = 0;    ///< bytes that were allocated and not freed (mallinfo2)
  std::size_t resident = 0;  ///< bytes of the process in memory
  std::size_t files = 0;     ///< open ones
  std::size_t threads = 0;
};

Held held_now(double seconds);

/// Describes the growth, or returns an empty text. The first tenth of the time, and the first two
/// rounds, are warm-up: oneTBB's threads start, tables are made on first use. The medians of the
/// first and the last quarter of the later rounds are compared.
std::string what_grew(const std::vector<Held>& rounds);

}  // namespace soak
