// SPDX-License-Identifier: MIT
// Bounds the error of a normal that was computed at a point of a core's surface. The bound is the
// difference from the core's exact normal at this point, plus the turn of the exact normal nearby,
// which follows from the curvature.
#pragma once

#include "core/pair/core_support.h"

namespace minkray {

/// Upper bound of the length of the difference between n and the true normal. The true point is on
/// the surface of the core grown by its radius, within `off` of `point`, and has a single normal.
/// `n` has unit length; `n` and `point` are in the core's frame. Infinite if unknown: for a core
/// without a radius that is known only by its support mapping, and if several faces are within
/// `off`.
double normal_error_at(const ShapeCore& core, const Vec3<double>& point, const Vec3<double>& n,
                       double off);

}  // namespace minkray
