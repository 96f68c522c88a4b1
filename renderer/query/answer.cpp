// SPDX-License-Identifier: MIT
#include "renderer/query/answer.h"

#include "core/math/outward_sum.h"
#include "core/pair_distance/manifold.h"
#include "core/pair_distance/signed_distance.h"
#include "core/pair_motion/impact.h"
#include "renderer/json/number_json.h"
#include "renderer/query/trace.h"
#include "renderer/shape_cast/distance.h"
#include "renderer/shape_cast/rotating_cast.h"
#include "renderer/shape_cast/shape_cast.h"

namespace minkray {
namespace {

/// The keys that every cast's answer has.
void add_cast(Answer& answer, const CastResult<double>& result) {
  answer.facts.status = name_of(result.status);
  answer.facts.hit = result.found();
  answer.facts.t = result.t();
  answer.json["status"] = answer.facts.status;
  if (result.status != Status::miss) {
    answer.json["t"] = number_json(answer.facts.t);
    answer.json["t_lo"] = number_json(sum_or_less(result.t_base, result.offset_lo));
    answer.json["t_hi"] = number_json(sum_or_more(result.t_base, result.offset_hi));
  }
  if (!result.normal.isZero(0)) {
    answer.facts.normal = result.normal;
    answer.json["normal"] = point_json(result.normal);
  }
}

void add_costs(Answer& answer, int iterations, int supports) {
  answer.json["iterations"] = iterations;
  answer.json["supports"] = supports;
}

/// Proves the answer, and reports the margins: docs/certificates.md.
void add_certificate(Answer& answer, const Shape& shape, const Ray<double>& ray,
                     const CastResult<double>& result) {
  const SupportFunction support = supports_of(shape);
  const Claim claim = claim_of(result);
  const CertificateVerdict verdict =
      check_certificate(support, ray, claim, certify(support, ray, claim));
  answer.verdict = verdict;
  Json json = {{"holds", verdict.holds}};
  if (!verdict.holds) json["complaint"] = verdict.complaint;
  if (result.status == Status::hit) {
    json["t_lo"] = number_json(verdict.t_lo());
    json["t_hi"] = number_json(verdict.t_hi());
    json["gap"] = number_json(verdict.gap);
  }
  if (result.found()) json["lateral"] = number_json(verdict.lateral);
  if (result.status == Status::miss) json["margin"] = number_json(verdict.margin);
  json["allowed"] = number_json(verdict.allowed);
  answer.json["certified"] = std::move(json);
}

CastOptions cast_options(const AnswerOptions& options) {
  CastOptions cast;
  cast.solver = options.solver;
  return cast;
}

void solve(const RayQuery& query, const AnswerOptions& options, Answer& answer) {
  const PreparedShape shape(query.shape);
  const Ray<double>& ray = query.ray;
  CastTrace trace;
  if (options.trace)
    trace = trace_ray(shape, ray, cast_options(options));
  else
    trace.result = cast_ray(shape, ray, cast_options(options));
  const CastResult<double>& result = trace.result;
  add_cast(answer, result);
  if (result.found()) {
    // From far away the terms are much larger than their sum: the product is not rounded.
    using Long = long double;
    Vec3<double> point;
    for (int axis = 0; axis < 3; ++axis) {
      const Long direction = ray.direction[axis];
      const Long near = std::fma(Long(result.t_base), direction, Long(ray.origin[axis]));
      point[axis] = static_cast<double>(std::fma(Long(result.t_offset), direction, near));
    }
    answer.json["point"] = point_json(point);
  }
  add_costs(answer, result.iterations, result.supports);
  if (options.certify) add_certificate(answer, query.shape, ray, result);
  if (options.trace) answer.json["trace"] = trace_json(trace);
}

void solve_turning(const ShapeQuery& query, const AnswerOptions& options, Answer& answer) {
  const auto body = [](const Shape& shape, const Vec3<double>& velocity, const Vec3<double>& turn) {
    return MovingBody{shape, {}, velocity, turn};
  };
  const RotatingCastResult result =
      cast_rotating(body(query.obstacle, query.obstacle_direction, query.obstacle_turn),
                    body(query.moving, query.direction, query.turn), query.t_max, query.steps,
                    cast_options(options));
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
  const PreparedPair pair(centred(query.obstacle), centred(query.moving));
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
  const DistanceResult<double, 3> result =
      distance_between(centred(query.a), centred(query.b), {}, options.subalgorithm, observer);
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

/// Null where nothing is known.
Json value_json(const SignedDistance& distance) {
  return distance.is_unknown() ? Json() : Json(number_json(distance.value));
}

void solve(const SignedDistanceQuery& query, const AnswerOptions& options, Answer& answer) {
  SignedDistanceOptions how;
  how.tolerance = options.tolerance;
  how.at_most = query.at_most;
  how.only_sign = query.only_sign;
  const SignedDistance result = signed_distance(ContactShape(query.a), ContactShape(query.b), how);
  answer.signed_distance = result;
  answer.facts.status = name_of(result.status);
  answer.facts.hit = result.status == SignedStatus::overlapping;
  answer.facts.distance = result.value;
  answer.json["status"] = answer.facts.status;
  answer.json["value"] = value_json(result);
  answer.json["lower"] = number_json(result.lower);
  answer.json["upper"] = number_json(result.upper);
  if (!result.normal.isZero(0)) {
    answer.facts.normal = result.normal;
    answer.json["normal"] = point_json(result.normal);
  }
  if (std::isfinite(result.upper)) {
    answer.json["point_a"] = point_json(result.point_a);
    answer.json["point_b"] = point_json(result.point_b);
  }
  answer.json["supports"] = result.supports;
  if (result.is_exhausted) answer.json["settled"] = false;
}

void solve(const ManifoldQuery& query, const AnswerOptions& options, Answer& answer) {
  const ContactShape a(query.a), b(query.b);
  SignedDistanceOptions how;
  how.tolerance = options.tolerance;
  const SignedDistance nearest = signed_distance(a, b, how);
  ManifoldOptions manifold;
  manifold.tilt = query.tilt.value_or(manifold.tilt);
  manifold.within = query.within.value_or(manifold.within);
  const ContactManifold found = contact_manifold(a, {}, b, {}, nearest, manifold);
  answer.facts.status = name_of(nearest.status);
  answer.facts.hit = nearest.status == SignedStatus::overlapping;
  answer.facts.distance = nearest.value;
  answer.facts.normal = found.normal;
  answer.json["status"] = answer.facts.status;
  answer.json["value"] = value_json(nearest);
  answer.json["normal"] = point_json(found.normal);
  Json points = Json::array();
  for (int i = 0; i < found.count; ++i) {
    const ContactPoint& point = found.points[static_cast<std::size_t>(i)];
    points.push_back({{"point_a", point_json(point.point_a)},
                      {"point_b", point_json(point.point_b)},
                      {"distance", number_json(point.distance)}});
  }
  answer.json["points"] = std::move(points);
}

/// The shape in a frame about its pivot, and that frame's motion.
std::pair<ContactShape, RigidMotion> body_of(const Shape& shape, const ImpactMotion& motion) {
  return {ContactShape(shape, {Mat3<double>::Identity(), -motion.pivot}),
          RigidMotion{{Mat3<double>::Identity(), motion.pivot}, motion.velocity, motion.turn}};
}

void solve(const ImpactQuery& query, const AnswerOptions&, Answer& answer) {
  const auto [a, motion_a] = body_of(query.a, query.motion_a);
  const auto [b, motion_b] = body_of(query.b, query.motion_b);
  const Impact result = first_impact(a, motion_a, b, motion_b, query.t_max);
  answer.facts.status = name_of(result.status);
  answer.facts.hit = result.status == ImpactStatus::hit || result.status == ImpactStatus::inside;
  answer.facts.t = result.t_lo;
  answer.json["status"] = answer.facts.status;
  answer.json["t_lo"] = number_json(result.t_lo);
  answer.json["t_hi"] = answer.facts.hit ? Json(number_json(result.t_hi)) : Json();
  answer.facts.normal = result.normal;
  answer.json["normal"] = point_json(result.normal);
  if (std::isfinite(result.distance)) {  // the distance is known
    answer.json["distance"] = number_json(result.distance);
    answer.json["point_a"] = point_json(result.point_a);
    answer.json["point_b"] = point_json(result.point_b);
  }
  answer.json["steps"] = result.steps;
}

}  // namespace

Answer answer(const Query& query, const AnswerOptions& options) {
  Answer result;
  if (!query.name.empty()) result.json["name"] = query.name;
  std::visit([&](const auto& kind) { solve(kind, options, result); }, query.kind);
  return result;
}

}  // namespace minkray
