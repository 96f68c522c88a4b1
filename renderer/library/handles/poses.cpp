// SPDX-License-Identifier: MIT
#include "renderer/library/handles/poses.h"

#include <cmath>
#include <string>

#include "renderer/library/handles/call.h"

namespace minkray {
namespace {

/// Tolerance for the product of a matrix and its inverse: beyond it, the matrix counts as
/// singular.
constexpr double most_off_identity = 1e-3;

[[noreturn, gnu::cold]] void not_finite(const std::string& place, double number) {
  wrong_use(place + ": must be a finite number (got " + std::to_string(number) + ")");
}

}  // namespace

void check_pose(const minkray_pose& pose, const char* argument) {
  Mat3<double> linear;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j) {
      if (!std::isfinite(pose.rows[i][j]))
        not_finite(
            std::string(argument) + ".rows[" + std::to_string(i) + "][" + std::to_string(j) + "]",
            pose.rows[i][j]);
      if (j < 3) linear(i, j) = pose.rows[i][j];
    }
  const Mat3<double> off = linear * inverse_of(linear) - Mat3<double>::Identity();
  if (!(off.cwiseAbs().maxCoeff() <= most_off_identity))
    wrong_use(std::string(argument) + ": must be invertible (got a singular matrix)");
}

minkray_pose plain_pose(const Affine<double>& pose) {
  minkray_pose plain;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) plain.rows[i][j] = pose.linear(i, j);
    plain.rows[i][3] = pose.translation[i];
  }
  return plain;
}

void check_vector(const double* numbers, const char* argument, const char* member) {
  require(numbers, (std::string(argument) + member).c_str());
  for (int k = 0; k < 3; ++k)
    if (!std::isfinite(numbers[k]))
      not_finite(std::string(argument) + member + "[" + std::to_string(k) + "]", numbers[k]);
}

bool is_rigid(const Affine<double>& pose) {
  const minkray_pose plain = plain_pose(pose);
  return are_orthonormal(plain.rows);
}

}  // namespace minkray
