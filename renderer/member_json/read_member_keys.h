// SPDX-License-Identifier: MIT
// The "keys" of a camera, a light or a material: a list of times with some of its parameters.
#pragma once

#include <string>

#include "renderer/json/object_reader.h"
#include "renderer/json/values.h"
#include "renderer/member_json/member_codec.h"
#include "renderer/scene/member_keys.h"

namespace minkray {

/// True if the parameter's value can change over time. A texture cannot.
template <class M>
bool can_follow(const M&) {
  return true;
}
inline bool can_follow(const Paint& paint) {
  return paint.texture() == nullptr;
}
inline bool can_follow(const PaintIfAny& paint) {
  return paint && can_follow(*paint);
}

/// A direction, which has no middle with its opposite.
constexpr bool is_direction(const Parameter& parameter) {
  return parameter.unit == Unit::none && parameter.range == Range::any;
}

/// Adds a mistake if a line from one direction to the other leads through zero.
void check_turn(const Vec3<double>& from, const Vec3<double>& to, const JsonPath& path,
                Mistakes& mistakes);

/// Reads one key. Parameters that cannot change are unknown keys.
template <class V>
MemberKey<V> read_member_key(ObjectReader& object, const V& rest,
                             const std::vector<MemberKey<V>>& before, MeshFiles& files) {
  MemberKey<V> key{0, rest, 0};
  key.time =
      read_key_time(object, before.empty() ? std::nullopt : std::optional(before.back().time));
  visit_struct(key.values, [&]<class S>(S& values) {
    std::uint64_t bit = 1;
    for_each_field<S>([&](const auto& field) {
      using M = typename std::remove_cvref_t<decltype(field)>::Member;
      const std::uint64_t own_bit = bit;
      bit <<= 1;
      if constexpr (can_be_keyed<M>) {
        Parameter parameter = parameter_of(field);
        if (keeps_still(parameter.name) || !object.find(parameter.name)) return;
        parameter.optional = true;
        M& value = values.*(field.member);
        const M rested = value;
        if (!MemberCodec<M>::read(object, parameter, value, files)) return;
        const JsonPath at = object.path(parameter.name);
        key.given |= own_bit;
        if (!can_follow(rested) || !can_follow(value)) {
          object.mistakes().add(
              at, "must change from a colour to a colour: textures and metals stay the same");
          value = rested;
          key.given &= ~own_bit;
        }
        if constexpr (std::is_same_v<M, Vec3<double>>) {
          if (!is_direction(parameter)) return;
          if (value.isZero(0)) object.mistakes().add(at, "must not be zero");
          for (auto last = before.rbegin(); last != before.rend(); ++last)
            if (last->given & own_bit) {
              check_turn(struct_in<S>(last->values).*(field.member), value, at, object.mistakes());
              break;
            }
        }
      }
    });
  });
  return key;
}

/// Reads all keys of what is `rest` without them. Lights have an intensity as well.
template <class V>
MemberKeys<V> read_member_keys(const Json& json, const JsonPath& path, Mistakes& mistakes,
                               MeshFiles& files, const V& rest,
                               std::optional<double> intensity = std::nullopt) {
  MemberKeys<V> made{rest, intensity.value_or(1), {}, {}};
  if (!json.is_array() || json.empty()) {
    mistakes.add(path, "must be a list of at least one key (" + found(json) + ")");
    return made;
  }
  for (std::size_t i = 0; i < json.size(); ++i) {
    ObjectReader object(json[i], path / i, mistakes);
    if (!object.is_object()) continue;
    MemberKey<V> key = read_member_key(object, rest, made.keys, files);
    made.intensities.push_back(made.intensity);
    if (const Json* written = intensity ? object.find("intensity") : nullptr) {
      key.given |= intensity_bit;
      made.intensities.back() =
          read_number(*written, object.path("intensity"), mistakes, Range::brightness).value_or(1);
    }
    // The names of what may change, for suggestions.
    visit_struct(rest, [&]<class S>(const S&) {
      for_each_field<S>([&](const auto& field) {
        using M = typename std::remove_cvref_t<decltype(field)>::Member;
        if (can_be_keyed<M> && !keeps_still(field.name)) object.allow({field.name});
      });
    });
    object.finish();
    made.keys.push_back(std::move(key));
  }
  return made;
}

}  // namespace minkray
