// SPDX-License-Identifier: MIT
// Checks that two libraries give the same answers to the same rays: a speed without that is no
// result.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace bench {

inline constexpr std::uint32_t nothing = 0xffffffffu;

/// First hit of a ray.
struct Answer {
  double t = std::numeric_limits<double>::infinity();
  std::uint32_t object = nothing;
};

struct Agreement {
  bool holds = false;
  std::string text;
};

/// Expected accuracy of the other's results.
struct Trust {
  double error = 0;  ///< of its surfaces, a length; directions have length 1
  /// Part of the rays that may meet something else: those that pass an edge seen from the side
  /// within the surfaces' error of 1e-4 radii, a few in ten thousand an object.
  double most_different = 1e-3;
};

Agreement compare(const std::vector<Answer>& ours, const std::vector<Answer>& other,
                  const Trust& trust);

/// A hash of answers, their numbers' bits (FNV-1a).
class Hash {
 public:
  void add(const void* data, std::size_t bytes);
  template <class T>
  void add(const T& value) {
    add(&value, sizeof value);
  }
  std::uint32_t value() const { return static_cast<std::uint32_t>(state_ ^ state_ >> 32); }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325u;
};

}  // namespace bench
