// SPDX-License-Identifier: MIT
// A ray in the frame of a shape's closed form: a line whose origin is moved near the form, and its
// error bound (docs/forms.md, "Casts with an error bound"). W is double, or a packet of doubles.
#pragma once

#include "core/cast/prepared_shape.h"
#include "core/exact/form.h"
#include "core/math/wide.h"
#include "core/query/line.h"

namespace minkray {

/// At the line's parameter tau, the ray's parameter is base + (shift + tau * per).
template <class W>
struct FormLine {
  exact::Line<W> line;
  Mask<W> bounded;  ///< lanes in which line.E is valid
  W base, shift, per;
  W begin, end;  ///< ends of the ray, as parameters of the line
  W slack;       ///< uncertainty of begin and end
};

namespace detail {

template <class W, class Placed>
[[gnu::always_inline]] inline RayNearBall<W> near_of(const Placed& shape, const Ray<W>& ray) {
  if constexpr (requires { Placed::has_fma; })
    return ray_near_here<W>(shape.centre(), ray);
  else
    return ray_near(shape.centre(), ray);
}

}  // namespace detail

/// Moves the ray's origin near the form in two steps along the ray, each rounded once. The shape is
/// a PreparedShape, or its equivalent in lanes.
template <class W, class Placed>
[[gnu::always_inline]] inline FormLine<W> form_line(const exact::Form& form, const Placed& shape,
                                                    const Ray<W>& ray) {
  using std::abs;
  using std::sqrt;
  using P = std::remove_cvref_t<decltype(shape.centre().x())>;
  RayNearBall<W> seen = detail::near_of(shape, ray);
  const Mat3<P>* map = shape.linear_to_inner();
  const P inner_R(form.inner_R), distance = sqrt(P(shape.centre().squaredNorm()));
  // The rounding of the two steps is that of positions as large as the form and its centre.
  W reach(inner_R + distance / P(4));
  Mask<W> well_mapped(true);
  if (map) {
    const P squared = map->squaredNorm(), size = sqrt(squared);
    const RayNearBall<W> mapped = seen.mapped(*map);
    // If the map shears, the steps and the direction may be much longer before the map than after.
    const W length = seen.t_per_length / mapped.t_per_length;
    const W step = (mapped.t_shift - seen.t_shift) / seen.t_per_length;
    const W across = W(form.inner_R) / length;
    const W spread = seen.s.squaredNorm() + step * step + across * across;
    const W by_map = W(size / P(2)) * sqrt(spread);
    reach = W(inner_R + size * distance / P(4)) + by_map;
    well_mapped = by_map < W(tolerance::form_worst_map * form.inner_R);
    seen = mapped;
  }
  const W E = reach * W(tolerance::form_rounding * form.largest_scale);
  FormLine<W> near;
  Vec3<W> s = seen.s, d = seen.r;
  if (form.is_off_centre) s += widen<W>(form.offset);
  if (form.is_upside_down) {
    s.z() = -s.z();
    d.z() = -d.z();
  }
  if (form.is_scaled) {
    s = s.cwiseProduct(widen<W>(form.scale));
    d = d.cwiseProduct(widen<W>(form.scale));
  }
  const W dd = d.squaredNorm(), inv = W(1) / dd;
  near.base = seen.t_base;
  near.shift = seen.t_shift;
  near.per = seen.t_per_length;
  near.begin = seen.lambda_min;
  near.end = seen.lambda_max;
  if (form.is_scaled || form.is_off_centre) {
    const W k = -s.dot(d) * inv;
    s += d * k;
    near.shift += k * near.per;
    near.begin -= k;
    near.end -= k;
  }
  near.line = {s, d, dd, inv, E, W(tolerance::form_parallel) * dd};
  near.bounded = well_mapped & (abs(seen.lambda_min) <= W(tolerance::form_far * form.inner_R)) &
                 (dd > W(0)) & (seen.t_per_length > W(1 / tolerance::form_longest_step)) &
                 (seen.t_per_length < W(tolerance::form_longest_step));
  near.slack = W(8 * std::numeric_limits<double>::epsilon()) * (abs(near.begin) + W(form.inner_R));
  return near;
}

}  // namespace minkray
