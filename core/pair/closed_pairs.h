// SPDX-License-Identifier: MIT
// Pairs of cores whose signed distance has a closed form: points, segments, boxes and disks.
#pragma once

#include "core/pair/core_pair.h"

namespace minkray {

inline bool is_line(const ShapeCore& core) {
  return core.kind == CoreKind::point || core.kind == CoreKind::segment;
}

/// Distance between the segment from -p to p and that from x - q to x + q; either may be a point.
/// Both bounds are the distance.
CoreDistance between_segments(const Vec3<double>& p, const Vec3<double>& q, const Vec3<double>& x);

inline bool is_solid(const ShapeCore& core) {
  return core.kind == CoreKind::box || core.kind == CoreKind::disks;
}

/// Signed distance between a solid (a box, or the hull of two disks) and a point p in the solid's
/// frame; negative inside. Both bounds are the distance. `axis` is the direction of the shortest
/// translation that moves the point out of the solid.
CoreDistance between_solid_and_point(const ShapeCore& solid, const Vec3<double>& p);

enum class BoxOverlap : unsigned char {
  none,
  without_points,  ///< CoreDistance::a and c are not set: an edge or a face lies in the
                   ///< contact plane
  with_points,
};

/// Penetration depth of two overlapping boxes: the least overlap along 15 axes (S. Gottschalk et
/// al., "OBBTree", 1996).
BoxOverlap box_overlap(const CorePair& pair, CoreDistance& found);

}  // namespace minkray
