// SPDX-License-Identifier: MIT
// Up to four contact points of two shapes, so that a box does not tip over its single nearest
// point. The support points of each shape in directions tilted slightly from the normal are the
// corners of the part that faces the other shape. Projected along the normal, the two polygons are
// clipped (I. Sutherland, G. Hodgman, "Reentrant Polygon Clipping", 1974), and at most four
// corners, which span the most, are kept.
#pragma once

#include <array>

#include "core/pair_distance/signed_distance.h"

namespace minkray {

struct ContactPoint {
  /// Points of A and B, to rounding, opposite each other: point_b - point_a = distance * normal.
  Vec3<double> point_a = Vec3<double>::Zero();
  Vec3<double> point_b = Vec3<double>::Zero();
  double distance = 0;  ///< negative: minus the depth of the overlap at these points
};

struct ContactManifold {
  Vec3<double> normal = Vec3<double>::Zero();  ///< from A to B; the normal of the signed distance
  std::array<ContactPoint, 4> points;          ///< the first has the points of the signed distance
  int count = 0;
};

struct ManifoldOptions {
  double tilt = 0.02;  ///< radians; faces at a larger angle touch at an edge or a corner
  /// Omits points that are further apart than the nearest by this times the size of the smaller
  /// shape.
  double within = 0.02;
};

/// `nearest` is the signed distance of the two shapes. Returns no points if it is unknown.
ContactManifold contact_manifold(const ContactShape& a, const Affine<double>& pose_a,
                                 const ContactShape& b, const Affine<double>& pose_b,
                                 const SignedDistance& nearest,
                                 const ManifoldOptions& options = {});

}  // namespace minkray
