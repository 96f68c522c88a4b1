// SPDX-License-Identifier: MIT
// An affine map for support mappings: s_{MC+t}(n) = M s_C(M^T n) + t, where s_C is the support
// mapping of the shape C, and MC + t its image.
#pragma once

#include "core/math/affine.h"

namespace minkray {

/// Files specify the map by `translate`, `rotate` and `scale`, or by `matrix`. The map must be
/// invertible.
class AffineMap {
 public:
  AffineMap() = default;
  /// Stores M^T divided by the largest entry of M, so that directions stay near unit length for any
  /// scale of the map. Support mappings ignore a direction's length.
  AffineMap(const Affine<double>& affine)
      : affine_(affine),
        to_inner_(affine.linear.transpose() / affine.linear.cwiseAbs().maxCoeff()),
        similarity_(similarity_of(affine.linear)) {}

  const Affine<double>& affine() const { return affine_; }

  /// Factor by which the map scales all lengths, up to rounding; 0 if lengths scale differently.
  double similarity() const { return similarity_; }

  /// Direction for the inner shape's support mapping.
  template <class W>
  Vec3<W> inner_direction(const Vec3<W>& n) const {
    if constexpr (std::is_same_v<W, long double>) {  // in all digits of W
      const Mat3<W> linear = widen<W>(affine_.linear);
      return Mat3<W>(linear.transpose() / linear.cwiseAbs().maxCoeff()) * n;
    } else {
      return times(to_inner_, n);
    }
  }

  template <class W>
  Vec3<W> operator()(const Vec3<W>& point) const {
    return times(affine_.linear, point) + widen<W>(affine_.translation);
  }

 private:
  static double similarity_of(const Mat3<double>& linear) {
    constexpr double rounding = 4.0 * std::numeric_limits<double>::epsilon();
    const Mat3<double> squared = linear * linear.transpose();
    const double scale = squared.trace() / 3.0;
    const Mat3<double> rest = squared - Mat3<double>::Identity() * scale;
    return rest.cwiseAbs().maxCoeff() <= rounding * scale ? std::sqrt(scale) : 0.0;
  }

  Affine<double> affine_;
  Mat3<double> to_inner_ = Mat3<double>::Identity();
  double similarity_ = 1.0;
};

}  // namespace minkray
