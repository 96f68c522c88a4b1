// SPDX-License-Identifier: MIT
// An affine map for support mappings: s_{MC+t}(n) = M s_C(M^T n) + t.
#pragma once

#include "core/math/affine.h"

namespace minkray {

/// Files specify the map by `translate`, `rotate` and `scale`, or by `matrix`. Must be invertible.
template <class T>
class AffineMap {
 public:
  AffineMap() = default;
  /// M^T is stored divided by M's largest entry, so that directions stay near unit length for any
  /// scale of the map. Support mappings ignore a direction's length.
  AffineMap(const Affine<T>& affine)
      : affine_(affine),
        to_inner_(affine.linear.transpose() / affine.linear.cwiseAbs().maxCoeff()),
        similarity_(similarity_of(affine.linear)) {}

  const Affine<T>& affine() const { return affine_; }

  /// Factor by which the map scales all lengths, up to rounding; 0 if lengths scale differently.
  T similarity() const { return similarity_; }

  template <class U>
  AffineMap<U> cast() const {
    return AffineMap<U>(affine_.template cast<U>());
  }

  /// Direction for the inner shape's support mapping.
  template <class W>
  Vec3<W> inner_direction(const Vec3<W>& n) const {
    return times(to_inner_, n);
  }

  template <class W>
  Vec3<W> operator()(const Vec3<W>& point) const {
    return times(affine_.linear, point) + widen<W>(affine_.translation);
  }

 private:
  static T similarity_of(const Mat3<T>& linear) {
    constexpr T rounding = T(4) * std::numeric_limits<T>::epsilon();
    const Mat3<T> squared = linear * linear.transpose();
    const T scale = squared.trace() / T(3);
    const Mat3<T> rest = squared - Mat3<T>::Identity() * scale;
    return rest.cwiseAbs().maxCoeff() <= rounding * scale ? std::sqrt(scale) : T(0);
  }

  Affine<T> affine_;
  Mat3<T> to_inner_ = Mat3<T>::Identity();
  T similarity_ = T(1);
};

}  // namespace minkray
