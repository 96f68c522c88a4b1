// SPDX-License-Identifier: MIT
// The sums of ellipsoids whose hull represents a shape: up to four, each with the direction in
// which it was found.
#pragma once

#include "core/derived/ellipsoid_sum.h"

namespace minkray {

/// Expressed in the ray's frame, relative to s.
template <class W>
struct SumFeature {
  EllipsoidSum<W> sum;
  Vec3<W> n = Vec3<W>::Zero();  ///< the direction, of unit length, in which it was found

  W support_function(const Vec3<W>& m) const {
    return select(sum.exact, sum.support_function(m), sum.s.dot(m));
  }
  const Vec3<W>& support_point(const Vec3<W>&) const { return sum.s; }
};

template <class W>
SumFeature<W> pick(const Mask<W>& condition, const SumFeature<W>& a, const SumFeature<W>& b) {
  return {select<W>(condition, a.sum, b.sum), select<W>(condition, a.n, b.n)};
}

template <class W>
class SumFeatures {
 public:
  using T = Lane<W>;
  using Sum = EllipsoidSum<W>;
  using Feature = SumFeature<W>;

  /// The newest feature is the last.
  static constexpr std::size_t newest = 3;

  const Feature& operator[](std::size_t i) const { return features_[i]; }
  const Mask<W>& valid(std::size_t i) const { return valid_[i]; }
  std::array<Vec3<W>, 4> centres() const {
    return {features_[0].sum.c, features_[1].sum.c, features_[2].sum.c, features_[3].sum.c};
  }

  /// Adds the newest feature; returns true in lanes that already had this feature. Older features
  /// that only osculate the surface keep their ellipsoids only if they are from other patches
  /// (smooth parts of the surface) and were found in nearly the same direction.
  Mask<W> add(const Feature& feature, const Vec3<W>& n) {
    Mask<W> repeated(false);
    for (std::size_t k = 0; k < newest; ++k) {
      if (!any(valid_[k])) continue;
      Feature& old = features_[k];
      const Mask<W> far = ((old.sum.patch - feature.sum.patch).squaredNorm() == W(0)) |
                          ((old.n - n).squaredNorm() > W(near_squared));
      flatten(old, far & !old.sum.exact);
      const Mask<W> same = valid_[k] & alike(old.sum, feature.sum);
      repeated |= same;
      valid_[k] &= !same;
    }
    features_[newest] = feature;
    valid_[newest] = Mask<W>(true);
    return repeated;
  }

  /// Keeps the newest feature and those with weights, which carry a hit.
  void keep(const std::array<W, 4>& weights) {
    Mask<W> placed(false);
    for (std::size_t k = 0; k < newest; ++k) {
      valid_[k] &= weights[k] != W(0);
      const Mask<W> here = (!valid_[k]) & (!placed);
      placed |= here;
      if (!any(here)) continue;
      features_[k] = pick(here, features_[newest], features_[k]);
      valid_[k] |= here;
    }
  }

  /// Turns the osculating features in some lanes, except the newest, into points; returns the lanes
  /// that changed.
  Mask<W> flatten_osculating(const Mask<W>& lanes) {
    Mask<W> flattened(false);
    for (std::size_t k = 0; k < newest; ++k) {
      const Mask<W> osculates = lanes & valid_[k] & !features_[k].sum.exact;
      flatten(features_[k], osculates);
      flattened |= osculates;
    }
    return flattened;
  }

 private:
  static Mask<W> alike(const Sum& a, const Sum& b) {
    W difference = (a.c - b.c).cwiseAbs().sum();
    for (std::size_t k = 0; k < std::max(a.used, b.used); ++k)
      difference += (a.F[k] - b.F[k]).cwiseAbs().sum();
    return a.exact & b.exact & (difference == W(0));
  }

  /// Replaces a feature by its support point, which is part of the shape for any curvature.
  static void flatten(Feature& feature, const Mask<W>& lanes) {
    if (!any(lanes)) return;
    feature.sum.c = select<W>(lanes, feature.sum.s, feature.sum.c);
    feature.sum.patch = select<W>(lanes, feature.sum.s, feature.sum.patch);
    feature.sum.exact |= lanes;
    for (std::size_t k = 0; k < feature.sum.used; ++k)
      for (int j = 0; j < 3; ++j)
        feature.sum.F[k].col(j) =
            select<W>(lanes, Vec3<W>(Vec3<W>::Zero()), Vec3<W>(feature.sum.F[k].col(j)));
  }

  /// Ellipsoids of two patches are used together if their directions differ by up to about 15
  /// degrees.
  static constexpr T near_squared = T(1) / T(16);

  std::array<Feature, 4> features_;
  std::array<Mask<W>, 4> valid_ = {Mask<W>(false), Mask<W>(false), Mask<W>(false), Mask<W>(false)};
};

}  // namespace minkray
