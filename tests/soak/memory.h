// SPDX-License-Identifier: MIT
// What a process holds at one moment, and whether that grows from round to round.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace soak {

/// What is held at the same point of a round, when all that the round made is gone.
struct Held {
  double seconds = 0;        ///< since the beginning
  std::size_t in_use = 0;    ///< bytes that were allocated and not freed (mallinfo2)
  std::size_t resident = 0;  ///< bytes of the process in memory
  std::size_t files = 0;     ///< open ones
  std::size_t threads = 0;
};

Held held_now(double seconds);

/// Tells what grew, or nothing. The first tenth of the time, and the first two rounds, are warm-up:
/// oneTBB's threads start, tables are made when they are first asked for. Of the rounds after that
/// the medians of the first and the last quarter are compared.
std::string what_grew(const std::vector<Held>& rounds);

}  // namespace soak
