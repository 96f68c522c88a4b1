// SPDX-License-Identifier: MIT
// Distance of a shape from a half-space: the height of the shape's lowest point above the plane. A
// half-space is unbounded, so it has no support mapping.
#pragma once

#include "core/pair_distance/signed_distance.h"

namespace minkray {

/// A is the half-space of all points x with normal . x <= offset, where the normal has unit length;
/// B is the shape at a rigid pose. The distance is negative if a part of B is below the plane; a
/// move of B along the normal by this depth separates the two. Unknown (is_unknown()) if lengths
/// are not finite.
SignedDistance distance_to_half_space(const Vec3<double>& normal, double offset,
                                      const ContactShape& shape, const Affine<double>& pose);

/// A plane given by its normal and one of its points. Heights are accurate if the point is near the
/// bodies.
struct PlacedPlane {
  Vec3<double> normal = Vec3<double>::UnitZ();  ///< of unit length
  TwoFoldVec3<double> point;

  /// Maps the plane of all points with normal . x = offset by an invertible map.
  static PlacedPlane of(const Vec3<double>& normal, double offset, const Affine<double>& map);
};

/// `linear` rotates to the axes in which the plane, the middle and the returned points are given.
SignedDistance distance_to_half_space(const PlacedPlane& plane, const ContactShape& shape,
                                      const Mat3<double>& linear, const PlacedMiddle& middle);

/// For relative placement: the shape's middle is `height` above the plane, with an error of at most
/// `loss`. Returned points are relative to the middle, in the axes that `linear` rotates to.
SignedDistance distance_to_half_space(const Vec3<double>& normal, double height, double loss,
                                      const ContactShape& shape, const Mat3<double>& linear);

}  // namespace minkray
