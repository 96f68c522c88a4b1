// SPDX-License-Identifier: MIT
// Maps of shapes within shapes, composed in twice the digits: a shape that one map moves far away
// and the next one back is where the maps' numbers put it. Carries a bound of the numbers' errors.
#pragma once

#include "core/math/length.h"
#include "core/math/two_fold.h"

namespace minkray {

/// Rotations of files are quaternions, which a matrix holds to so much, relative to its largest
/// entry: 3.9 epsilons were seen (Frobenius norm, 20,000 random quaternions).
inline constexpr double rounding_of_turns = 4 * std::numeric_limits<double>::epsilon();

/// Twice the digits, relative to the numbers that are added up.
inline constexpr double two_fold_rounding = 0x1p-100;

/// Each row has one entry at most: no turn was rounded.
inline bool is_along_axes(const Mat3<double>& linear) {
  for (int i = 0; i < 3; ++i)
    if ((linear.row(i).array() != 0).count() > 1) return false;
  return true;
}

struct ComposedMap {
  TwoFoldMat3<double> linear;
  TwoFoldVec3<double> translation;
  double turn_error = 0;  ///< by how much `linear` may be off, as a length per length
  double loss = 0;        ///< by how much `translation` may be off, a length

  ComposedMap() = default;
  ComposedMap(const Affine<double>& map) : linear(map.linear), translation(map.translation) {
    if (!is_along_axes(map.linear)) turn_error = rounding_of_turns * stretch();
  }

  /// An image is no longer than this times what it is of.
  double stretch() const {
    const double largest = linear.high.cwiseAbs().maxCoeff();
    const Mat3<double> scaled = linear.high / (largest > 0 ? largest : 1);
    const Mat3<double> squared = (scaled.transpose() * scaled).cwiseAbs();
    return largest * std::sqrt(squared.rowwise().sum().maxCoeff());
  }

  /// The map's translation left out.
  ComposedMap about_origin() const {
    ComposedMap map = *this;
    map.translation = {};
    map.loss = 0;
    return map;
  }
  ComposedMap mirrored() const {
    ComposedMap map = *this;
    map.linear.high = -linear.high;
    map.linear.low = -linear.low;
    map.translation = -translation;
    return map;
  }

  TwoFoldVec3<double> image(const TwoFoldVec3<double>& point) const {
    return linear * point + translation;
  }
  /// Bounds the error of the image of a point whose own error is at most `error`.
  double loss_of_image(const Vec3<double>& point, double error = 0) const {
    const double far = length_of(point);
    return loss + stretch() * error + (turn_error + two_fold_rounding * stretch()) * far +
           two_fold_rounding * length_of(translation.high);
  }

  /// First `inner`, then this.
  ComposedMap operator*(const ComposedMap& inner) const {
    ComposedMap map;
    map.linear = linear * inner.linear;
    map.translation = image(inner.translation);
    map.turn_error = turn_error * inner.stretch() + stretch() * inner.turn_error;
    map.loss = loss_of_image(inner.translation.high, inner.loss);
    return map;
  }
};

}  // namespace minkray
