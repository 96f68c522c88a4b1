// SPDX-License-Identifier: MIT
// Pairs of cores whose signed distance has a closed form: points, segments, boxes and disks.
#pragma once

#include "core/pair/core_pair.h"

namespace minkray {

inline bool is_line(const ShapeCore& core) {
  return core.kind == CoreKind::point || core.kind == CoreKind::segment;
}

/// Returns the distance between two segments: A from -p to p, B from x - q to x + q. Each may be a
/// single point. Both bounds are the distance.
CoreDistance between_segments(const Vec3<double>& p, const Vec3<double>& q, const Vec3<double>& x);

inline bool is_solid(const ShapeCore& core) {
  return core.kind == CoreKind::box || core.kind == CoreKind::disks;
}

/// Returns the signed distance between a solid (a box, or the hull of two disks) and a point p in
/// the solid's frame; negative inside. Both bounds are the distance. `axis` is the direction of the
/// shortest translation that moves the point out of the solid. `deeper` is the distance of the test
/// for other directions (deeper_by() in core_pair.h).
CoreDistance between_solid_and_point(const ShapeCore& solid, const Vec3<double>& p,
                                     double deeper = 0);

enum class BoxOverlap : unsigned char {
  none,
  without_points,  ///< the boxes overlap, but a and c are not set: an edge or a face lies in the
                   ///< contact plane, so there is no unique pair of points
  with_points,
};

/// Computes the penetration depth of two boxes: the least overlap along 15 axes (S. Gottschalk et
/// al., "OBBTree", 1996).
BoxOverlap box_overlap(const CorePair& pair, CoreDistance& found);

}  // namespace minkray
