// SPDX-License-Identifier: MIT
// Poses, points and numbers that come over the border, looked at before anything is made of them.
#pragma once

#include "core/math/affine.h"
#include "renderer/library/c_header.h"

namespace minkray {

/// The identity for null. Throws CallError unless the numbers are finite and the map invertible.
Affine<double> pose_of(const minkray_pose* pose, const char* argument);

minkray_pose plain_pose(const Affine<double>& pose);

/// Throws CallError unless the numbers are finite.
Vec3<double> vector_of(const double* numbers, const char* argument);

/// Whether lengths stay what they are, but for a few roundings.
bool is_rigid(const Affine<double>& pose);

}  // namespace minkray
