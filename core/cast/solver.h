// SPDX-License-Identifier: MIT
// Solvers of a cast, as tables of its stages. For each kind of shape, a line specifies the order of
// the stages and the hits that must be proven. A stage runs only if all stages before it failed to
// converge, or gave a result that could not be proven.
#pragma once

#include <array>

#include "core/query/observer.h"
#include "core/query/ray_near_ball.h"
#include "core/query/result.h"

namespace minkray {

/// A stage of a cast; docs/rays.md explains them.
enum class Stage : unsigned char {
  none,
  filter,          ///< the closed form, in double, with an error bound (filter.h)
  bounds,          ///< the bounding box; can decide only misses
  operands,        ///< for a sum of two operands: their first contact (core/pair_motion)
  model,           ///< the hull of the features that support calls have found (core/model)
  gjk,             ///< the GJK ray cast
  support_portal,  ///< same as `model`, but treats every shape as a polytope
  finer,           ///< the GJK ray cast with more digits
  given,           ///< the solver's own algorithm
};

/// Set of hits that must be proven before they are returned, for shapes that may have corners.
enum class Proof : unsigned char {
  none,
  steep_hits,  ///< only hits whose supporting plane is nearly parallel to the ray
  all,
};

/// Set of kinds of shapes, one bit each. Each shape has exactly one kind.
using ShapeKinds = unsigned;
namespace shape_kind {
inline constexpr ShapeKinds with_form = 1;   ///< has a closed form
inline constexpr ShapeKinds with_model = 2;  ///< has no closed form, but an exact model
inline constexpr ShapeKinds osculated = 4;   ///< no closed form, only an approximate model
inline constexpr ShapeKinds extreme = 8;     ///< extreme proportions (core/derived/proportions.h)
inline constexpr ShapeKinds ordinary = with_form | with_model | osculated;
inline constexpr ShapeKinds every = ordinary | extreme;
}  // namespace shape_kind

/// One line of a table.
struct Policy {
  ShapeKinds shapes = 0;
  Proof proof = Proof::none;
  std::array<Stage, 6> stages = {};  ///< in order, up to the first `none`
};

struct Shape;
template <class T>
struct GjkCastOptions;

/// Casts in the shape's inner frame, as gjk_ray_cast does. The observer may be empty.
using GivenCast = CastResult<double> (*)(const Shape& shape, const RayNearBall<double>& near,
                                         const Ball<double>& ball,
                                         const GjkCastOptions<double>& options,
                                         const CastObserver& observer);

/// A solver is chosen by the address of its table.
struct Solver {
  std::array<Policy, 4> policies;
  GivenCast given = nullptr;  ///< for Stage::given

  /// Returns the table's line for a kind of shape.
  constexpr const Policy& policy_of(ShapeKinds shape) const {
    for (const Policy& policy : policies)
      if (policy.shapes & shape) return policy;
    return policies.front();
  }
};

namespace solver {

using enum Stage;
using shape_kind::extreme, shape_kind::ordinary, shape_kind::osculated, shape_kind::with_form,
    shape_kind::with_model;
inline constexpr auto steep = Proof::steep_hits;

/// The best stages for each shape.
inline constexpr Solver automatic = {{{
    {with_form, steep, {filter, bounds, model, gjk, support_portal, finer}},
    {with_model, steep, {bounds, operands, model, gjk, support_portal, finer}},
    {osculated, steep, {gjk, model, support_portal, finer}},
    {extreme, Proof::all, {model, gjk, finer}},
}}};
/// Models of a few osculating ellipsoids.
inline constexpr Solver jet = {{{
    {ordinary, steep, {bounds, model, gjk, support_portal, finer}},
    {extreme, Proof::all, {model, gjk, finer}},
}}};
/// Portals of support points.
inline constexpr Solver portal = {{{
    {ordinary, steep, {bounds, support_portal, gjk}},
    {extreme, Proof::all, {support_portal, gjk}},
}}};
/// The GJK ray cast alone.
inline constexpr Solver gjk_alone = {{{
    {ordinary, steep, {gjk}},
    {extreme, Proof::all, {gjk}},
}}};

}  // namespace solver
}  // namespace minkray
