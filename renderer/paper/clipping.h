// SPDX-License-Identifier: MIT
// Interprets a ray cast as clipping, as van den Bergen later described the cast at the
// configuration space obstacle: conservative advancement by supporting planes (Mirtich and Canny,
// 1995). The iterations of any solver can be interpreted in this way.
#pragma once

#include <limits>

#include "core/query/ray_near_ball.h"

namespace minkray {

/// Clipping by the supporting plane through the support point p along n excludes a part of the ray:
///   1. n.r < 0: the part before lambda_clip, which is a lower bound of the hit;
///   2. n.r > 0: the part after lambda_clip; the entire ray if lambda_clip is below the lower
///   bound;
///   3. n.r = 0: nothing, or the entire ray if it runs in front of the plane.
/// Here r is the ray's direction, and the ray crosses the plane at lambda_clip.
enum class ClipCase : unsigned char { lower_bound = 1, upper_bound = 2, parallel = 3 };

template <class T>
struct Clip {
  ClipCase which;
  T lambda;      ///< lambda_clip; NaN in case 3
  bool rejects;  ///< no part of the ray is left
};

/// The remaining part of a ray. Parameters are those of RayNearBall: lengths from the ray's point
/// closest to the ball's centre.
template <class T>
class ClippedRay {
 public:
  explicit ClippedRay(const RayNearBall<T>& ray)
      : s_(ray.s), r_(ray.r), lower_(ray.lambda_min), upper_(ray.lambda_max) {}

  /// Bounds of the hit point's parameter, if there is a hit point.
  T lower() const { return lower_; }
  T upper() const { return upper_; }

  /// Clips by the plane with normal n (of any length) through the support point p along n, which is
  /// relative to the ball's centre.
  Clip<T> clip(const Vec3<T>& n, const Vec3<T>& p) {
    const T n_r = n.dot(r_), to_plane = n.dot(p - s_);
    if (n_r < T(0)) {
      const T lambda = to_plane / n_r;
      if (lambda > lower_) lower_ = lambda;
      return {ClipCase::lower_bound, lambda, lower_ > upper_};
    }
    if (n_r > T(0)) {
      const T lambda = to_plane / n_r;
      if (lambda < upper_) upper_ = lambda;
      return {ClipCase::upper_bound, lambda, lower_ > upper_};
    }
    return {ClipCase::parallel, std::numeric_limits<T>::quiet_NaN(), to_plane < T(0)};
  }

 private:
  Vec3<T> s_, r_;
  T lower_, upper_;
};

}  // namespace minkray
