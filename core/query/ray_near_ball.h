// SPDX-License-Identifier: MIT
// A ray relative to a shape's centre. The ray's parameter is stored as a sum of two parts: the
// parameter of the point closest to the centre, and the rest. Precision then does not depend on the
// distance of the ray's origin.
#pragma once

#include "core/math/bounds.h"
#include "core/math/instruction_set.h"
#include "core/math/ray.h"
#include "core/math/two_fold.h"
#include "core/query/tolerances.h"

namespace minkray {

/// The points centre + s + lambda * r with lambda_min <= lambda <= lambda_max. lambda is a length,
/// r has unit length (or is zero for a ray without direction), and centre + s is the ray's point
/// closest to the centre.
template <class W>
struct RayNearBall {
  Vec3<W> s;
  Vec3<W> r;
  W lambda_min;  ///< position of the ray's origin
  W lambda_max;  ///< position of the ray's end
  W t_base;      ///< the ray's own parameter at s is t_base + t_shift
  W t_shift;
  W t_per_length;  ///< change of the ray's own parameter per unit of lambda
  /// Error bound of the ray's points near the shape, a length. Covers the uncertainty of the
  /// shape's pose and map, but not the rounding of the shape's own points.
  W loss = W(0);

  /// The ray's own parameter at lambda, minus t_base.
  W t_offset(W lambda) const { return t_shift + lambda * t_per_length; }
  /// Rounding error of an offset: the sum of the errors of the offset's two parts, of their sum,
  /// and of the length.
  W offset_rounding(W offset) const {
    using std::abs;
    return (abs(t_shift) + abs(offset)) * W(tolerance::offset_rounding<Lane<W>>);
  }

  /// True if s lost digits, relative to a shape of radius R, since the ray's origin is far away.
  /// The ray was moved near the shape in two steps (ray_near). The error of the first step grows
  /// with the distance, and the second step can correct only a small error.
  Mask<W> is_from_afar(Lane<W> R) const {
    using std::abs;
    return (abs(lambda_min) > W(tolerance::far_origin<Lane<W>> * R)) & (W(R) > W(0));
  }

  /// Returns the ray in the opposite direction.
  RayNearBall reversed() const {
    return {s, -r, -lambda_max, -lambda_min, t_base, t_shift, -t_per_length, loss};
  }

  /// Maps the ray by a linear map that takes the old centre to the new one. Keeps the parameters.
  RayNearBall mapped(const Mat3<Lane<W>>& linear) const { return mapped_by(linear); }
  /// Same, with one map per lane.
  RayNearBall mapped(const Mat3<W>& linear) const requires(LaneOf<W>::count > 1) {
    return mapped_by(linear);
  }

  /// Same as `mapped`, and adds to `loss` the error that one rounding of the map's numbers causes
  /// at a ball of radius R around the new centre.
  RayNearBall mapped_with_loss(const Mat3<Lane<W>>& linear, Lane<W> R) const {
    using std::abs;
    W length, correction;
    RayNearBall image = mapped_by(linear, length, correction);
    const W along = (abs(correction) + W(R)) / length;
    const Vec3<W> reach(abs(s.x()) + abs(r.x()) * along, abs(s.y()) + abs(r.y()) * along,
                        abs(s.z()) + abs(r.z()) * along);
    const Mat3<Lane<W>> sizes = linear.cwiseAbs();
    image.loss = times(sizes, reach).norm() * W(tolerance::map_rounding<Lane<W>>);
    return image;
  }

 private:
  template <class M>
  RayNearBall mapped_by(const Mat3<M>& linear) const {
    W length, correction;
    return mapped_by(linear, length, correction);
  }

  /// Also returns the new length of r, and the shift of the closest approach along r.
  template <class M>
  [[gnu::always_inline]] RayNearBall mapped_by(const Mat3<M>& linear, W& safe_length,
                                               W& correction) const {
    const Vec3<W> direction = times(linear, r);
    RayNearBall image = *this;
    image.s = times(linear, s);
    image.r = unit(direction);
    const W length = image.r.dot(direction);
    const Mask<W> has_direction = length > W(0);
    safe_length = select(has_direction, length, W(1));
    correction = -image.s.dot(image.r);
    image.s += correction * image.r;
    image.t_per_length = t_per_length / safe_length;
    image.t_shift = t_shift + correction * image.t_per_length;
    image.lambda_min = lambda_min * safe_length - correction;
    image.lambda_max = lambda_max * safe_length - correction;
    return image;
  }
};

namespace detail {

template <class Centre>
inline constexpr bool is_two_fold = false;
template <class C>
inline constexpr bool is_two_fold<TwoFoldVec3<C>> = true;

/// Returns point - centre with twice the digits.
template <class W, class C>
[[gnu::always_inline]] inline TwoFoldVec3<W> way_from(const TwoFoldVec3<C>& centre,
                                                      const Vec3<W>& point) {
  TwoFoldVec3<W> way = exact_difference<W>(point, widen<W>(centre.high));
  way.low -= widen<W>(centre.low);
  return way;
}

/// Implements ray_near() below, for one centre for all lanes, or one per lane. If the centre is
/// two-fold (has twice the digits), the ray keeps all digits relative to the centre. Otherwise it
/// is as precise as the coordinates of points near the centre.
template <class W, class Centre>
[[gnu::always_inline]] inline RayNearBall<W> ray_near_here(const Centre& centre_of_ball,
                                                           const Ray<W>& ray) {
  using std::abs;
  using std::fma;
  using std::max;
  using std::sqrt;
  using T = Lane<W>;

  // Powers of two keep the scaled direction exact, and its square in range. Subnormal directions
  // need two factors.
  constexpr T up = std::is_same_v<T, float> ? T(0x1p100) : T(0x1p900);
  const W longest =
      max(abs(ray.direction.x()), max(abs(ray.direction.y()), abs(ray.direction.z())));
  const Mask<W> has_direction = longest > W(0);
  const W first = select(longest < W(std::numeric_limits<T>::min()), W(up), W(1));
  const W size = select(has_direction, leading_power_of_two(W(longest * first)), W(1));
  const W second = W(1) / size;
  const Vec3<W> direction = ray.direction * first * second;

  const W squared = select(has_direction, direction.squaredNorm(), W(1));
  const W length = sqrt(squared);
  const auto along = [&](const Vec3<W>& from, const W& steps) -> Vec3<W> {
    return {fma(steps, direction.x(), from.x()), fma(steps, direction.y(), from.y()),
            fma(steps, direction.z(), from.z())};
  };
  W steps;
  Vec3<W> close;
  if constexpr (is_two_fold<Centre>) {
    const TwoFoldVec3<W> way = way_from<W>(centre_of_ball, ray.origin);
    steps = -way.high.dot(direction) / squared;
    close = along(way.high, steps) + way.low;
  } else {
    const Vec3<W> centre = widen<W>(centre_of_ball);
    steps = -(ray.origin - centre).dot(direction) / squared;
    close = along(ray.origin, steps) - centre;
  }
  const W more_steps = -close.dot(direction) / squared;
  RayNearBall<W> near;
  near.s = along(close, more_steps);
  const W per_length = W(1) / length;
  near.r = direction * per_length;
  near.t_base = steps * second * first;  // in this order, finite if the product is finite
  near.t_shift = more_steps * second * first;
  near.t_per_length = second * per_length * first;
  near.lambda_min = -steps * length - more_steps * length;
  // Relative to s, so that an end near the shape keeps its digits.
  const W left = ray.t_max * (size * (W(1) / first)) - steps - more_steps;
  near.lambda_max = select(has_direction, W(left * length), W(0));
  return near;
}

#if defined(__x86_64__)
/// Same as ray_near() below. Uses the fma instruction if the machine has one; otherwise calls a
/// function for each of the six fma. Compiled in one file only, so that compiler flags of other
/// files do not change the bits.
RayNearBall<double> ray_near_with_fma(const Vec3<double>& centre, const Ray<double>& ray);
RayNearBall<double> ray_near_with_fma(const TwoFoldVec3<double>& centre, const Ray<double>& ray);
#endif

}  // namespace detail

/// Moves the ray to its point closest to `centre`, which is a Vec3 or a TwoFoldVec3 of lanes. Takes
/// two steps, since the rounding of the first step's parameter grows with the origin's distance.
/// The rounding of s is relative to the centre's coordinates (unless the centre is two-fold) and to
/// the shape's size, not to the origin's distance: fma rounds once, and steps are along the
/// direction as given, not along a rounded unit vector.
template <class W, class Centre>
requires(std::is_same_v<Centre, Vec3<Lane<W>>> ||
         std::is_same_v<Centre, TwoFoldVec3<Lane<W>>>) RayNearBall<W> ray_near(const Centre& centre,
                                                                               const Ray<W>& ray) {
#if defined(__x86_64__)
  if constexpr (std::is_same_v<W, double>)
    if (has_avx2()) return detail::ray_near_with_fma(centre, ray);
#endif
  return detail::ray_near_here<W>(centre, ray);
}

/// Same, with one centre per lane.
template <class W>
requires(LaneOf<W>::count > 1) RayNearBall<W> ray_near(const Vec3<W>& centre, const Ray<W>& ray) {
  return detail::ray_near_here<W>(centre, ray);
}

/// Same, in long double, for one ray whose origin is further away than tolerance::far_origin.
/// Beyond tolerance::farthest_origin, even long double has too few digits.
inline RayNearBall<double> ray_near_from_afar(const TwoFoldVec3<double>& centre,
                                              const Ray<double>& ray) {
  using Finer = long double;
  const Ray<Finer> same{ray.origin.cast<Finer>(), ray.direction.cast<Finer>(), Finer(ray.t_max)};
  const TwoFoldVec3<Finer> same_centre(centre.high.cast<Finer>(), centre.low.cast<Finer>());
  const RayNearBall<Finer> fine = detail::ray_near_here<Finer>(same_centre, same);
  RayNearBall<double> near;
  near.s = fine.s.cast<double>();
  near.r = fine.r.cast<double>();
  near.lambda_min = double(fine.lambda_min);
  near.lambda_max = double(fine.lambda_max);
  near.t_base = double(fine.t_base);
  near.t_shift = double((fine.t_base - Finer(near.t_base)) + fine.t_shift);
  near.t_per_length = double(fine.t_per_length);
  return near;
}

}  // namespace minkray
