// SPDX-License-Identifier: MIT
// Converts queries and results of casts to another number type, to repeat casts with more digits.
#pragma once

#include "core/query/ray_near_ball.h"
#include "core/query/result.h"

namespace minkray {

template <class To, class From>
RayNearBall<To> in_precision(const RayNearBall<From>& near) {
  return {near.s.template cast<To>(),
          near.r.template cast<To>(),
          To(near.lambda_min),
          To(near.lambda_max),
          To(near.t_base),
          To(near.t_shift),
          To(near.t_per_length),
          To(near.loss)};
}

template <class To, class From>
Ball<To> in_precision(const Ball<From>& ball) {
  return {ball.centre.template cast<To>(), To(ball.radius)};
}

template <class To, class From>
CastResult<To> in_precision(const CastResult<From>& found) {
  return {found.status,
          found.path,
          To(found.t_base),
          To(found.t_offset),
          To(found.offset_lo),
          To(found.offset_hi),
          found.normal.template cast<To>(),
          found.iterations,
          found.supports};
}

}  // namespace minkray
