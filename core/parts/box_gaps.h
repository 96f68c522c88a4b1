// SPDX-License-Identifier: MIT
// Lower bounds of the distances from eight boxes to another box, whose axes may be rotated. This is
// the most frequent query when the boxes of two bodies are traversed. Separating axes are the face
// normals of both boxes, the line between the two middles, and a known good direction.
#pragma once

#include "core/math/vec.h"

namespace minkray {

/// An axis-aligned box given by its middle and half extents. Unless `normal` is 0, the box is cut
/// by two planes: only points p with low <= normal . p <= high belong to it.
struct MiddleBox {
  Vec3<double> middle = Vec3<double>::Zero(), half = Vec3<double>::Zero();
  Vec3<double> normal = Vec3<double>::Zero();
  double low = 0, high = 0;
};

/// Up to eight boxes, stored coordinate by coordinate for SIMD lanes.
struct EightBoxes {
  static constexpr int most = 8;  ///< maximum number of boxes
  alignas(32) double middle[3][most];
  alignas(32) double half[3][most];  ///< undefined in unused lanes
  alignas(32) double normal[3][most];
  alignas(32) double low[most];
  alignas(32) double high[most];

  MiddleBox box(int i) const {
    const auto at = [i](const double(&rows)[3][most]) {
      return Vec3<double>(rows[0][i], rows[1][i], rows[2][i]);
    };
    return {at(middle), at(half), at(normal), low[i], high[i]};
  }
  void set(int i, const MiddleBox& box) {
    for (int k = 0; k < 3; ++k) {
      middle[k][i] = box.middle[k];
      half[k][i] = box.half[k];
      normal[k][i] = box.normal[k];
    }
    low[i] = box.low;
    high[i] = box.high;
  }
};

/// Upper bound of n . p over the points p in the box.
inline double reach_along(const MiddleBox& box, const Vec3<double>& n) {
  const double by_box = n.dot(box.middle) + n.cwiseAbs().dot(box.half);
  // Splits n into a part perpendicular to the slab and the rest. The box bounds the rest.
  const double across = n.dot(box.normal);
  const Vec3<double> rest = n - across * box.normal;
  const double by_slab = across * (across < 0 ? box.low : box.high) + rest.dot(box.middle) +
                         rest.cwiseAbs().dot(box.half);
  return std::min(by_box, by_slab);
}

/// Map from the frame of the other box to the frame of the eight boxes: p -> turn * p + shift.
struct Turned {
  Mat3<double> turn;
  Vec3<double> shift;
};

/// A direction that is likely to separate the boxes.
struct KnownDirection {
  Vec3<double> along;  ///< unit vector towards the other box, in the frame of the eight boxes
  /// Upper bound of -along . p over the other box's points p, relative to its frame's origin.
  double reach;
};

/// Writes lower bounds of the distances to `gaps`, without a margin for rounding. If no axis
/// separates two boxes, the bound is below 0: minus their overlap along the best axis.
void box_gaps(const EightBoxes& boxes, const MiddleBox& other, const Turned& at,
              const KnownDirection* known, double* gaps);
/// Both functions return the same bits.
void box_gaps_avx2(const EightBoxes& boxes, const MiddleBox& other, const Turned& at,
                   const KnownDirection* known, double* gaps);
void box_gaps_sse2(const EightBoxes& boxes, const MiddleBox& other, const Turned& at,
                   const KnownDirection* known, double* gaps);

}  // namespace minkray
