// SPDX-License-Identifier: MIT
// Poses, points and numbers that come over the border, looked at before anything is made of them.
#pragma once

#include <cstring>

#include "core/math/affine.h"
#include "renderer/library/c_header.h"

namespace minkray {

/// Whether it is the identity, number by number.
inline bool is_identity(const minkray_pose& pose) {
  static constexpr minkray_pose identity = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
  return std::memcmp(&pose, &identity, sizeof pose) == 0;
}

/// A map, and whether it keeps lengths.
struct ReadPose {
  Affine<double> map;
  bool is_rigid = true;
};

/// The identity for null. Throws CallError unless the numbers are finite and the map invertible.
ReadPose read_pose(const minkray_pose* pose, const char* argument);
inline Affine<double> pose_of(const minkray_pose* pose, const char* argument) {
  return read_pose(pose, argument).map;
}

minkray_pose plain_pose(const Affine<double>& pose);

/// Throws CallError unless the numbers are finite. `member` is that of the argument which they are.
Vec3<double> vector_of(const double* numbers, const char* argument, const char* member = "");

/// Whether lengths stay what they are, but for a few roundings.
bool is_rigid(const Affine<double>& pose);

}  // namespace minkray
