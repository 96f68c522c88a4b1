// SPDX-License-Identifier: MIT
// A ray in the frame of a shape's closed form: a line in double whose origin is moved near the
// form, and its error bound (docs/forms.md, "Casts with an error bound"). F is float or double, or
// a packet of them; W is the same in double. Float rays are moved in one step without fused
// operations: their products are exact in double, so results are bit-identical on all machines.
// Double rays are moved in ray_near's two steps.
#pragma once

#include "core/cast/prepared_shape.h"
#include "core/exact/form.h"
#include "core/math/wide.h"
#include "core/query/line.h"

namespace minkray {

namespace detail {
template <class F>
struct WorkOf {
  using type = double;
};
template <class T, int N, class Isa>
struct WorkOf<Wide<T, N, Isa>> {
  using type = Wide<double, N, Isa>;
};
}  // namespace detail

/// Number type that closed forms work with, for rays of F.
template <class F>
using Work = typename detail::WorkOf<F>::type;

template <class To, class F>
auto convert(const F& x) {
  if constexpr (std::is_arithmetic_v<F>)
    return static_cast<To>(x);
  else
    return convert_lanes<To>(x);
}

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

/// Numbers of a pose in double: one pose for all lanes, or one per lane.
template <class P>
[[gnu::always_inline]] inline Vec3<Work<P>> wider(const Vec3<P>& v) {
  return {convert<double>(v.x()), convert<double>(v.y()), convert<double>(v.z())};
}
template <class P>
[[gnu::always_inline]] inline Mat3<Work<P>> wider(const Mat3<P>& m) {
  if constexpr (std::is_arithmetic_v<P>) {
    return m.template cast<double>();
  } else {
    Mat3<Work<P>> wide;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) wide(i, j) = convert<double>(m(i, j));
    return wide;
  }
}

/// Sum of the squares of all entries: bounds how much the map lengthens vectors.
template <class P>
[[gnu::always_inline]] inline Work<P> squared_size(const Mat3<P>& m) {
  return wider(m).squaredNorm();
}

template <class W>
[[gnu::always_inline]] inline void assign(Vec3<W>& to, const Vec3<W>& from) {
  to.x() = from.x();
  to.y() = from.y();
  to.z() = from.z();
}

/// Moves the ray in one step, in numbers with twice the digits.
template <class F, class W, class Placed>
[[gnu::always_inline]] inline FormLine<W> line_in_wider(const exact::Form& form,
                                                        const Placed& shape, const Ray<F>& ray) {
  auto centre = wider(shape.centre());
  if constexpr (requires { shape.two_fold_centre(); }) centre += wider(shape.two_fold_centre().low);
  Vec3<W> p = wider(ray.origin) - widen<W>(centre), d = wider(ray.direction);
  const W far(tolerance::form_far * tolerance::form_far * form.R * form.R);
  // Error of the mapped origin and direction, with an error in the last digit of each product of
  // the map.
  W spread(0), spread_per(0);
  if (const auto* map = shape.linear_to_inner()) {
    const auto squared = squared_size(*map);
    const W size(squared * decltype(squared)(form.largest_scale) *
                 decltype(squared)(form.largest_scale));
    spread = size * p.squaredNorm();
    spread_per = size * d.squaredNorm();
    const auto to_inner = wider(*map);
    p = times(to_inner, p);
    d = times(to_inner, d);
  }
  if (form.is_off_centre) p += widen<W>(form.offset);
  if (form.is_upside_down) {
    p.z() = -p.z();
    d.z() = -d.z();
  }
  if (form.is_scaled) {
    p = p.cwiseProduct(widen<W>(form.scale));
    d = d.cwiseProduct(widen<W>(form.scale));
  }
  FormLine<W> near;
  const W dd = d.squaredNorm(), inv = W(1) / dd, k = -p.dot(d) * inv;
  // Component by component: reading a whole vector just after its parts were written stalls.
  near.line.s = p + d * k;
  assign(near.line.d, d);
  near.line.dd = dd;
  near.line.inv = inv;
  near.line.E = W(tolerance::form_rounding<float> * form.R);
  near.line.parallel = W(tolerance::form_parallel<float>) * dd;
  // Least squared length of directions: above it, t and its bound are normal floats for shapes of
  // ordinary size (ShapeDefinition).
  constexpr double least_square = std::numeric_limits<float>::min();
  near.bounded = (k * k * dd <= far) & (dd > W(least_square)) & (dd < W(1 / least_square));
  if (shape.linear_to_inner())
    near.bounded &= (spread <= far) & ((k * k + W(form.R * form.R) * inv) * spread_per <= far);
  near.base = k;
  near.shift = W(0);
  near.per = W(1);
  near.begin = -k;
  near.end = convert<double>(ray.t_max) - k;
  near.slack = W(0);
  return near;
}

template <class W, class Placed>
[[gnu::always_inline]] inline RayNearBall<W> near_of(const Placed& shape, const Ray<W>& ray) {
  if constexpr (requires { Placed::has_fma; })
    return ray_near_here<W>(shape.centre(), ray);
  else
    return ray_near(shape.centre(), ray);
}

/// Moves the ray in two steps, each rounded once.
template <class W, class Placed>
[[gnu::always_inline]] inline FormLine<W> line_in_two_steps(const exact::Form& form,
                                                            const Placed& shape,
                                                            const Ray<W>& ray) {
  using std::abs;
  using std::sqrt;
  using P = std::remove_cvref_t<decltype(shape.centre().x())>;
  RayNearBall<W> seen = near_of(shape, ray);
  const Mat3<P>* map = shape.linear_to_inner();
  const P inner_R(form.inner_R), distance = sqrt(P(shape.centre().squaredNorm()));
  // The two steps round as positions do that are as large as the form and its centre.
  W reach(inner_R + distance / P(4));
  Mask<W> well_mapped(true);
  if (map) {
    const P squared = squared_size(*map), size = sqrt(squared);
    const RayNearBall<W> mapped = seen.mapped(*map);
    // With shear, the steps and the direction may be much longer before the map than after.
    const W length = seen.t_per_length / mapped.t_per_length;
    const W step = (mapped.t_shift - seen.t_shift) / seen.t_per_length;
    const W across = W(form.inner_R) / length;
    const W spread = seen.s.squaredNorm() + step * step + across * across;
    const W by_map = W(size / P(2)) * sqrt(spread);
    reach = W(inner_R + size * distance / P(4)) + by_map;
    well_mapped = by_map < W(tolerance::form_worst_map * form.inner_R);
    seen = mapped;
  }
  const W E = reach * W(tolerance::form_rounding<double> * form.largest_scale);
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
  near.line = {s, d, dd, inv, E, W(tolerance::form_parallel<double>) * dd};
  near.bounded = well_mapped & (abs(seen.lambda_min) <= W(tolerance::form_far * form.inner_R)) &
                 (dd > W(0)) & (seen.t_per_length > W(1 / tolerance::form_longest_step)) &
                 (seen.t_per_length < W(tolerance::form_longest_step));
  near.slack = W(8 * std::numeric_limits<double>::epsilon()) * (abs(near.begin) + W(form.inner_R));
  return near;
}

}  // namespace detail

/// The shape is a PreparedShape, or its equivalent in lanes.
template <class F, class Placed>
[[gnu::always_inline]] inline FormLine<Work<F>> form_line(const exact::Form& form,
                                                          const Placed& shape, const Ray<F>& ray) {
  if constexpr (std::is_same_v<Lane<F>, float>)
    return detail::line_in_wider<F, Work<F>>(form, shape, ray);
  else
    return detail::line_in_two_steps<F>(form, shape, ray);
}

}  // namespace minkray
