// SPDX-License-Identifier: MIT
#include "renderer/library/poses.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "renderer/library/call.h"

namespace minkray {
namespace {

/// What the product of a matrix and its inverse may be off: more means that there is none to speak
/// of.
constexpr double most_off_identity = 1e-3;

[[noreturn, gnu::cold]] void not_finite(const std::string& place, double number) {
  wrong_use(place + ": must be a finite number (got " + std::to_string(number) + ")");
}

[[gnu::noinline, gnu::cold]] void check_finite(const minkray_pose& pose, const char* argument) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j)
      if (!std::isfinite(pose.rows[i][j]))
        not_finite(
            std::string(argument) + ".rows[" + std::to_string(i) + "][" + std::to_string(j) + "]",
            pose.rows[i][j]);
}

[[gnu::noinline, gnu::cold]] void check_invertible(const Mat3<double>& linear,
                                                   const char* argument) {
  const Mat3<double> off = linear * inverse_of(linear) - Mat3<double>::Identity();
  if (!(off.cwiseAbs().maxCoeff() <= most_off_identity))
    wrong_use(std::string(argument) + ": must be invertible (got a singular matrix)");
}

/// Whether the rows are of length 1 and square to each other, but for a few roundings.
bool are_orthonormal(const double (*rows)[4]) {
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  const auto dot = [&](int i, int j) {
    return rows[i][0] * rows[j][0] + rows[i][1] * rows[j][1] + rows[i][2] * rows[j][2];
  };
  double off = 0;
  for (int i = 0; i < 3; ++i) {
    off = std::max(off, std::abs(dot(i, i) - 1));
    off = std::max(off, std::abs(dot(i, (i + 1) % 3)));
  }
  return off <= rounding;
}

}  // namespace

ReadPose read_pose(const minkray_pose* pose, const char* argument) {
  ReadPose read;
  if (!pose) return read;
  // What is finite times zero is zero, anything else is not.
  double zero = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) read.map.linear(i, j) = pose->rows[i][j];
    read.map.translation[i] = pose->rows[i][3];
    for (int j = 0; j < 4; ++j) zero += 0 * pose->rows[i][j];
  }
  if (zero != 0) [[unlikely]]
    check_finite(*pose, argument);
  read.is_rigid = are_orthonormal(pose->rows);
  if (!read.is_rigid) check_invertible(read.map.linear, argument);
  return read;
}

minkray_pose plain_pose(const Affine<double>& pose) {
  minkray_pose plain;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) plain.rows[i][j] = pose.linear(i, j);
    plain.rows[i][3] = pose.translation[i];
  }
  return plain;
}

Vec3<double> vector_of(const double* numbers, const char* argument, const char* member) {
  if (!numbers) wrong_use(std::string(argument) + member + ": must not be NULL");
  for (int k = 0; k < 3; ++k)
    if (!std::isfinite(numbers[k])) [[unlikely]]
      not_finite(std::string(argument) + member + "[" + std::to_string(k) + "]", numbers[k]);
  return {numbers[0], numbers[1], numbers[2]};
}

bool is_rigid(const Affine<double>& pose) {
  const minkray_pose plain = plain_pose(pose);
  return are_orthonormal(plain.rows);
}

}  // namespace minkray
