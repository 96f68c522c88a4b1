// SPDX-License-Identifier: MIT
// Which stages a cast asks, in order, and which of their answers have to be proven: one table. A
// stage is asked if those before it gave up, or if their answers could not be proven.
#pragma once

#include <array>

#include "core/query/solver_kind.h"

namespace minkray {

/// One way to an answer; docs/rays.md tells what each of them is good for.
enum class Stage : unsigned char {
  none,
  filter,          ///< the closed form, in double, with an error bound (filter.h)
  bounds,          ///< the box of a miss
  in_double,       ///< the shape and the ray in double, which is final; rays in double go on
  model,           ///< the hull of the features that support calls have shown (core/model)
  gjk,             ///< the GJK ray cast
  support_portal,  ///< the model of a polytope, whatever the shape
  finer,           ///< the GJK ray cast with more digits
  johnson,         ///< the GJK ray cast with Johnson's subalgorithm
  signed_volumes,  ///< the GJK ray cast with signed volumes
  algorithm_1,     ///< the paper's slow reference
};

/// Which hits have to be proven before they are answered, where shapes may have corners.
enum class Proof : unsigned char {
  none,
  steep_hits,  ///< those whose plane is nearly along the ray; in float they are asked in double
  all,
};

/// Kinds of shapes, as bits: each shape is of one kind.
using ShapeKinds = unsigned;
namespace shape_kind {
inline constexpr ShapeKinds with_form = 1;   ///< it declares a closed form
inline constexpr ShapeKinds with_model = 2;  ///< it has none, but a model that is exact
inline constexpr ShapeKinds osculated = 4;   ///< its model only osculates it
inline constexpr ShapeKinds extreme = 8;     ///< its proportions are (core/derived/proportions.h)
inline constexpr ShapeKinds lost = 16;       ///< a needle of points thinner than float's rounding
inline constexpr ShapeKinds ordinary = with_form | with_model | osculated | lost;
inline constexpr ShapeKinds every = ordinary | extreme;
}  // namespace shape_kind

struct Policy {
  SolverKind solver;
  ShapeKinds shapes;
  Proof proof;
  std::array<Stage, 7> stages;  ///< up to the first `none`
};

namespace policy_rows {

using enum Stage;
using shape_kind::every, shape_kind::extreme, shape_kind::lost, shape_kind::ordinary;
using shape_kind::osculated, shape_kind::with_form, shape_kind::with_model;
using Kind = SolverKind;
inline constexpr auto never = Proof::none;
inline constexpr auto steep = Proof::steep_hits;
inline constexpr auto always = Proof::all;

inline constexpr std::array policies = {
    Policy{Kind::automatic,
           with_form,
           steep,
           {filter, in_double, bounds, model, gjk, support_portal, finer}},
    // Flat slivers in float are asked in double: their models lose as many digits as they are thin.
    Policy{
        Kind::automatic, with_model, steep, {in_double, bounds, model, gjk, support_portal, finer}},
    Policy{Kind::automatic, osculated, steep, {gjk, model, support_portal, finer}},
    Policy{Kind::automatic, lost, steep, {gjk, support_portal, finer}},
    Policy{Kind::automatic, extreme, always, {in_double, model, gjk, finer}},
    // Hulls of two features need digits: their models are asked in double.
    Policy{Kind::jet, with_form, steep, {in_double, bounds, model, gjk, support_portal, finer}},
    Policy{Kind::jet, ordinary, steep, {in_double, bounds, model, gjk, support_portal, finer}},
    Policy{Kind::jet, extreme, always, {in_double, model, gjk, finer}},
    Policy{Kind::portal, ordinary, steep, {bounds, support_portal, gjk}},
    Policy{Kind::portal, extreme, always, {in_double, support_portal, gjk}},
    Policy{Kind::paper, ordinary, steep, {gjk}},
    Policy{Kind::paper, extreme, always, {in_double, gjk}},
    Policy{Kind::paper_johnson, every, never, {johnson}},
    Policy{Kind::paper_signed_volumes, every, never, {signed_volumes}},
    Policy{Kind::first_solution, every, never, {algorithm_1}},
};

}  // namespace policy_rows

/// The row of the table for a solver and a shape.
constexpr const Policy& policy_of(SolverKind solver, ShapeKinds shape) {
  for (const Policy& policy : policy_rows::policies)
    if (policy.solver == solver && (policy.shapes & shape)) return policy;
  return policy_rows::policies.front();
}

}  // namespace minkray
