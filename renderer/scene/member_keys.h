// SPDX-License-Identifier: MIT
// Parameters of cameras, lights and materials that change in time: "keys" in a scene file. Each
// parameter goes along a line from key to key that names it, and stays before the first one and
// after the last one.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "renderer/scene/textures.h"

namespace minkray {

/// Some of a struct's parameters at one time.
template <class V>
struct MemberKey {
  double time = 0;
  V values;
  std::uint64_t given = 0;  ///< a bit for each parameter that the key names, in their order
};

/// The bit of a light's intensity, which is no parameter of its own.
inline constexpr std::uint64_t intensity_bit = std::uint64_t{1} << 63;

template <class M>
inline constexpr bool can_be_keyed = false;
template <>
inline constexpr bool can_be_keyed<double> = true;
template <>
inline constexpr bool can_be_keyed<std::optional<double>> = true;
template <>
inline constexpr bool can_be_keyed<Vec3<double>> = true;
template <>
inline constexpr bool can_be_keyed<Paint> = true;
template <>
inline constexpr bool can_be_keyed<PaintIfAny> = true;

/// Numbers that are no amounts, or that others have been made of when keys count.
constexpr bool keeps_still(std::string_view parameter) {
  return parameter == "blades" || parameter == "shutter" || parameter == "latitude_degrees" ||
         parameter == "longitude_degrees";
}

inline double between(double a, double b, double fraction) {
  return a + fraction * (b - a);
}
inline std::optional<double> between(const std::optional<double>& a, const std::optional<double>& b,
                                     double fraction) {
  return between(a.value_or(0), b.value_or(0), fraction);
}
inline Vec3<double> between(const Vec3<double>& a, const Vec3<double>& b, double fraction) {
  return a + fraction * (b - a);
}
inline Paint between(const Paint& a, const Paint& b, double fraction) {
  return between(a.colour(), b.colour(), fraction);
}
inline PaintIfAny between(const PaintIfAny& a, const PaintIfAny& b, double fraction) {
  return between(*a, *b, fraction);
}

/// Calls visit(s) for a struct, or for the alternative that a variant holds.
template <class V, class Visit>
void visit_struct(V& described, Visit&& visit) {
  if constexpr (requires { described.index(); })
    std::visit(visit, described);
  else
    visit(described);
}

template <class S, class V>
const S& struct_in(const V& described) {
  if constexpr (std::is_same_v<S, V>)
    return described;
  else
    return std::get<S>(described);
}

/// V is a described struct, or a variant of such.
template <class V>
struct MemberKeys {
  V rest;  ///< without keys; of a light without its intensity
  double intensity = 1;
  std::vector<double> intensities;  ///< at the keys
  std::vector<MemberKey<V>> keys;   ///< with times that rise

  V at(double time) const {
    V made = rest;
    visit_struct(made, [&]<class S>(S& changed) {
      std::uint64_t bit = 1;
      for_each_field<S>([&](const auto& field) {
        using M = typename std::remove_cvref_t<decltype(field)>::Member;
        if constexpr (can_be_keyed<M>) {
          if (const auto [from, to, fraction] = around(bit, time); from < keys.size()) {
            const M& before = struct_in<S>(keys[from].values).*(field.member);
            const M& after = struct_in<S>(keys[to].values).*(field.member);
            changed.*(field.member) = fraction > 0 ? between(before, after, fraction) : before;
          }
        }
        bit <<= 1;
      });
    });
    return made;
  }

  double intensity_at(double time) const {
    const auto [from, to, fraction] = around(intensity_bit, time);
    if (from >= keys.size()) return intensity;
    return fraction > 0 ? between(intensities[from], intensities[to], fraction) : intensities[from];
  }

 private:
  struct Around {
    std::size_t from, to;
    double fraction;
  };

  /// The keys with that bit before and after a time; their number if no key has it.
  Around around(std::uint64_t bit, double time) const {
    std::size_t before = keys.size(), after = keys.size();
    for (std::size_t i = 0; i < keys.size(); ++i) {
      if ((keys[i].given & bit) == 0) continue;
      if (keys[i].time <= time)
        before = i;
      else if (after == keys.size())
        after = i;
    }
    if (before == keys.size()) return {after, after, 0};
    if (after == keys.size()) return {before, before, 0};
    return {before, after, (time - keys[before].time) / (keys[after].time - keys[before].time)};
  }
};

/// Keys of one thing in a list.
template <class V>
struct KeysOf {
  std::uint32_t index = 0;
  MemberKeys<V> keys;
};

}  // namespace minkray
