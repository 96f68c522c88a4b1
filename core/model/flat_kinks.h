// SPDX-License-Identifier: MIT
// Handles flat summands (disks) in sums of ellipsoids. Where the direction crosses a disk's axis,
// the support point jumps to the opposite side of the disk, so Newton's method jumps, too. If a
// step crosses the axis, the next direction is the axis itself.
#pragma once

#include "core/model/sum_features.h"

namespace minkray {

/// The axis of a flat summand: a direction in which the support point jumps.
template <class W>
struct Kink {
  Mat3<W> F = Mat3<W>::Zero();  ///< the flat summand: the disk { F b : |b| <= 1 }
  Vec3<W> axis = Vec3<W>::Zero();
  Mask<W> here = Mask<W>(false);    ///< the requested direction is exactly the kink's axis
  Mask<W> solved = Mask<W>(false);  ///< the model is hit in that direction
  Mask<W> tried = Mask<W>(false);   ///< the axis has been a requested direction before
};

/// Returns the lanes in which all features with a weight have exactly the kink's flat summand.
template <class W>
Mask<W> all_have(const SumFeatures<W>& features, const Kink<W>& kink,
                 const std::array<W, 4>& weights) {
  using T = Lane<W>;
  Mask<W> have(true);
  for (std::size_t i = 0; i < 4; ++i) {
    const EllipsoidSum<W>& sum = features[i].sum;
    W difference(0), number(0);
    for (std::size_t k = 0; k < sum.used; ++k) {
      const W size = sum.F[k].cwiseAbs().sum();
      const Mask<W> is_flat = (size > W(0)) & ((sum.F[k].transpose() * kink.axis).norm() <=
                                               W(T(tolerance::flat_disk<T>)) * size);
      difference += select(is_flat, W((sum.F[k] - kink.F).cwiseAbs().sum()), W(0));
      number += select(is_flat, W(1), W(0));
    }
    have &= (weights[i] == W(0)) | ((difference == W(0)) & (number == W(1)));
  }
  return have;
}

/// If the step from `before` to m crosses the axis of a flat summand, sets m to the axis or, if the
/// model was not hit there, to a direction near it.
template <class W>
void pass_kinks(const SumFeatures<W>& features, Kink<W>& kink, const Vec3<W>& before,
                const Mask<W>& open, Vec3<W>& m) {
  using T = Lane<W>;
  // Distance from a kink at which the iteration continues, relative to the wanted step.
  constexpr T kink_margin = T(1) / T(8);
  const Mask<W> leaves = open & kink.here;
  if (any(leaves))
    m = select<W>(leaves, unit<W>(Vec3<W>(kink.axis + (m - kink.axis) * W(kink_margin))), m);
  kink.tried |= leaves;
  kink.here &= !open;
  for (std::size_t i = 0; i < 4; ++i) {
    const EllipsoidSum<W>& sum = features[i].sum;
    for (std::size_t k = 0; k < sum.used; ++k) {
      const Mat3<W>& F = sum.F[k];
      const Mask<W> is_flat = features.valid(i) & (F.col(2).cwiseAbs().sum() == W(0));
      if (!any(is_flat & open)) continue;
      const Vec3<W> across = F.col(0).cross(F.col(1));
      const Vec3<W> axis = unit<W>(select<W>(across.dot(m) < W(0), Vec3<W>(-across), across));
      const Mask<W> crosses = open & is_flat & (!leaves) & (!kink.here) & (axis.z() > W(0)) &
                              ((F.transpose() * before).dot(F.transpose() * m) < W(0)) &
                              (axis.dot(before) > W(0));
      const Mask<W> first = crosses & !kink.tried, again = crosses & kink.tried;
      kink.here |= first;
      kink.axis = select<W>(first, axis, kink.axis);
      for (int j = 0; j < 3; ++j)
        kink.F.col(j) = select<W>(first, Vec3<W>(F.col(j)), Vec3<W>(kink.F.col(j)));
      m = select<W>(first, axis, m);
      m = select<W>(again, unit<W>(Vec3<W>(axis + (before - axis) * W(kink_margin))), m);
    }
  }
}

}  // namespace minkray
