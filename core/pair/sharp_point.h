// SPDX-License-Identifier: MIT
// Tests whether a point of a core's surface lies on an edge or at a corner, which have more than
// one normal.
#pragma once

#include "core/pair/core_support.h"

namespace minkray {

/// True if `point` lies on an edge or at a corner. `point` must be within `off` of the surface, and
/// the unit vector n must be a normal there, both in the core's frame. Returns false for a core
/// known only by its support mapping.
bool is_sharp_at(const ShapeCore& core, const Vec3<double>& point, const Vec3<double>& n,
                 double off);

}  // namespace minkray
