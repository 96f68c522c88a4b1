// SPDX-License-Identifier: MIT
// Numbers, vectors and maps with twice the digits ("two-fold"). Each number is stored as an
// unevaluated sum of two numbers. Used for differences of positions far from the origin. Error-free
// sums and products are from Dekker, "A Floating-Point Technique for Extending the Available
// Precision", 1971. A sum of terms of size x has an error of about 2^-104 x.
#pragma once

#include <cmath>

#include "core/math/affine.h"
#include "core/math/vec.h"

namespace minkray {

/// The number high + low; `low` is what rounding removed from `high`.
template <class W>
struct TwoFold {
  W high = W(0), low = W(0);
};

/// a + b, exactly. W may be a packet.
template <class W>
TwoFold<W> two_sum(const W& a, const W& b) {
  const W sum = a + b, of_b = sum - a;
  return {sum, W((a - (sum - of_b)) + (b - of_b))};
}

/// a * b, exactly, unless the product's last digits underflow.
template <class T>
TwoFold<T> two_product(T a, T b) {
  const T product = a * b;
  return {product, std::fma(a, b, -product)};
}

template <class T>
TwoFold<T> operator+(const TwoFold<T>& a, const TwoFold<T>& b) {
  const TwoFold<T> sum = two_sum(a.high, b.high);
  return two_sum(sum.high, T(sum.low + (a.low + b.low)));
}

template <class T>
TwoFold<T> operator*(const TwoFold<T>& a, const TwoFold<T>& b) {
  const TwoFold<T> product = two_product(a.high, b.high);
  return two_sum(product.high, T(product.low + (a.high * b.low + a.low * b.high)));
}

/// The vector high + low.
template <class W>
struct TwoFoldVec3 {
  Vec3<W> high = Vec3<W>::Zero(), low = Vec3<W>::Zero();

  TwoFoldVec3() = default;
  TwoFoldVec3(const Vec3<W>& v) : high(v) {}
  TwoFoldVec3(const Vec3<W>& of_high, const Vec3<W>& of_low) : high(of_high), low(of_low) {}

  TwoFold<W> operator[](int i) const { return {high[i], low[i]}; }
  void set(int i, const TwoFold<W>& x) {
    high[i] = x.high;
    low[i] = x.low;
  }
  Vec3<W> rounded() const { return high + low; }
  bool is_zero() const { return high.isZero(0) && low.isZero(0); }
  TwoFoldVec3 operator-() const { return {-high, -low}; }
};

/// a - b, exactly. W may be a packet.
template <class W>
TwoFoldVec3<W> exact_difference(const Vec3<W>& a, const Vec3<W>& b) {
  const auto x = two_sum<W>(a.x(), W(-b.x())), y = two_sum<W>(a.y(), W(-b.y())),
             z = two_sum<W>(a.z(), W(-b.z()));
  return {{x.high, y.high, z.high}, {x.low, y.low, z.low}};
}

template <class T>
TwoFoldVec3<T> operator+(const TwoFoldVec3<T>& a, const TwoFoldVec3<T>& b) {
  TwoFoldVec3<T> sum;
  for (int i = 0; i < 3; ++i) sum.set(i, a[i] + b[i]);
  return sum;
}

template <class T>
TwoFoldVec3<T> operator-(const TwoFoldVec3<T>& a, const TwoFoldVec3<T>& b) {
  return a + -b;
}

/// The matrix high + low.
template <class T>
struct TwoFoldMat3 {
  Mat3<T> high = Mat3<T>::Identity(), low = Mat3<T>::Zero();

  TwoFoldMat3() = default;
  TwoFoldMat3(const Mat3<T>& m) : high(m) {}

  TwoFold<T> operator()(int i, int j) const { return {high(i, j), low(i, j)}; }
  void set(int i, int j, const TwoFold<T>& x) {
    high(i, j) = x.high;
    low(i, j) = x.low;
  }
  bool is_identity() const { return high == Mat3<T>::Identity() && low.isZero(0); }
};

template <class T>
TwoFoldVec3<T> operator*(const TwoFoldMat3<T>& m, const TwoFoldVec3<T>& v) {
  TwoFoldVec3<T> image;
  for (int i = 0; i < 3; ++i) {
    TwoFold<T> sum;
    for (int j = 0; j < 3; ++j)
      if (v.high[j] != T(0)) sum = sum + m(i, j) * v[j];
    image.set(i, sum);
  }
  return image;
}

template <class T>
TwoFoldMat3<T> operator*(const TwoFoldMat3<T>& a, const TwoFoldMat3<T>& b) {
  TwoFoldMat3<T> product;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      product.set(i, j, a(i, 0) * b(0, j) + a(i, 1) * b(1, j) + a(i, 2) * b(2, j));
  return product;
}

/// Image of a point under a map whose numbers are taken as exact.
template <class T>
TwoFoldVec3<T> image_of(const Affine<T>& map, const TwoFoldVec3<T>& point) {
  return TwoFoldMat3<T>(map.linear) * point + TwoFoldVec3<T>(map.translation);
}

/// Inverse of an invertible matrix, by Newton's iteration from the inverse in T. The error of each
/// entry is about one rounding, for any condition number. If the inverse in T has no correct digit,
/// some entries of the result may be NaN.
template <class T>
Mat3<T> accurate_inverse(const TwoFoldMat3<T>& m) {
  // A step squares the error, so at least half of the digits must be correct before the last step.
  constexpr T half_the_digits = T(1) / T(1ll << (std::numeric_limits<T>::digits / 2 + 3));
  constexpr int most_steps = 8;
  TwoFoldMat3<T> inverse(inverse_of(m.high));
  bool is_pivoted = false;
  if (m.is_identity()) return inverse.high;
  for (int step = 0; step < most_steps; ++step) {
    Mat3<T> rest;  // identity - m * inverse
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) {
        TwoFold<T> sum{T(i == k ? 1 : 0), T(0)};
        for (int j = 0; j < 3; ++j) {
          const TwoFold<T> product = two_product(T(-m.high(i, j)), inverse.high(j, k));
          const TwoFold<T> next = two_sum(sum.high, product.high);
          const T small = m.high(i, j) * inverse.low(j, k) + m.low(i, j) * inverse.high(j, k);
          sum = {next.high, T(sum.low + (next.low + (product.low - small)))};
        }
        rest(i, k) = sum.high + sum.low;
      }
    const Mat3<T> correction = inverse.high * rest;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k)
        inverse.set(i, k, inverse(i, k) + TwoFold<T>{correction(i, k), T(0)});
    const T largest = rest.cwiseAbs().maxCoeff();
    if (largest <= half_the_digits) return inverse.high;
    if (largest < T(1)) continue;
    if (is_pivoted) break;
    // Pivoted elimination has an error proportional to the condition number. The error of cofactors
    // is proportional to the square of the condition number.
    is_pivoted = true;
    inverse = TwoFoldMat3<T>(Mat3<T>(m.high.fullPivLu().inverse()));
  }
  return Mat3<T>::Constant(std::numeric_limits<T>::quiet_NaN());
}

}  // namespace minkray
