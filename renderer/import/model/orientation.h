// SPDX-License-Identifier: MIT
// Notations of rotations in robots' files.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "core/math/affine.h"

namespace minkray {

/// Roll, pitch and yaw about the fixed x, y and z axes, in radians (URDF, SDF).
inline Mat3<double> rotation_of_rpy(const Vec3<double>& rpy) {
  const double cr = std::cos(rpy.x()), sr = std::sin(rpy.x());
  const double cp = std::cos(rpy.y()), sp = std::sin(rpy.y());
  const double cy = std::cos(rpy.z()), sy = std::sin(rpy.z());
  Mat3<double> m;
  m << cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr,  //
      sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr,   //
      -sp, cp * sr, cp * cr;
  return m;
}

/// A quaternion of any length; one of length zero turns nothing, as in MuJoCo.
inline Mat3<double> rotation_of_quaternion(double x, double y, double z, double w) {
  if (x == 0 && y == 0 && z == 0 && w == 0) return Mat3<double>::Identity();
  return rotation_matrix_of_any(x, y, z, w);
}

/// A turn about an axis of any length but zero.
inline Mat3<double> rotation_about(const Vec3<double>& axis, double angle) {
  const Vec3<double> s = unit(axis) * std::sin(angle / 2);
  return rotation_matrix(s.x(), s.y(), s.z(), std::cos(angle / 2));
}

/// Turns about x, y and z one after the other, in the order of the letters: small ones about the
/// axes as they have turned, capital ones about fixed axes (MJCF).
inline Mat3<double> rotation_of_euler(const Vec3<double>& angles, std::string_view letters) {
  Mat3<double> m = Mat3<double>::Identity();
  for (std::size_t i = 0; i < 3 && i < letters.size(); ++i) {
    const char letter = letters[i];
    const bool moves = letter >= 'a';
    const int axis = (moves ? letter - 'x' : letter - 'X');
    const Mat3<double> one = rotation_about(Vec3<double>::Unit(axis), angles[static_cast<int>(i)]);
    m = moves ? Mat3<double>(m * one) : Mat3<double>(one * m);
  }
  return m;
}

/// The least turn that brings z to the direction, which is not zero.
inline Mat3<double> rotation_of_z_to(const Vec3<double>& direction) {
  const Vec3<double> z = unit(direction);
  const Vec3<double> axis = Vec3<double>::UnitZ().cross(z);
  const double sine = axis.norm();
  // Along -z any axis across will do; x is MuJoCo's.
  const Vec3<double> about = sine < 1e-10 ? Vec3<double>(1, 0, 0) : Vec3<double>(axis / sine);
  return rotation_about(about, std::atan2(sine, z.z()));
}

/// x as it is, y made a right angle to it, z across both.
inline Mat3<double> rotation_of_xy(const Vec3<double>& x_axis, const Vec3<double>& y_axis) {
  const Vec3<double> x = unit(x_axis);
  const Vec3<double> y = unit<double>(y_axis - x.dot(y_axis) * x);
  Mat3<double> m;
  m.col(0) = x;
  m.col(1) = y;
  m.col(2) = x.cross(y);
  return m;
}

/// The quaternion x, y, z, w of a rotation.
inline std::array<double, 4> quaternion_of(const Mat3<double>& m) {
  // The largest of the four is divided by, for digits (Shepperd 1978).
  const double trace = m.trace();
  std::array<double, 4> q;  // x, y, z, w
  const double squares[4] = {m(0, 0), m(1, 1), m(2, 2), trace};
  const auto largest = static_cast<std::size_t>(std::max_element(squares, squares + 4) - squares);
  if (largest == 3) {
    q = {m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1), 1 + trace};
  } else {
    const int i = static_cast<int>(largest), j = (i + 1) % 3, k = (i + 2) % 3;
    q[largest] = 1 + m(i, i) - m(j, j) - m(k, k);
    q[static_cast<std::size_t>(j)] = m(j, i) + m(i, j);
    q[static_cast<std::size_t>(k)] = m(k, i) + m(i, k);
    q[3] = m(k, j) - m(j, k);
  }
  double length = 0;
  for (const double entry : q) length += entry * entry;
  for (double& entry : q) entry /= std::sqrt(length);
  return q;
}

}  // namespace minkray
