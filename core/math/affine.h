// SPDX-License-Identifier: MIT
// Affine maps x -> linear * x + translation, and how to make them from quaternions and scales.
#pragma once

#include <Eigen/LU>
#include <algorithm>

#include "core/math/vec.h"

namespace minkray {

/// Returns the inverse of an invertible matrix. Divides the matrix by a power of two first, so that
/// the determinant neither overflows nor underflows.
template <class T>
Mat3<T> inverse_of(const Mat3<T>& linear) {
  int exponent = 0;
  std::frexp(linear.cwiseAbs().maxCoeff(), &exponent);
  const T down = std::ldexp(T(1), -exponent);
  return Mat3<T>(linear * down).inverse() * down;
}

/// True if the rows have unit length and are perpendicular, up to a few roundings. The transpose is
/// then as accurate as the result of inverse_of.
template <class T>
bool keeps_lengths(const Mat3<T>& linear) {
  constexpr T rounding = T(4) * std::numeric_limits<T>::epsilon();
  const Mat3<T> off = linear * linear.transpose() - Mat3<T>::Identity();
  return off.squaredNorm() <= rounding * rounding;
}

template <class T>
struct Affine {
  Mat3<T> linear = Mat3<T>::Identity();
  Vec3<T> translation = Vec3<T>::Zero();

  Vec3<T> operator()(const Vec3<T>& point) const { return linear * point + translation; }

  /// Applies `inner` first, then this map.
  Affine operator*(const Affine& inner) const {
    return {linear * inner.linear, (*this)(inner.translation)};
  }

  Affine inverse() const {
    const Mat3<T> inverted = inverse_of(linear);
    return {inverted, -(inverted * translation)};
  }

  template <class U>
  Affine<U> cast() const {
    return {linear.template cast<U>(), translation.template cast<U>()};
  }

  bool operator==(const Affine& other) const {
    return linear == other.linear && translation == other.translation;
  }
};

/// Rotation matrix of a quaternion (x, y, z, w), which need not have unit length. The squares of
/// its components must not leave the range of T.
template <class T>
Mat3<T> rotation_matrix(T x, T y, T z, T w) {
  const T s = T(2) / (x * x + y * y + z * z + w * w);
  Mat3<T> m;
  m << T(1) - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w),  //
      s * (x * y + z * w), T(1) - s * (x * x + z * z), s * (y * z - x * w),   //
      s * (x * z - y * w), s * (y * z + x * w), T(1) - s * (x * x + y * y);
  return m;
}

/// Same for all lengths except zero. Very long or short quaternions are scaled first; unit
/// quaternions are not scaled.
template <class T>
Mat3<T> rotation_matrix_of_any(T x, T y, T z, T w) {
  using std::abs;
  const T largest = std::max({abs(x), abs(y), abs(z), abs(w)});
  const T size = largest > T(2) || largest < T(0.25) ? largest : T(1);
  return rotation_matrix(x / size, y / size, z / size, w / size);
}

/// Returns the map x -> translate + rotate(scale * x).
template <class T>
Affine<T> from_translate_rotate_scale(const Vec3<T>& translate, const Mat3<T>& rotate,
                                      const Vec3<T>& scale) {
  return {rotate * scale.asDiagonal(), translate};
}

}  // namespace minkray
