// SPDX-License-Identifier: MIT
// Numbers per pixel in the page's format: planes one after another, each with the first bytes of
// all numbers, then the second ones, and so on. This compresses better than whole numbers.
#pragma once

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "core/math/vec.h"
#include "renderer/json/json.h"

namespace minkray {

/// Names of the types in the page.
template <class V>
constexpr const char* plane_type = "";
template <>
inline constexpr const char* plane_type<double> = "f64";
template <>
inline constexpr const char* plane_type<std::uint8_t> = "u8";
template <>
inline constexpr const char* plane_type<std::uint16_t> = "u16";
template <>
inline constexpr const char* plane_type<std::int16_t> = "i16";
template <>
inline constexpr const char* plane_type<std::uint32_t> = "u32";

struct PackedPlanes {
  Json list = Json::array();         ///< [name, type] in order
  std::vector<unsigned char> bytes;  ///< of all of them

  template <class V>
  void add(const std::string& name, const std::vector<V>& values) {
    static_assert(std::endian::native == std::endian::little);
    list.push_back(Json::array({name, plane_type<V>}));
    const std::size_t begin = bytes.size(), count = values.size();
    bytes.resize(begin + count * sizeof(V));
    for (std::size_t i = 0; i < count; ++i) {
      unsigned char of_value[sizeof(V)];
      std::memcpy(of_value, &values[i], sizeof(V));
      for (std::size_t k = 0; k < sizeof(V); ++k) bytes[begin + k * count + i] = of_value[k];
    }
  }
};

/// A length that is not negative, rounded up to the upper half of a float: two digits.
inline std::uint16_t length_in_16_bits(double length) {
  if (!(length > 0)) return std::isnan(length) ? 0x7f80 : 0;
  float rounded = static_cast<float>(length);
  if (static_cast<double>(rounded) < length)
    rounded = std::nextafter(rounded, std::numeric_limits<float>::infinity());
  return static_cast<std::uint16_t>((std::bit_cast<std::uint32_t>(rounded) + 0xffffu) >> 16);
}

/// A time in nanoseconds to the twelfth part of an octave: 12 * log2.
inline std::uint8_t time_in_8_bits(double nanoseconds) {
  const double octaves = std::log2(std::max(nanoseconds, 1.0));
  return static_cast<std::uint8_t>(std::min(std::lround(12 * octaves), 255l));
}

/// A direction as a point of the unfolded octahedron (Cigolle et al., "A Survey of Efficient
/// Representations for Independent Unit Vectors", 2014), to 7e-5. Zero has a second number that no
/// direction has.
inline std::array<std::int16_t, 2> direction_in_32_bits(const Vec3<double>& n) {
  constexpr double most = 32767;
  const double sum = n.cwiseAbs().sum();
  if (!(sum > 0)) return {0, -32768};
  double u = n.x() / sum, v = n.y() / sum;
  if (n.z() < 0) {
    const double folded = (1 - std::abs(v)) * (u < 0 ? -1 : 1);
    v = (1 - std::abs(u)) * (v < 0 ? -1 : 1);
    u = folded;
  }
  return {static_cast<std::int16_t>(std::lround(u * most)),
          static_cast<std::int16_t>(std::lround(v * most))};
}

}  // namespace minkray
