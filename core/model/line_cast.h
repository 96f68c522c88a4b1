// SPDX-License-Identifier: MIT
// The loop of all solvers on jets (docs/forms.md). A supporting plane in direction n gives a
// rigorous lower bound of the hit. The hit on a model (the hull of the features found so far) is an
// upper bound, which is only approximate if the features are not parts of the shape; its normal is
// the next n. The search ends when both meet. W is a number or a packet, one ray per lane; finished
// lanes have no effect.
#pragma once

#include "core/query/observer.h"
#include "core/query/ray_near_ball.h"
#include "core/query/tolerances.h"

namespace minkray {

/// Hit of a line with a model.
template <class W>
struct ModelHit {
  Vec3<W> m = Vec3<W>::Zero();       ///< unit normal; zero or not finite if none was found
  W height = W(0);                   ///< the line enters the model at lambda = -height
  Mask<W> certain = Mask<W>(false);  ///< `height` is that of the model's hit, up to rounding
  /// The carriers of the hit are parts of the shape: the hit is an upper bound of the shape's hit.
  Mask<W> inner = Mask<W>(true);
  Mask<W> repeated = Mask<W>(false);  ///< the newest feature was found before
};

/// First hit of the whole line s + lambda r with the shape.
template <class W>
struct LineHit {
  Mask<W> hit = Mask<W>(false);
  Mask<W> miss = Mask<W>(false);  ///< a lane with neither `hit` nor `miss` is exhausted
  /// Exhausted since the line is tangent to the shape within rounding; `normal` is that of the
  /// tangent plane.
  Mask<W> tangent = Mask<W>(false);
  W lambda = W(-std::numeric_limits<Lane<W>>::infinity());       ///< rigorous lower bound
  W lambda_above = W(std::numeric_limits<Lane<W>>::infinity());  ///< the model's hit
  Vec3<W> normal = Vec3<W>::Zero();
  W supports = W(0);  ///< number of support calls
};

/// Selects a where the condition is true, else b, lane by lane.
template <class W>
LineHit<W> pick(const Mask<W>& condition, const LineHit<W>& a, const LineHit<W>& b) {
  const Mask<W> other = !condition;
  return {Mask<W>((condition & a.hit) | (other & b.hit)),
          Mask<W>((condition & a.miss) | (other & b.miss)),
          Mask<W>((condition & a.tangent) | (other & b.tangent)),
          select(condition, a.lambda, b.lambda),
          select(condition, a.lambda_above, b.lambda_above),
          select<W>(condition, a.normal, b.normal),
          select(condition, a.supports, b.supports)};
}

/// Finds the first hit of a line with a shape by a model of the shape. A model may compute in its
/// own frame. All vectors here are in that frame, except the result's normal, which is in the
/// shape's frame. Members of a model:
/// - `to_frame(n)`: converts a direction from the shape's frame to the model's; `to_shape(n)`:
/// back;
/// - `against_ray(n)`: the component of n against the ray's direction;
/// - `begin(half_extents)`: the ModelHit before the first support call: a first direction, and a
/// hit if the model already has features. half_extents are those of the shape;
/// - `support(n, wanted)`: the shape's feature in the unit direction n, relative to s, with
/// support_function(n) and support_point(n). Lanes that are not wanted may get any feature;
/// - `step(feature, n, iteration)`: adds the feature to the model and returns the model's hit.
///
/// The search ends beyond lambda_end. Rounding is relative to R. Only `open` lanes count.
/// `observer` receives each plane, unless it is NoObserver.
template <class W, class Model, class Observer>
LineHit<W> first_on_line(Model& model, const Vec3<Lane<W>>& half_extents, const W& lambda_end,
                         Lane<W> R, Mask<W> open, int max_iterations, Observer&& observer) {
  using std::abs;
  using std::max;
  using std::min;
  using T = Lane<W>;
  constexpr T infinity = std::numeric_limits<T>::infinity();
  const W gap = W(tolerance::jet_gap<T> * R), gap_along = W(tolerance::jet_gap_along<T> * R);
  const W least_slope = W(tolerance::least_slope<T>);
  LineHit<W> result;
  ModelHit<W> model_hit = model.begin(half_extents);
  Vec3<W> n = model_hit.m;
  W best_slope(0);  // slope of the plane of result.normal
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    // The supporting plane in direction n clips the line or separates it from the shape. If the
    // normal does not point against the ray, the plane separates the part of the line within the
    // bounding ball.
    const auto feature = model.support(n, open);
    result.supports += select(open, W(1), W(0));
    const W h = feature.support_function(n), z = model.against_ray(n);
    const Mask<W> ahead = z > W(0), steep = z > least_slope, beyond = h < -gap;
    // If the plane is nearly parallel to the line, only a distance clearly beyond rounding counts.
    const W clear = select(steep, h, W(h + gap));
    const W lambda =
        select(steep | (ahead & beyond), W(-clear / select(ahead, z, W(1))), W(-infinity));
    if constexpr (!std::is_same_v<std::remove_cvref_t<Observer>, NoObserver>)
      observer(lambda, model.to_shape(n), model.to_shape(feature.support_point(n)));
    const Mask<W> better = open & (lambda > result.lambda);
    result.lambda = select(better, lambda, result.lambda);
    result.normal = select<W>(better, n, result.normal);
    best_slope = select(better, z, best_slope);
    const Mask<W> misses = open & (((!ahead) & (h - z * W(R) < -gap)) | (lambda > lambda_end));
    result.normal = select<W>(misses, n, result.normal);
    result.miss |= misses;
    open &= !misses;
    if (!any(open)) break;

    // Ends the search in lanes where the model's hit is beyond the best plane by at most rounding.
    const auto meets = [&](const W& slope, const W& within) {
      const W along = select(model_hit.certain, W(-model_hit.height - result.lambda), W(0));
      const W missing = along * min(slope, max(best_slope, W(0)));
      const Mask<W> met = open & model_hit.certain & (slope > least_slope) & (missing <= within) &
                          (along <= gap_along);
      const Mask<W> contradicts = missing < W(-16) * gap;
      result.hit |= met & !contradicts;
      // If the best plane is beyond the model's hit, by rounding, the result is the model's hit,
      // which lies between points of the shape. But the model's own plane may be so nearly parallel
      // to the line that the model's error exceeds the rounding of the best plane. The result is
      // then the best plane, and the model gives the lower bound.
      const Mask<W> inner = met & model_hit.inner & !contradicts;
      const Mask<W> closer = inner & (along * best_slope >= W(-4) * gap);
      const W above = select(closer, W(-model_hit.height), result.lambda);
      result.lambda_above = select(inner, above, result.lambda_above);
      result.lambda = select(inner, min(result.lambda, W(-model_hit.height)), result.lambda);
      open &= !met;
    };
    meets(z, gap);
    if (!any(open)) break;

    // Computes the hit on the model with the new feature.
    model_hit = model.step(feature, n, iteration);
    meets(model.against_ray(model_hit.m), select(model_hit.repeated, W(W(4) * gap), gap));
    // If the line is tangent, planes along it do not determine where it touches the shape.
    const Mask<W> touches = (!steep) & model_hit.repeated & (abs(h) <= gap);
    const Mask<W> stuck = model_hit.repeated & ((model_hit.m - n).squaredNorm() == W(0));
    const Mask<W> tangent = open & touches;
    result.tangent |= tangent;
    result.normal = select<W>(tangent, n, result.normal);
    open &= model_hit.m.squaredNorm() > W(0);
    open &= !(touches | stuck);
    if (!any(open)) break;
    n = select<W>(open, model_hit.m, n);
  }
  result.normal = model.to_shape(result.normal);
  return result;
}

/// Approximates the unit normal where the line s + lambda r first meets a shape around the origin
/// with these half extents, as if it were an ellipsoid; if it passes, the normal towards the line,
/// perpendicular to r. The first direction for the support mapping. Extents that are negligible
/// compared with the largest are increased slightly.
template <class W>
Vec3<W> normal_on_extents(const Vec3<Lane<W>>& half_extents, const Vec3<W>& s, const Vec3<W>& r) {
  using std::max;
  using std::sqrt;
  using T = Lane<W>;
  constexpr T least = T(1) / T(65536);
  const Vec3<T> radii = half_extents.cwiseMax(Vec3<T>::Constant(least * half_extents.maxCoeff()));
  const Vec3<W> to_ball = widen<W>(Vec3<T>(radii.cwiseInverse()));
  const Vec3<W> r_ball = r.cwiseProduct(to_ball), s_ball = s.cwiseProduct(to_ball);
  const W a = r_ball.squaredNorm(), b = s_ball.dot(r_ball);
  const W den = b * b - a * (s_ball.squaredNorm() - W(1));
  const Vec3<W> met = s_ball - r_ball * ((b + sqrt(max(den, W(0)))) / a);
  Vec3<W> n = met.cwiseProduct(to_ball);
  const Mask<W> meets = den > W(0);
  if (!all(meets)) n = select<W>(meets, n, Vec3<W>(n - r * n.dot(r)));
  n = unit<W>(n);
  const Mask<W> some = n.squaredNorm() > W(0);
  return all(some) ? n : select<W>(some, n, Vec3<W>(-r));
}

}  // namespace minkray
