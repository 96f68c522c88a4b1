// SPDX-License-Identifier: MIT
// Bounds the error of a normal that was found at a point of a core's surface: the difference from
// the core's own normal there, and how far that turns nearby, at most by the curvature.
#pragma once

#include "core/pair/core_support.h"

namespace minkray {

/// Length of the difference from the true normal at most. The true point is on the surface of the
/// core grown by its radius, no further than `off` from `point`, with one normal only; n is of unit
/// length, and both are in the core's frame. Infinite where nothing is known: for a core without a
/// radius known by its support mapping only, and where `off` does not single out a face.
double normal_error_at(const ShapeCore& core, const Vec3<double>& point, const Vec3<double>& n,
                       double off);

}  // namespace minkray
