// SPDX-License-Identifier: MIT
// How far eight boxes are from another one, at least, whose axes may be turned: what a walk over
// two bodies' boxes asks most often. By the separating axes of either box' faces, by the line
// between two middles, and by a direction that is known to be good.
#pragma once

#include "core/math/vec.h"

namespace minkray {

/// From the middle, half a side each way; and between two planes across `normal`, unless that is 0.
struct MiddleBox {
  Vec3<double> middle = Vec3<double>::Zero(), half = Vec3<double>::Zero();
  Vec3<double> normal = Vec3<double>::Zero();
  double low = 0, high = 0;
};

struct EightBoxes {
  static constexpr int most = 8;
  alignas(32) double middle[3][most];
  alignas(32) double half[3][most];  ///< some number where there is no box
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

/// How far what is in the box reaches along a vector of its frame, at most.
inline double reach_along(const MiddleBox& box, const Vec3<double>& n) {
  const double by_box = n.dot(box.middle) + n.cwiseAbs().dot(box.half);
  // A part of the way across the slab, and the rest by the box.
  const double across = n.dot(box.normal);
  const Vec3<double> rest = n - across * box.normal;
  const double by_slab = across * (across < 0 ? box.low : box.high) + rest.dot(box.middle) +
                         rest.cwiseAbs().dot(box.half);
  return std::min(by_box, by_slab);
}

/// The frame of one box as the frame of the others sees it.
struct Turned {
  Mat3<double> turn;
  Vec3<double> shift;
};

/// The unit vector is in the frame of the eight, and leads to the other box, which reaches back
/// along it from its own frame's origin by `reach` at most.
struct KnownDirection {
  Vec3<double> along;
  double reach;
};

/// Lower bounds of the distances, which do not allow for rounding; less than 0 where no axis tells
/// two boxes apart: by how much they overlap along the best of their axes.
void box_gaps(const EightBoxes& boxes, const MiddleBox& other, const Turned& at,
              const KnownDirection* known, double* gaps);
/// Both have the same bits.
void box_gaps_avx2(const EightBoxes& boxes, const MiddleBox& other, const Turned& at,
                   const KnownDirection* known, double* gaps);
void box_gaps_sse2(const EightBoxes& boxes, const MiddleBox& other, const Turned& at,
                   const KnownDirection* known, double* gaps);

}  // namespace minkray
