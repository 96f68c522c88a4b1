// SPDX-License-Identifier: MIT
// Numbers, vectors and matrices of 113 bits, for oracles.
#pragma once

#include <cmath>

#include "core/math/affine.h"

namespace minkray::testing {

__extension__ using Quad = __float128;
using QuadVec = Vec3<Quad>;
using QuadMat = Mat3<Quad>;

inline QuadVec quad(const Vec3<double>& v) {
  return v.cast<Quad>();
}

inline Quad size_of(Quad x) {
  return x < 0 ? -x : x;
}

/// The square root; 0 of what is not above 0.
inline Quad root(Quad x) {
  if (!(x > 0)) return 0;
  int exponent = 0;
  std::frexp(static_cast<long double>(x), &exponent);
  exponent -= exponent & 1;
  const Quad scaled = x * Quad(std::ldexp(1.0L, -exponent));
  Quad r = std::sqrt(static_cast<long double>(scaled));
  for (int i = 0; i < 2; ++i) r = (r + scaled / r) / 2;
  return r * Quad(std::ldexp(1.0L, exponent / 2));
}

/// The solution of m x = v, by Cramer's rule; for maps of ordinary condition.
inline QuadVec solved(const QuadMat& m, const QuadVec& v) {
  const QuadVec a = m.col(0), b = m.col(1), c = m.col(2);
  return QuadVec(v.dot(b.cross(c)), a.dot(v.cross(c)), a.dot(b.cross(v))) / a.dot(b.cross(c));
}

}  // namespace minkray::testing
