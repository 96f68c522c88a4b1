// SPDX-License-Identifier: MIT
// Body of the gaps between boxes. MINKRAY_BOX_GAPS is the function's name; all other names here
// contain the instruction set (core/math/wide.h).
#include "core/math/wide.h"
#include "core/parts/box_gaps.h"

namespace minkray {
namespace {

/// Distance from the gaps along three axes. If the boxes overlap along all axes, the gap along the
/// best axis.
template <class W>
W gap_of_axes(const Vec3<W>& apart) {
  const Vec3<W> far(max(apart.x(), W(0)), max(apart.y(), W(0)), max(apart.z(), W(0)));
  const W squared = far.x() * far.x() + (far.y() * far.y() + far.z() * far.z());
  return select(squared > W(0), sqrt(squared), max(apart.x(), max(apart.y(), apart.z())));
}

/// One box per lane, or the same box in all lanes.
template <class W>
struct BoxLanes {
  Vec3<W> middle, half, normal;
  W low, high;

  W reach_along(const Vec3<W>& n) const {
    const W across = n[0] * normal[0] + (n[1] * normal[1] + n[2] * normal[2]);
    W by_box(0), by_slab = across * select(across < W(0), low, high);
    for (int i = 0; i < 3; ++i) {
      const W rest = n[i] - across * normal[i];
      by_box += n[i] * middle[i] + abs(n[i]) * half[i];
      by_slab += rest * middle[i] + abs(rest) * half[i];
    }
    return min(by_box, by_slab);
  }
};

template <class W>
W gaps_of(const BoxLanes<W>& box, const MiddleBox& other, const Turned& at,
          const KnownDirection* known) {
  const Mat3<double>& R = at.turn;
  const Vec3<double> there = R * other.middle + at.shift, around = R.cwiseAbs() * other.half;
  Vec3<W> to, apart;
  for (int i = 0; i < 3; ++i) {
    to[i] = W(there[i]) - box.middle[i];
    apart[i] = abs(to[i]) - (box.half[i] + W(around[i]));
  }
  W gap = gap_of_axes<W>(apart);
  const auto turned = [&](const Vec3<W>& v, int i) {
    return W(R(0, i)) * v[0] + (W(R(1, i)) * v[1] + W(R(2, i)) * v[2]);
  };
  for (int i = 0; i < 3; ++i) {
    const W reach = W(std::abs(R(0, i))) * box.half[0] +
                    (W(std::abs(R(1, i))) * box.half[1] + W(std::abs(R(2, i))) * box.half[2]);
    apart[i] = abs(turned(to, i)) - (reach + W(other.half[i]));
  }
  gap = max(gap, gap_of_axes<W>(apart));
  // Gap along the line between the middles.
  const W length = sqrt(to[0] * to[0] + (to[1] * to[1] + to[2] * to[2]));
  const W scale = W(1) / max(length, W(std::numeric_limits<double>::min()));
  const Vec3<W> n(to[0] * scale, to[1] * scale, to[2] * scale);
  const BoxLanes<W> same{widen<W>(other.middle), widen<W>(other.half), widen<W>(other.normal),
                         W(other.low), W(other.high)};
  const Vec3<W> back(-turned(n, 0), -turned(n, 1), -turned(n, 2));
  const W shifted = n[0] * W(at.shift[0]) + (n[1] * W(at.shift[1]) + n[2] * W(at.shift[2]));
  gap = max(gap, shifted - (box.reach_along(n) + same.reach_along(back)));
  if (!known) return gap;
  const W ahead(known->along.dot(at.shift) - known->reach);
  return max(gap, ahead - box.reach_along(widen<W>(known->along)));
}

}  // namespace

void MINKRAY_BOX_GAPS(const EightBoxes& boxes, const MiddleBox& other, const Turned& at,
                      const KnownDirection* known, double* gaps) {
  using W = Wide<double, IsaHere::register_bytes / sizeof(double), IsaHere>;
  for (int from = 0; from < EightBoxes::most; from += LaneOf<W>::count) {
    const auto load = [&](const double(&rows)[3][EightBoxes::most]) {
      return Vec3<W>(W::load(rows[0] + from), W::load(rows[1] + from), W::load(rows[2] + from));
    };
    const BoxLanes<W> box{load(boxes.middle), load(boxes.half), load(boxes.normal),
                          W::load(boxes.low + from), W::load(boxes.high + from)};
    gaps_of<W>(box, other, at, known).store(gaps + from);
  }
}

}  // namespace minkray
