// SPDX-License-Identifier: MIT
// Tests if a point of a core's surface lies on an edge or at a corner, where the surface has
// several normals.
#pragma once

#include "core/pair/core_support.h"

namespace minkray {

/// `point` is on the surface but for `off`, and n a normal there, of unit length; both are in the
/// core's frame. False for a core known by its support mapping only: nothing is known there.
bool is_sharp_at(const ShapeCore& core, const Vec3<double>& point, const Vec3<double>& n,
                 double off);

}  // namespace minkray
