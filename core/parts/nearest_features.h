// SPDX-License-Identifier: MIT
// Nearest points of two triangles that do not cross. Either both points are on edges, or one is a
// corner and the other is on a face (C. Ericson, "Real-Time Collision Detection", 2004, 5.1.9 and
// 5.1.10). Processes three edges or corners at once, in lanes.
#pragma once

#include "core/parts/triangle_pair.h"

namespace minkray {

struct NearestPoints {
  double squared = std::numeric_limits<double>::infinity();  ///< squared distance
  Vec3<double> a = Vec3<double>::Zero(), b = Vec3<double>::Zero();
};

/// Replaces `best` by the nearest points if they are closer. Both functions return the same bits.
void nearest_features_avx2(const TriangleCorners& a, const TriangleCorners& b, NearestPoints& best);
void nearest_features_sse2(const TriangleCorners& a, const TriangleCorners& b, NearestPoints& best);

}  // namespace minkray
