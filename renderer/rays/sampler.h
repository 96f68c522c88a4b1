// SPDX-License-Identifier: MIT
// Evenly distributed sample points in the unit square: the first two Sobol dimensions under hashed
// Owen scrambling, with a new scramble and shuffle per pair of dimensions (Burley, "Practical
// Hash-based Owen Scrambling", JCGT 2020), and Laine and Karras' hash.
#pragma once

#include <array>
#include <cstdint>

namespace minkray {

namespace detail {

constexpr std::uint32_t reverse_bits(std::uint32_t x) {
  x = __builtin_bswap32(x);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
  x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
  return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

/// A bijection of 64 bits that leaves no pattern behind (Stafford's variant 13 of MurmurHash3's
/// finaliser, as in SplitMix64).
constexpr std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// Every bit is flipped or not depending on the bits below it and on the seed alone.
constexpr std::uint32_t scrambled_upwards(std::uint32_t x, std::uint32_t seed) {
  x += seed;
  x ^= x * 0x6c50b47cu;
  x ^= x * 0xb82f1e52u;
  x ^= x * 0xc7afe638u;
  return x ^ x * 0x8d22f6e6u;
}

/// The second Sobol dimension with its bits reversed; the first one's is the index. Bit r is the
/// sum of the index's bits c over the odd binomials "c over r", which are those where r's bits are
/// among c's (Lucas): sums over supersets, a bit of c at a time.
constexpr std::uint32_t sobol_second_reversed(std::uint32_t index) {
  index ^= (index >> 1) & 0x55555555u;
  index ^= (index >> 2) & 0x33333333u;
  index ^= (index >> 4) & 0x0f0f0f0fu;
  index ^= (index >> 8) & 0x00ff00ffu;
  return index ^ (index >> 16);
}

}  // namespace detail

/// The points of one sample of one pixel: they depend on (seed, pixel, sample) and on the number
/// of points drawn before, never on tiles or threads.
class Sampler {
 public:
  Sampler() = default;
  Sampler(std::uint64_t seed, int x, int y, std::uint32_t sample)
      : stream_(detail::mixed(detail::mixed(seed) ^
                              (static_cast<std::uint64_t>(static_cast<std::uint32_t>(y)) << 32 |
                               static_cast<std::uint32_t>(x)))),
        sample_(sample) {}

  /// The next pair of dimensions, in [0, 1) each. Over the samples 0 .. 2^k - 1 of a pixel every
  /// pair is a (0, 2)-net: each elementary interval of area 2^-k holds one point.
  std::array<double, 2> next() {
    const std::uint64_t hash = detail::mixed(stream_ + pair_++);
    const std::uint64_t more = detail::mixed(hash);
    const auto low = [](std::uint64_t bits) { return static_cast<std::uint32_t>(bits); };
    const auto high = [](std::uint64_t bits) { return static_cast<std::uint32_t>(bits >> 32); };
    const std::uint32_t index =
        detail::reverse_bits(detail::scrambled_upwards(detail::reverse_bits(sample_), low(hash)));
    const std::uint32_t a = detail::reverse_bits(detail::scrambled_upwards(index, high(hash)));
    const std::uint32_t b = detail::reverse_bits(
        detail::scrambled_upwards(detail::sobol_second_reversed(index), low(more)));
    return {a * 0x1p-32, b * 0x1p-32};
  }

 private:
  std::uint64_t stream_ = 0;
  std::uint64_t pair_ = 0;
  std::uint32_t sample_ = 0;
};

}  // namespace minkray
