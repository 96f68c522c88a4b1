// SPDX-License-Identifier: MIT
// Distance of a shape from a half-space: the height of the shape's lowest point above the plane. A
// half-space is unbounded, so it has no support mapping.
#pragma once

#include "core/pair_distance/signed_distance.h"

namespace minkray {

/// Returns the signed distance of a half-space A and a shape B at a rigid pose. A consists of all
/// points x with normal . x <= offset, where the normal has unit length. The distance is negative
/// if a part of B is below the plane; moving B along the normal by this depth separates the two.
/// Unknown (is_unknown()) if lengths are not finite.
SignedDistance distance_to_half_space(const Vec3<double>& normal, double offset,
                                      const ContactShape& shape, const Affine<double>& pose);

/// A plane given by its normal and one of its points. Heights above the plane are accurate if this
/// point is near the bodies.
struct PlacedPlane {
  Vec3<double> normal = Vec3<double>::UnitZ();  ///< of unit length
  TwoFoldVec3<double> point;

  /// Returns the image of the plane normal . x = offset under an invertible map.
  static PlacedPlane of(const Vec3<double>& normal, double offset, const Affine<double>& map);
};

/// Variant for a shape at a given middle. `linear` rotates the shape's axes to the axes in which
/// the plane, the middle and the returned points are given.
SignedDistance distance_to_half_space(const PlacedPlane& plane, const ContactShape& shape,
                                      const Mat3<double>& linear, const PlacedMiddle& middle);

/// Variant for a relative placement: the shape's middle is `height` above the plane, with an error
/// of at most `loss`. Returned points are relative to the middle, in the axes that `linear` rotates
/// to.
SignedDistance distance_to_half_space(const Vec3<double>& normal, double height, double loss,
                                      const ContactShape& shape, const Mat3<double>& linear);

}  // namespace minkray
