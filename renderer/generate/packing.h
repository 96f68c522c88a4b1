// SPDX-License-Identifier: MIT
// Ellipsoids without overlap: each gets a random place and is dropped if the distance query finds
// that it meets another (random sequential addition; Widom, 1966).
#pragma once

#include <array>
#include <vector>

#include "core/math/vec.h"
#include "renderer/generate/random.h"

namespace minkray {

/// A position and a rotation (a quaternion x, y, z, w), each number a float's value: files hold
/// floats, and what is in them must not overlap.
struct PackedPose {
  Vec3<double> position;
  std::array<double, 4> rotation;
};

/// `count` ellipsoids of these radii in the cube of that half size. Throws std::runtime_error if
/// the cube is too small for them.
std::vector<PackedPose> pack_ellipsoids(std::size_t count, const Vec3<double>& radii,
                                        double half_size, Random& random);

}  // namespace minkray
