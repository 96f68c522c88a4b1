// SPDX-License-Identifier: MIT
// Compares results that claim an error bound with school geometry in more digits.
#pragma once

#include "core/cast/prepared_shape.h"
#include "core/query/result.h"
#include "tests/oracle/closed_form.h"
#include "tests/oracle/quad.h"

namespace minkray::testing {

struct FilterVerdict {
  bool is_false = false;      ///< a hit, miss or inside that is none
  double error_by_bound = 0;  ///< of hits; at most 1 if the bound holds
};

/// Judges a shape as it was prepared, whose numbers are taken as exact. `line_in(at, along)` is the
/// interval of a line in the inner shape. The ray is moved near in 113 bits, the rest is in long
/// double. `leaves`: the answer is cast_exit's.
template <class LineIn>
inline FilterVerdict judge_bound_by(const LineIn& line_in, const PreparedShape& prepared,
                                    const Ray<double>& ray, const CastResult<double>& answer,
                                    bool leaves = false) {
  const TwoFoldVec3<double>& centre = prepared.two_fold_centre();
  QuadVec o = quad(ray.origin) - quad(centre.high) - quad(centre.low), d = quad(ray.direction);
  if (const Mat3<double>* map = prepared.linear_to_inner()) {
    o = map->cast<Quad>() * o;
    d = map->cast<Quad>() * d;
  }
  const Quad base =
      answer.status == Status::hit ? Quad(answer.t_base) : -o.dot(d) / d.squaredNorm();
  const Vec3<Long> along = d.cast<Long>(),
                   at = (o + base * d + quad(prepared.inner_ball().centre)).cast<Long>();
  const Interval inside = line_in(at, along);
  const Quad begin = -base, end = Quad(ray.t_max) - base;
  const bool meets = !inside.empty() && Quad(inside.upper) >= begin && Quad(inside.lower) <= end;
  FilterVerdict verdict;
  if (answer.status == Status::miss) {
    verdict.is_false = meets;
  } else if (answer.status == Status::inside) {
    verdict.is_false =
        !(meets && Quad(leaves ? -inside.upper : inside.lower) <= (leaves ? -end : begin));
  } else if (answer.status == Status::hit) {
    const Long truth = leaves ? inside.upper : inside.lower;
    verdict.is_false = !(meets && Quad(truth) >= begin && Quad(truth) <= end);
    const Long error = truth - Long(answer.t_offset);
    const Long bound = error > 0 ? Long(answer.offset_hi) - Long(answer.t_offset)
                                 : Long(answer.t_offset) - Long(answer.offset_lo);
    verdict.error_by_bound = error == 0 ? 0 : static_cast<double>(std::abs(error) / bound);
  }
  return verdict;
}

/// line_in_shape must know the inner shape.
inline FilterVerdict judge_bound(const Shape& inner, const PreparedShape& prepared,
                                 const Ray<double>& ray, const CastResult<double>& answer,
                                 bool leaves = false) {
  const auto line_in = [&](const Vec3<Long>& at, const Vec3<Long>& along) {
    return *line_in_shape(inner, at, along);
  };
  return judge_bound_by(line_in, prepared, ray, answer, leaves);
}

}  // namespace minkray::testing
