// SPDX-License-Identifier: MIT
// Contact manifold: up to four contact points of two shapes. With only one point, a resting box
// would tip over. Support points in directions tilted slightly from the normal are the corners of
// each shape's part that faces the other shape. The two polygons, projected along the normal, are
// clipped (I. Sutherland, G. Hodgman, "Reentrant Polygon Clipping", 1974). At most four corners are
// kept: those that span the largest area.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/pair_distance/signed_distance.h"

namespace minkray {

struct ContactPoint {
  /// Points of A and B with point_b - point_a = distance * normal. Up to rounding on flat parts; on
  /// curved ones they are chords' points, inside by up to tan(tilt) times the region's extent.
  Vec3<double> point_a = Vec3<double>::Zero();
  Vec3<double> point_b = Vec3<double>::Zero();
  double distance = 0;  ///< negative: minus the depth of the overlap at these points
};

struct ContactManifold {
  Vec3<double> normal = Vec3<double>::Zero();  ///< from A to B; the signed distance's normal
  std::array<ContactPoint, 4> points;  ///< points[0] has the nearest points of the signed distance
  int count = 0;
};

struct ManifoldOptions {
  /// Angle in radians. Faces at a larger angle to each other touch only at edges or corners.
  double tilt = 0.02;
  /// Omits pairs of points whose distance exceeds that of the nearest pair by more than this times
  /// the size of the smaller shape.
  double within = 0.02;
};

/// Returns the contact points. `nearest` must be the signed distance of the two shapes; if it is
/// unknown, there are no points.
ContactManifold contact_manifold(const ContactShape& a, const Affine<double>& pose_a,
                                 const ContactShape& b, const Affine<double>& pose_b,
                                 const SignedDistance& nearest,
                                 const ManifoldOptions& options = {});

/// Appends the nearest points and all corners of the part that both faces share.
/// contact_manifold() keeps at most four of these.
void add_contact_points(const ContactShape& a, const Affine<double>& pose_a, const ContactShape& b,
                        const Affine<double>& pose_b, const SignedDistance& nearest,
                        std::vector<ContactPoint>& to, const ManifoldOptions& options = {});

/// Returns `first`, the point furthest from it, the one that makes the largest triangle with both,
/// and the one on the other side that adds the most area. Skips points closer to a picked one than
/// `near`.
ContactManifold spread_points(const Vec3<double>& normal, const ContactPoint& first,
                              std::span<const ContactPoint> points, double near);

}  // namespace minkray
