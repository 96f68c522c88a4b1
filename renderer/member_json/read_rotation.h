// SPDX-License-Identifier: MIT
// Reads each form of a rotation in scene files: a quaternion, an axis and an angle, angles about x,
// y and z, or a target to face.
#pragma once

#include <array>
#include <optional>

#include "core/math/vec.h"
#include "renderer/json/json.h"
#include "renderer/json/mistakes.h"

namespace minkray {

/// A quaternion x, y, z, w of any length but zero; a written one as it is, others of unit length.
/// {"look_at": point} turns the z axis from `place` towards the point and keeps the x axis level.
/// Nothing, and a mistake, if it cannot be used.
std::optional<std::array<double, 4>> read_rotation(const Json& json, const JsonPath& path,
                                                   Mistakes& mistakes, const Vec3<double>& place);

/// Scales a quaternion to unit length.
std::array<double, 4> unit_quaternion(std::array<double, 4> q);

/// The spellings as a schema, without a description.
Json rotation_schema();

}  // namespace minkray
