// SPDX-License-Identifier: MIT
// The eigenvalues and eigenvectors of a symmetric matrix.
#pragma once

#include <Eigen/Eigenvalues>

#include "core/math/vec.h"

namespace minkray {

struct PrincipalAxes {
  Vec3<double> values;  ///< ascending
  Mat3<double> axes;    ///< unit columns, in the order of the values
};

inline PrincipalAxes principal_axes(const Mat3<double>& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Mat3<double>> solver(symmetric);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace minkray
