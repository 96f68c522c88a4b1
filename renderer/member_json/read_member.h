// SPDX-License-Identifier: MIT
// Reading one described parameter from JSON. The member's type chooses the reader: these overloads
// are the list of all spellings (see core/support/field.h).
#pragma once

#include <array>
#include <span>

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

/// Each reads the key (or keys) of one parameter into `member`. False, and mistakes, if it is
/// missing and not optional, or cannot be used.
bool read_member(ObjectReader&, const Parameter&, double& member, MeshFiles&);
bool read_member(ObjectReader&, const Parameter&, std::array<double, 2>& member, MeshFiles&);
bool read_member(ObjectReader&, const Parameter&, Vec3<double>& member, MeshFiles&);
bool read_member(ObjectReader&, const Parameter&, std::array<Vec3<double>, 2>& member, MeshFiles&);
bool read_member(ObjectReader&, const Parameter&, std::array<Vec3<double>, 3>& member, MeshFiles&);
bool read_member(ObjectReader&, const Parameter&, PointCloud& member, MeshFiles&);
bool read_member(ObjectReader&, const Parameter&, Nested& member, MeshFiles&);
bool read_member(ObjectReader&, const Parameter&, ShapeList& member, MeshFiles&);
bool read_member(ObjectReader&, const Parameter&, AffineMap& member, MeshFiles&);
bool read_member(ObjectReader&, const Parameter&, Resolution& member, MeshFiles&);
bool read_member(ObjectReader&, const Parameter&, std::optional<double>& member, MeshFiles&);
bool read_member(ObjectReader&, const Parameter&, std::string& member, MeshFiles&);
bool read_member(ObjectReader&, const Parameter&, Paint& member, MeshFiles&);
bool read_member(ObjectReader&, const Parameter&, PaintIfAny& member, MeshFiles&);
bool read_member(ObjectReader&, const Parameter&, PictureFile& member, MeshFiles&);
/// Reads the names only. Their indices are found when all materials are read.
bool read_member(ObjectReader&, const Parameter&, TwoMaterials& member, MeshFiles&);
/// One of the names; `what` they are names of.
bool read_name(ObjectReader&, const Parameter&, std::string& member,
               std::span<const std::string_view> names, std::string_view what);
template <class List>
bool read_member(ObjectReader& object, const Parameter& parameter, NameOf<List>& member,
                 MeshFiles&) {
  return read_name(object, parameter, member.name, List::names, List::what);
}

/// The keys "translate", "rotate" and "scale", each optional, or "matrix".
std::optional<Affine<double>> read_affine(ObjectReader& object);

/// A list of keyed poses with rising times. Translations start from `place`, which is added.
std::vector<PoseKey> read_keys(const Json& json, const JsonPath& path, Mistakes& mistakes,
                               const Vec3<double>& place);

/// The time of a key, which must be later than the one before, if there is one.
double read_key_time(ObjectReader& key, std::optional<double> before);

/// Parameters that may be omitted.
enum class Leave { optional_ones, any };

/// All parameters of a described struct: a shape, a light, a material, the camera.
template <class S>
bool read_members(ObjectReader& object, S& described, MeshFiles& meshes,
                  Leave leave = Leave::optional_ones) {
  bool all_read = true;
  for_each_field<S>([&](const auto& field) {
    Parameter parameter = parameter_of(field);
    parameter.optional |= leave == Leave::any;
    all_read &= read_member(object, parameter, described.*(field.member), meshes);
  });
  return all_read;
}

}  // namespace minkray
