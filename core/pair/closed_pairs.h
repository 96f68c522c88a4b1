// SPDX-License-Identifier: MIT
// Pairs of cores whose signed distance has a closed form: points, segments, boxes and disks.
#pragma once

#include "core/pair/core_pair.h"

namespace minkray {

inline bool is_line(const ShapeCore& core) {
  return core.kind == CoreKind::point || core.kind == CoreKind::segment;
}

/// Segments from -p to p, and from x - q to x + q; either may be a point. Both bounds are the
/// distance.
CoreDistance between_segments(const Vec3<double>& p, const Vec3<double>& q, const Vec3<double>& x);

inline bool is_solid(const ShapeCore& core) {
  return core.kind == CoreKind::box || core.kind == CoreKind::disks;
}

/// A box or disks against a point p, in the solid's frame: both bounds are the distance, negative
/// inside. `axis` is the direction of the least translation of the point that separates.
CoreDistance between_solid_and_point(const ShapeCore& solid, const Vec3<double>& p);

enum class BoxOverlap : unsigned char {
  none,
  without_points,  ///< a and c were not found: an edge or a face lies in the plane of contact
  with_points,
};

/// Two boxes that overlap: the least overlap of 15 axes is the penetration depth
/// (S. Gottschalk et al., "OBBTree", 1996).
BoxOverlap box_overlap(const CorePair& pair, CoreDistance& found);

}  // namespace minkray
