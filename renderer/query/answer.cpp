// SPDX-License-Identifier: MIT
#include "renderer/query/answer.h"

#include "core/pair_distance/manifold.h"
#include "core/pair_distance/signed_distance.h"
#include "core/pair_motion/impact.h"
#include "renderer/json/number_json.h"
#include "renderer/paper/distance.h"
#include "renderer/paper/rotating_cast.h"
#include "renderer/paper/shape_cast.h"
#include "renderer/paper/trace.h"
#include "renderer/query/answer_json.h"
#include "renderer/query/mesh_answer.h"

namespace minkray {
namespace {

void add_costs(Answer& answer, int iterations, int supports) {
  answer.json["iterations"] = iterations;
  answer.json["supports"] = supports;
}

/// Proves the answer.
void add_certificate(Answer& answer, const Shape& shape, const Ray<double>& ray,
                     const CastResult<double>& result) {
  const SupportFunction support = supports_of(shape);
  const Claim claim = claim_of(result);
  add_verdict(answer, check_certificate(support, ray, claim, certify(support, ray, claim)),
              result.status);
}

CastOptions cast_options(const AnswerOptions& options) {
  CastOptions cast;
  cast.solver = options.solver;
  return cast;
}

void solve(const RayQuery& query, const AnswerOptions& options, Answer& answer) {
  const PreparedShape shape(query.body.shape);
  const Ray<double>& ray = query.ray;
  CastTrace trace;
  if (options.trace)
    trace = trace_ray(shape, ray, cast_options(options));
  else
    trace.result = cast_ray(shape, ray, cast_options(options));
  const CastResult<double>& result = trace.result;
  add_cast(answer, result);
  add_hit_point(answer, ray, result);
  add_costs(answer, result.iterations, result.supports);
  if (options.certify) add_certificate(answer, query.body.shape, ray, result);
  if (options.trace) answer.json["trace"] = trace_json(trace);
}

void solve_turning(const ShapeQuery& query, const AnswerOptions& options, Answer& answer) {
  const RotatingCastResult result = cast_rotating(
      query.obstacle.shape, {{}, query.obstacle_direction, query.obstacle_turn}, query.moving.shape,
      {{}, query.direction, query.turn}, query.t_max, query.steps, cast_options(options));
  const bool found = result.status == Status::hit || result.status == Status::inside;
  answer.facts.status = name_of(result.status);
  answer.facts.hit = found;
  answer.facts.t = result.t;
  answer.json["status"] = answer.facts.status;
  if (found) answer.json["t"] = number_json(result.t);
  answer.json["t_lo"] = number_json(result.t_lo);
  if (result.status == Status::miss) answer.json["proven"] = result.proven;
  answer.json["position_error"] = number_json(result.position_error);
  if (!result.normal.isZero(0)) {
    answer.facts.normal = result.normal;
    answer.json["normal"] = point_json(result.normal);
  }
  if (found) {
    answer.json["point_a"] = point_json(result.point_a);
    answer.json["point_b"] = point_json(result.point_b);
  }
  answer.json["steps"] = result.steps;
  add_costs(answer, result.iterations, result.supports);
}

void solve(const ShapeQuery& query, const AnswerOptions& options, Answer& answer) {
  if (query.turns()) return solve_turning(query, options, answer);
  const PreparedPair pair(centred(query.obstacle.shape), centred(query.moving.shape));
  const Vec3<double> of_moving = query.direction, of_obstacle = query.obstacle_direction;
  const ShapeCastResult result =
      cast_shapes(pair, of_obstacle, of_moving, query.t_max, cast_options(options));
  add_cast(answer, result.cast);
  if (result.cast.found()) {
    answer.json["point_a"] = point_json(result.point_a);
    answer.json["point_b"] = point_json(result.point_b);
  }
  add_costs(answer, result.cast.iterations, result.cast.supports);
  const Ray<double> ray{pair.b().centre - pair.a().centre, of_moving - of_obstacle, query.t_max};
  if (options.certify) {
    const Shape obstacle = MinkowskiDifference{pair.a().about_centre, pair.b().about_centre};
    add_certificate(answer, obstacle, ray, result.cast);
  }
  if (!options.trace) return;
  answer.json["trace"] = trace_json(trace_ray(pair.obstacle(), ray, cast_options(options)));
}

void solve(const DistanceQuery& query, const AnswerOptions& options, Answer& answer) {
  Json trace = Json::array();
  DistanceObserver observer;
  if (options.trace)
    observer = [&](const DistanceIteration<double, 3>& step) {
      Json simplex = Json::array();
      for (const Vec3<double>& y : step.after) simplex.push_back(point_json(y));
      trace.push_back({{"v", point_json(step.v)},
                       {"w", point_json(step.w)},
                       {"simplex", std::move(simplex)},
                       {"lower", number_json(step.lower)},
                       {"upper", number_json(step.upper)}});
    };
  const DistanceResult<double, 3> result = distance_between(
      centred(query.a.shape), centred(query.b.shape), {}, options.subalgorithm, observer);
  answer.facts.status = name_of(result.status);
  answer.facts.distance = result.distance;
  answer.json["status"] = answer.facts.status;
  answer.json["distance"] = number_json(result.distance);
  answer.json["lower"] = number_json(result.lower);
  answer.json["certificate"] = number_json(result.certificate);
  if (!result.axis.isZero(0)) answer.json["normal"] = point_json(result.axis);
  answer.json["point_a"] = point_json(result.point_a);
  answer.json["point_b"] = point_json(result.point_b);
  add_costs(answer, result.iterations, result.supports);
  if (options.trace) answer.json["trace"] = std::move(trace);
}

void solve(const SignedDistanceQuery& query, const AnswerOptions& options, Answer& answer) {
  SignedDistanceOptions how;
  how.tolerance = options.tolerance;
  how.at_most = query.at_most;
  how.only_sign = query.only_sign;
  const SignedDistance result =
      signed_distance(ContactShape(query.a.shape), ContactShape(query.b.shape), how);
  add_signed_distance(answer, result);
  answer.json["supports"] = result.supports;
  if (result.is_exhausted) answer.json["settled"] = false;
}

void solve(const ManifoldQuery& query, const AnswerOptions& options, Answer& answer) {
  const ContactShape a(query.a.shape), b(query.b.shape);
  SignedDistanceOptions how;
  how.tolerance = options.tolerance;
  const SignedDistance nearest = signed_distance(a, b, how);
  ManifoldOptions manifold;
  manifold.tilt = query.tilt.value_or(manifold.tilt);
  manifold.within = query.within.value_or(manifold.within);
  add_contacts(answer, nearest, contact_manifold(a, {}, b, {}, nearest, manifold));
}

/// The shape in a frame about its pivot, and that frame's motion.
std::pair<ContactShape, RigidMotion> body_of(const Shape& shape, const ImpactMotion& motion) {
  return {ContactShape(shape, {Mat3<double>::Identity(), -motion.pivot}),
          RigidMotion{{Mat3<double>::Identity(), motion.pivot}, motion.velocity, motion.turn}};
}

void solve(const ImpactQuery& query, const AnswerOptions&, Answer& answer) {
  const auto [a, motion_a] = body_of(query.a.shape, query.motion_a);
  const auto [b, motion_b] = body_of(query.b.shape, query.motion_b);
  add_impact(answer, first_impact(a, motion_a, b, motion_b, query.t_max));
}

}  // namespace

Answer answer(const Query& query, const AnswerOptions& options) {
  Answer result;
  if (!query.name.empty()) result.json["name"] = query.name;
  std::visit(
      [&](const auto& kind) {
        if (kind.has_mesh())
          answer_at_mesh(kind, options, result);
        else
          solve(kind, options, result);
      },
      query.kind);
  return result;
}

}  // namespace minkray
