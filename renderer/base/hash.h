// SPDX-License-Identifier: MIT
// Hash of bytes: 64-bit FNV-1a (Fowler, Noll and Vo) with a final mix. Not cryptographic; two
// random inputs collide with probability 2^-64.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace minkray {

class Hash {
 public:
  void add(std::string_view bytes) {
    for (const char byte : bytes) {
      state_ ^= static_cast<unsigned char>(byte);
      state_ *= 0x100000001b3u;
    }
    // The length as well: "ab" then "c" is not "a" then "bc".
    state_ = (state_ ^ bytes.size()) * 0x100000001b3u;
  }

  /// 16 hexadecimal digits.
  std::string text() const {
    std::uint64_t x = (state_ ^ (state_ >> 32)) * 0xd6e8feb86659fd93u;
    x ^= x >> 32;
    std::string digits(16, '0');
    for (auto digit = digits.rbegin(); digit != digits.rend(); ++digit, x >>= 4)
      *digit = "0123456789abcdef"[x & 15u];
    return digits;
  }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325u;
};

}  // namespace minkray
