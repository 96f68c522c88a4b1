// SPDX-License-Identifier: MIT
// Final step of every cast, for a single ray or for a packet of rays in lanes. An Answer is a
// CastResult, Filtered or CastLanes.
#pragma once

#include <cmath>

#include "core/math/ray.h"
#include "core/math/wide.h"

namespace minkray {

/// Moves t to the nearer end of the ray if rounding put t beyond that end.
template <class W, class Answer>
[[gnu::always_inline]] inline void keep_on_ray(const Ray<W>& ray, Answer& answer) {
  using std::abs;
  using std::max;
  using std::min;
  const auto beyond = answer.t_base + answer.t_offset > ray.t_max;
  if (any(beyond)) {
    const W end = ray.t_max - answer.t_base;
    const W before = end - W(std::numeric_limits<Lane<W>>::epsilon()) * abs(end);
    answer.t_offset = select(beyond, before, answer.t_offset);
  }
  answer.t_offset = max(answer.t_offset, W(-answer.t_base));
  answer.offset_lo = min(answer.offset_lo, answer.t_offset);
  answer.offset_hi = max(answer.offset_hi, answer.t_offset);
}

/// False in lanes where lengths in the shape's own frame overflowed or their squares underflowed.
/// `normal` must have unit length or be zero.
template <class W, class Answer>
[[gnu::always_inline]] inline Mask<W> has_numbers(const Answer& answer, const Vec3<W>& normal) {
  using T = Lane<W>;
  return (normal.squaredNorm() < W(T(2))) & (answer.t_base == answer.t_base) &
         (answer.t_offset == answer.t_offset) & (answer.offset_lo == answer.offset_lo) &
         (answer.offset_hi == answer.offset_hi);
}

}  // namespace minkray
