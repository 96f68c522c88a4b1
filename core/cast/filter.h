// SPDX-License-Identifier: MIT
// First stage of a cast: the shape's closed form in double, with an error bound. Decides nearly all
// rays. If the error bound is too large to decide, the ray is "in doubt" and the next stage runs
// (cf. Shewchuk, "Adaptive Precision Floating-Point Arithmetic", 1997). Single rays and packets
// share this code, so their results are bit-identical.
#pragma once

#include "core/cast/form_line.h"
#include "core/exact/enter.h"
#include "core/query/on_ray.h"
#include "core/query/result.h"

namespace minkray {

/// Results of the filter, one ray per lane. A lane that is neither hit, inside nor miss is in
/// doubt. All other members are those of CastResult.
template <class W>
struct Filtered {
  Mask<W> hit, inside, miss;
  W t_base, t_offset, offset_lo, offset_hi;
  Vec3<W> normal;

  Mask<W> is_certain() const { return hit | miss | inside; }
};

/// Converts the result of a single ray, which must not be in doubt.
[[gnu::always_inline]] inline void write_result(const Filtered<double>& answer,
                                                CastResult<double>& result) {
  result.status = answer.hit ? Status::hit : answer.miss ? Status::miss : Status::inside;
  result.path = Path::filter;
  result.t_base = answer.t_base;
  result.t_offset = answer.t_offset;
  result.offset_lo = answer.offset_lo;
  result.offset_hi = answer.offset_hi;
  result.normal = answer.normal;
}

/// Normalises a vector whose squared length neither underflows nor overflows.
template <class W>
[[gnu::always_inline]] inline Vec3<W> unit_of_ordinary(const Vec3<W>& v) {
  using std::sqrt;
  return v * (W(1) / sqrt(W(v.squaredNorm())));
}

/// Calls exact::enter, without inlining it.
template <class W>
[[gnu::noinline, gnu::cold]] exact::Entry<W> enter_rarely(const exact::Form& form,
                                                          const exact::Line<W>& line,
                                                          const Mask<W>& open) {
  return exact::enter<W>(form, line, open);
}

/// Finds where each ray enters the shape or, if `leaves`, where it leaves the shape. Results are
/// valid only in `open` lanes. `shape` is a PreparedShape, or a type with the same members in
/// lanes. The shape's definition must have a closed form.
template <bool leaves, class W, class Placed>
[[gnu::always_inline]] inline Filtered<W> filter(const Placed& shape, const Ray<W>& ray,
                                                 const Mask<W>& open) {
  using std::abs;
  using std::max;
  const exact::Form& form = shape.definition().form();
  FormLine<W> near = form_line(form, shape, ray);

  // The exit of a ray is the entry of the reversed ray.
  exact::Line<W>& line = near.line;
  if (leaves) line.d = -line.d;
  const W first = leaves ? W(-near.end) : near.begin, last = leaves ? W(-near.begin) : near.end;
  exact::Entry<W> entry = exact::enter<W>(form, line, open & near.bounded);

  // A plane that proves a miss is parallel to the line, up to rounding. Removes this rounding from
  // the plane's normal.
  if (any(entry.miss)) {
    const W towards = entry.normal.dot(line.d) * line.inv;
    entry.normal = select<W>(entry.miss, Vec3<W>(entry.normal - line.d * towards), entry.normal);
  }

  // The line's hit is a hit of the ray if the ray starts before this point and ends at or after it.
  const W slack = near.slack;
  const W lo = entry.t - entry.e - slack, hi = entry.t + entry.e + slack;
  Filtered<W> answer;
  answer.hit = entry.hit & (lo >= first) & (hi <= last);
  answer.miss = entry.miss;
  answer.inside = Mask<W>(false);
  if (any(entry.hit & !answer.hit)) {
    const W end_slack(tolerance::end_slack<double> * form.inner_R * form.largest_scale);
    const W beyond = lo - last;
    const Mask<W> is_beyond =
        (beyond > W(0)) & (Mask<W>(leaves) | (beyond * beyond * line.dd > end_slack * end_slack));
    answer.miss |= entry.hit & is_beyond;
    const Mask<W> behind = entry.hit & (hi < first);
    if (!leaves && any(behind)) {
      const exact::Line<W> back = line.reversed();
      const exact::Entry<W> exit = enter_rarely<W>(form, back, behind);
      const W margin = exit.e + slack;
      answer.inside = exit.hit & (-exit.t - margin > first);
      const Mask<W> left = exit.hit & (-exit.t + margin < first);
      answer.miss |= left;
      entry.normal = select<W>(left, exit.normal, entry.normal);
    }
  }

  // Rotates the normal from the form's frame to the ray's.
  Vec3<W> normal = entry.normal;
  if (form.is_upside_down) normal.z() = -normal.z();
  if (form.is_scaled) normal = normal.cwiseProduct(widen<W>(form.scale));
  if (const auto* map = shape.linear_to_inner()) {
    using P = std::remove_cvref_t<decltype((*map)(0, 0))>;
    normal = times<W, P>(map->transpose(), normal);
  }
  normal = unit_of_ordinary<W>(normal);
  // If the line is so far away that its squared distance overflows, the normal is zero.
  if (any(answer.miss)) answer.miss &= W(normal.squaredNorm()) > W(0);
  if (any(answer.inside)) normal = select<W>(answer.inside, Vec3<W>::Zero(), normal);
  answer.normal = normal;

  answer.t_base = answer.t_offset = answer.offset_lo = answer.offset_hi = W(0);
  if (!any(answer.hit)) return answer;
  answer.t_base = any(answer.inside) ? select(answer.inside, W(0), near.base) : near.base;
  const W tau = leaves ? W(-entry.t) : entry.t;
  W offset = near.shift + tau * near.per;
  W bound = entry.e * near.per * W(1 + tolerance::form_margin) +
            (abs(offset) + abs(near.shift)) * W(tolerance::form_digits);
  if (any(answer.inside)) {  // in a packet, other lanes may be hits
    offset = select(answer.inside, W(0), offset);
    bound = select(answer.inside, W(0), bound);
  }
  answer.t_offset = offset;
  answer.offset_lo = offset - bound;
  answer.offset_hi = offset + bound;
  keep_on_ray(ray, answer);
  return answer;
}

}  // namespace minkray
