// SPDX-License-Identifier: MIT
#include "renderer/library/poses.h"

#include <cmath>
#include <string>

#include "renderer/library/call.h"

namespace minkray {
namespace {

/// What the product of a matrix and its inverse may be off: more means that there is none to speak
/// of.
constexpr double most_off_identity = 1e-3;

[[noreturn]] void not_finite(const std::string& place, double number) {
  wrong_use(place + ": must be a finite number (got " + std::to_string(number) + ")");
}

}  // namespace

Affine<double> pose_of(const minkray_pose* pose, const char* argument) {
  Affine<double> map;
  if (!pose) return map;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 4; ++j)
      if (!std::isfinite(pose->rows[i][j]))
        not_finite(
            std::string(argument) + ".rows[" + std::to_string(i) + "][" + std::to_string(j) + "]",
            pose->rows[i][j]);
    for (int j = 0; j < 3; ++j) map.linear(i, j) = pose->rows[i][j];
    map.translation[i] = pose->rows[i][3];
  }
  if (is_rigid(map)) return map;
  const Mat3<double> off = map.linear * inverse_of(map.linear) - Mat3<double>::Identity();
  if (!(off.cwiseAbs().maxCoeff() <= most_off_identity))
    wrong_use(std::string(argument) + ": must be invertible (got a singular matrix)");
  return map;
}

minkray_pose plain_pose(const Affine<double>& pose) {
  minkray_pose plain;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) plain.rows[i][j] = pose.linear(i, j);
    plain.rows[i][3] = pose.translation[i];
  }
  return plain;
}

Vec3<double> vector_of(const double* numbers, const char* argument) {
  require(numbers, argument);
  for (int k = 0; k < 3; ++k)
    if (!std::isfinite(numbers[k]))
      not_finite(std::string(argument) + "[" + std::to_string(k) + "]", numbers[k]);
  return {numbers[0], numbers[1], numbers[2]};
}

bool is_rigid(const Affine<double>& pose) {
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  const Mat3<double> off = pose.linear * pose.linear.transpose() - Mat3<double>::Identity();
  return off.cwiseAbs().maxCoeff() <= rounding;
}

}  // namespace minkray
