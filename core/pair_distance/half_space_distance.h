// SPDX-License-Identifier: MIT
// Distance of a shape from a half-space, which is unbounded and so has no support mapping: the
// height of its lowest point above the plane.
#pragma once

#include "core/pair_distance/signed_distance.h"

namespace minkray {

/// A is the half-space of all points x with normal . x <= offset, the normal of unit length, B the
/// shape at a rigid pose. Negative if a part of B is below the plane: moving B that far along the
/// normal frees it. Unknown (is_unknown()) if lengths are not finite.
SignedDistance distance_to_half_space(const Vec3<double>& normal, double offset,
                                      const ContactShape& shape, const Affine<double>& pose);

/// A plane by one of its points, from which what is near it is near.
struct PlacedPlane {
  Vec3<double> normal = Vec3<double>::UnitZ();  ///< of unit length
  TwoFoldVec3<double> point;

  /// The plane of all points with normal . x = offset, under an invertible map.
  static PlacedPlane of(const Vec3<double>& normal, double offset, const Affine<double>& map);
};

/// `linear` turns to the axes of the plane and of the middle, as which points are given, too.
SignedDistance distance_to_half_space(const PlacedPlane& plane, const ContactShape& shape,
                                      const Mat3<double>& linear, const PlacedMiddle& middle);

/// A shape that has been brought near: its middle is `height` above the plane, which may be off by
/// `loss`. Points are seen from the middle, along the axes that `linear` turns to.
SignedDistance distance_to_half_space(const Vec3<double>& normal, double height, double loss,
                                      const ContactShape& shape, const Mat3<double>& linear);

}  // namespace minkray
