// SPDX-License-Identifier: MIT
// Spelling of one described parameter in files: how it is read, written and described, by the
// member's type (see core/support/field.h).
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/point_cloud.h"
#include "core/support/affine_map.h"
#include "core/support/field.h"
#include "core/support/nested.h"
#include "renderer/json/object_reader.h"
#include "renderer/member_json/mesh_files.h"
#include "renderer/scene/scene.h"

namespace minkray {

/// A field without the types of its shape and member.
struct Parameter {
  std::string_view name;
  Unit unit;
  Range range;
  std::string_view doc;
  bool optional;
};

template <class S, class M>
constexpr Parameter parameter_of(const Field<S, M>& field) {
  return {field.name, field.unit, field.range, field.doc, field.optional};
}

/// Description of a parameter for people, and for the JSON Schema.
struct MemberDescription {
  std::string keys;           ///< "radius"; several where one may choose
  std::string value;          ///< "3 numbers"
  Json properties;            ///< JSON Schema: what each key holds
  std::vector<Json> allowed;  ///< JSON Schema: which keys must or must not be there
};

/// Instantiated in member_codec.cpp for every type of a member.
template <class M>
struct MemberCodec {
  /// Reads the key (or keys) of one parameter. False, and mistakes, if it is missing and not
  /// optional, or cannot be used. Materials are names only: their indices are found when all are
  /// read.
  static bool read(ObjectReader&, const Parameter&, M& member, MeshFiles&);
  /// Adds the key (or keys) to the object; none for a member that has no value.
  static void write(Json& object, std::string_view name, const M& member);
  static MemberDescription describe(const Parameter&);
};

/// One of a list of names; `what` they are names of.
struct NameCodec {
  std::span<const std::string_view> names;
  std::string_view what;
  bool read(ObjectReader&, const Parameter&, std::string& member) const;
  MemberDescription describe(const Parameter&) const;
};

template <class List>
struct MemberCodec<NameOf<List>> {
  static constexpr NameCodec names{List::names, List::what};
  static bool read(ObjectReader& object, const Parameter& parameter, NameOf<List>& member,
                   MeshFiles&) {
    return names.read(object, parameter, member.name);
  }
  static void write(Json& object, std::string_view name, const NameOf<List>& member) {
    MemberCodec<std::string>::write(object, name, member.name);
  }
  static MemberDescription describe(const Parameter& parameter) {
    return names.describe(parameter);
  }
};

/// Parameters that may be omitted.
enum class Leave { optional_ones, any };

/// Reads all parameters of a described struct: a shape, a light, a material, the camera.
template <class S>
bool read_members(ObjectReader& object, S& described, MeshFiles& meshes,
                  Leave leave = Leave::optional_ones) {
  bool all_read = true;
  for_each_field<S>([&](const auto& field) {
    using M = typename std::remove_cvref_t<decltype(field)>::Member;
    Parameter parameter = parameter_of(field);
    parameter.optional |= leave == Leave::any;
    all_read &= MemberCodec<M>::read(object, parameter, described.*(field.member), meshes);
  });
  return all_read;
}

template <class S>
void write_members(Json& object, const S& described) {
  for_each_field<S>([&](const auto& field) {
    using M = typename std::remove_cvref_t<decltype(field)>::Member;
    MemberCodec<M>::write(object, field.name, described.*(field.member));
  });
}

/// Calls visit(parameter, description) for each parameter.
template <class S, class Visit>
void for_each_description(Visit&& visit) {
  for_each_field<S>([&](const auto& field) {
    using M = typename std::remove_cvref_t<decltype(field)>::Member;
    visit(parameter_of(field), MemberCodec<M>::describe(parameter_of(field)));
  });
}

/// The keys "translate", "rotate" and "scale", each optional, or "matrix".
std::optional<Affine<double>> read_affine(ObjectReader& object);

/// A list of keyed poses with rising times. Translations start from `place`, which is added.
std::vector<PoseKey> read_keys(const Json& json, const JsonPath& path, Mistakes& mistakes,
                               const Vec3<double>& place);

/// The time of a key, which must be later than the one before, if there is one.
double read_key_time(ObjectReader& key, std::optional<double> before);

/// A list of three numbers.
Json to_json(const Vec3<double>& vector);

/// Schema of a list of `count` such things, and of a number in a range.
Json schema_of_list(const Json& item, std::size_t count);
Json schema_of_number(Range range);

/// "length", "degrees" or nothing.
std::string_view name_of(Unit unit);

}  // namespace minkray
