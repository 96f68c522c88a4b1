// SPDX-License-Identifier: MIT
// Up to four points of contact of two shapes, which keep a box from tipping over its one nearest
// point. The support points of each shape in directions tilted a little around the normal bound the
// part that faces the other one. Projected along the normal, the two polygons are clipped (I.
// Sutherland, G. Hodgman, "Reentrant Polygon Clipping", 1974), and at most four corners, which span
// the most, are kept.
#pragma once

#include <array>

#include "core/pair_distance/signed_distance.h"

namespace minkray {

struct ContactPoint {
  /// Points of A and B, to rounding, one over the other: point_b - point_a = distance * normal.
  Vec3<double> point_a = Vec3<double>::Zero();
  Vec3<double> point_b = Vec3<double>::Zero();
  double distance = 0;  ///< negative: so deep are the two in each other there
};

struct ContactManifold {
  Vec3<double> normal = Vec3<double>::Zero();  ///< from A to B, that of the signed distance
  std::array<ContactPoint, 4> points;          ///< the first is that of the signed distance
  int count = 0;
};

struct ManifoldOptions {
  double tilt = 0.02;  ///< radians: faces that lean by more against each other touch in less
  /// Points this much further apart than the nearest, in sizes of the smaller shape, are left out.
  double within = 0.02;
};

/// `nearest` is the signed distance of the two, with its points. No points if it is unknown.
ContactManifold contact_manifold(const ContactShape& a, const Affine<double>& pose_a,
                                 const ContactShape& b, const Affine<double>& pose_b,
                                 const SignedDistance& nearest,
                                 const ManifoldOptions& options = {});

}  // namespace minkray
