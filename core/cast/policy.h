// SPDX-License-Identifier: MIT
// Table of the stages of a cast. For each solver and kind of shape, a line specifies the order of
// the stages and the hits that must be proven. A stage runs only if all stages before it failed to
// converge, or gave a result that could not be proven.
#pragma once

#include <array>

#include "core/query/solver_kind.h"

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
  johnson,         ///< the GJK ray cast with Johnson's subalgorithm
  signed_volumes,  ///< the GJK ray cast with signed volumes
  algorithm_1,     ///< Algorithm 1 of van den Bergen (2004), a slow reference
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

/// One line of the table.
struct Policy {
  SolverKind solver;
  ShapeKinds shapes;
  Proof proof;
  std::array<Stage, 6> stages;  ///< in order, up to the first `none`
};

namespace policy_rows {

using enum Stage;
using shape_kind::every, shape_kind::extreme, shape_kind::ordinary;
using shape_kind::osculated, shape_kind::with_form, shape_kind::with_model;
using Kind = SolverKind;
inline constexpr auto never = Proof::none;
inline constexpr auto steep = Proof::steep_hits;
inline constexpr auto always = Proof::all;

inline constexpr std::array policies = {
    Policy{Kind::automatic, with_form, steep, {filter, bounds, model, gjk, support_portal, finer}},
    Policy{
        Kind::automatic, with_model, steep, {bounds, operands, model, gjk, support_portal, finer}},
    Policy{Kind::automatic, osculated, steep, {gjk, model, support_portal, finer}},
    Policy{Kind::automatic, extreme, always, {model, gjk, finer}},
    Policy{Kind::jet, ordinary, steep, {bounds, model, gjk, support_portal, finer}},
    Policy{Kind::jet, extreme, always, {model, gjk, finer}},
    Policy{Kind::portal, ordinary, steep, {bounds, support_portal, gjk}},
    Policy{Kind::portal, extreme, always, {support_portal, gjk}},
    Policy{Kind::paper, ordinary, steep, {gjk}},
    Policy{Kind::paper, extreme, always, {gjk}},
    Policy{Kind::paper_johnson, every, never, {johnson}},
    Policy{Kind::paper_signed_volumes, every, never, {signed_volumes}},
    Policy{Kind::first_solution, every, never, {algorithm_1}},
};

}  // namespace policy_rows

/// Returns the table's line for a solver and the kind of a shape.
constexpr const Policy& policy_of(SolverKind solver, ShapeKinds shape) {
  for (const Policy& policy : policy_rows::policies)
    if (policy.solver == solver && (policy.shapes & shape)) return policy;
  return policy_rows::policies.front();
}

}  // namespace minkray
