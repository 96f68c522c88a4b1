// SPDX-License-Identifier: MIT
// Poses, points and numbers from the C interface, checked before use.
#pragma once

#include <cmath>
#include <limits>

#include "core/math/affine.h"
#include "renderer/library/handles/c_header.h"

namespace minkray {

/// True if it is the identity, number by number.
inline bool is_identity(const minkray_pose& pose) {
  bool is_same = true;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j) is_same &= pose.rows[i][j] == (i == j ? 1.0 : 0.0);
  return is_same;
}

/// True if the rows have length 1 and are orthogonal, up to a few roundings; false if any number is
/// not finite.
inline bool are_orthonormal(const double (&rows)[3][4]) {
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  const auto off = [&](int i, int j) {
    const double dot = rows[i][0] * rows[j][0] + rows[i][1] * rows[j][1] + rows[i][2] * rows[j][2];
    return std::abs(dot - (i == j ? 1 : 0));
  };
  // One branch for all six.
  return (off(0, 0) <= rounding) & (off(1, 1) <= rounding) & (off(2, 2) <= rounding) &
         (off(0, 1) <= rounding) & (off(1, 2) <= rounding) & (off(2, 0) <= rounding);
}

/// Throws CallError, which names the number, unless the numbers are finite and the map invertible.
void check_pose(const minkray_pose& pose, const char* argument);

/// Writes the map, which is the identity already, unless it is given as null. Returns whether it
/// keeps lengths. Throws CallError as check_pose does.
inline bool read_pose(const minkray_pose* pose, const char* argument, Affine<double>& to) {
  if (!pose) return true;
  const bool is_rigid = are_orthonormal(pose->rows);
  const double x = pose->rows[0][3], y = pose->rows[1][3], z = pose->rows[2][3];
  // A finite number times zero is zero, any other is not.
  if (!is_rigid || 0 * x + 0 * y + 0 * z != 0) [[unlikely]]
    check_pose(*pose, argument);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) to.linear(i, j) = pose->rows[i][j];
  to.translation = {x, y, z};
  return is_rigid;
}

/// The identity for null. Throws CallError as check_pose does.
inline Affine<double> pose_of(const minkray_pose* pose, const char* argument) {
  Affine<double> map;
  read_pose(pose, argument, map);
  return map;
}

minkray_pose plain_pose(const Affine<double>& pose);

/// Throws CallError that names the first of three numbers which is not finite, or null. `member` is
/// that of the argument which they are.
void check_vector(const double* numbers, const char* argument, const char* member);
inline Vec3<double> vector_of(const double* numbers, const char* argument,
                              const char* member = "") {
  if (!numbers || 0 * numbers[0] + 0 * numbers[1] + 0 * numbers[2] != 0) [[unlikely]]
    check_vector(numbers, argument, member);
  return {numbers[0], numbers[1], numbers[2]};
}

/// True if the pose keeps lengths, up to a few roundings.
bool is_rigid(const Affine<double>& pose);

}  // namespace minkray
