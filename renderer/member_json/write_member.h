// SPDX-License-Identifier: MIT
// Writing one described parameter as JSON, by the member's type: the counterpart of read_member.h.
#pragma once

#include <array>
#include <string_view>

#include "core/geometry/point_cloud.h"
#include "core/support/affine_map.h"
#include "core/support/field.h"
#include "core/support/nested.h"
#include "renderer/json/json.h"
#include "renderer/scene/scene.h"

namespace minkray {

/// A list of three numbers.
Json to_json(const Vec3<double>& vector);

/// Each adds the key (or keys) of one parameter to the object.
void write_member(Json& object, std::string_view name, double member);
void write_member(Json& object, std::string_view name, const std::array<double, 2>& member);
void write_member(Json& object, std::string_view name, const Vec3<double>& member);
void write_member(Json& object, std::string_view name, const std::array<Vec3<double>, 2>& member);
void write_member(Json& object, std::string_view name, const std::array<Vec3<double>, 3>& member);
void write_member(Json& object, std::string_view name, const PointCloud& member);
void write_member(Json& object, std::string_view name, const Nested& member);
void write_member(Json& object, std::string_view name, const ShapeList& member);
void write_member(Json& object, std::string_view name, const AffineMap& member);
void write_member(Json& object, std::string_view name, const Resolution& member);
/// These are left out where there is none.
void write_member(Json& object, std::string_view name, const std::optional<double>& member);
void write_member(Json& object, std::string_view name, const PaintIfAny& member);
void write_member(Json& object, std::string_view name, const std::string& member);
void write_member(Json& object, std::string_view name, const Paint& member);
void write_member(Json& object, std::string_view name, const PictureFile& member);
void write_member(Json& object, std::string_view name, const TwoMaterials& member);
template <class List>
void write_member(Json& object, std::string_view name, const NameOf<List>& member) {
  write_member(object, name, member.name);
}

/// All parameters of a described struct.
template <class S>
void write_members(Json& object, const S& described) {
  for_each_field<S>(
      [&](const auto& field) { write_member(object, field.name, described.*(field.member)); });
}

}  // namespace minkray
