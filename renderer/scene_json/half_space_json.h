// SPDX-License-Identifier: MIT
// Half-spaces in scene files: {"type": "plane", "normal": [0, 0, 1], "offset": 0} in the place of
// an object's shape.
#pragma once

#include <optional>
#include <tuple>

#include "core/support/field.h"
#include "core/world/half_space.h"
#include "renderer/json/json.h"
#include "renderer/json/mistakes.h"
#include "renderer/member_json/mesh_files.h"
#include "renderer/scene/scene.h"

namespace minkray {

/// A half-space as files describe it.
struct HalfSpaceDescription {
  Vec3<double> normal = {0, 0, 1};
  double offset = 0;

  static constexpr std::string_view name = half_space_name;
  static constexpr std::string_view doc =
      "All points x with normal . x <= offset: a plane, solid below. Only an object's own shape.";
  static constexpr auto fields() {
    using H = HalfSpaceDescription;
    return std::tuple{Field{"normal", &H::normal, Unit::none, Range::any,
                            "of any length except zero; default [0, 0, 1]", true},
                      Field{"offset", &H::offset, Unit::length, Range::any,
                            "along the unit normal; default 0", true}};
  }
};

bool is_half_space(const Json& shape);

/// Nothing, and mistakes, if anything in it is wrong. The normal may have any length but zero;
/// "offset" is along it.
std::optional<HalfSpaceBody<double>> read_half_space(const Json& json, const JsonPath& path,
                                                     Mistakes& mistakes, MeshFiles& meshes);

Json write_half_space(const HalfSpaceBody<double>& half_space);

}  // namespace minkray
