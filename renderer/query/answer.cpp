// SPDX-License-Identifier: MIT
#include "renderer/query/answer.h"

#include "core/derived/convert.h"
#include "core/math/outward_sum.h"
#include "core/pair_distance/manifold.h"
#include "core/pair_distance/signed_distance.h"
#include "core/pair_motion/impact.h"
#include "core/shape_cast/distance.h"
#include "core/shape_cast/rotating_cast.h"
#include "core/shape_cast/shape_cast.h"
#include "renderer/json/number_json.h"
#include "renderer/query/trace.h"

namespace minkray {
namespace {

template <class T>
double sum(T base, T offset) {
  return double(base) + double(offset);
}

/// Not inlined: GCC 12 otherwise drops some roundings of a ray converted to float and back
/// (tests/support/rounded.h has the example).
template <class T, class U>
[[gnu::noinline]] Ray<T> convert_ray(const Ray<U>& ray) {
  return {ray.origin.template cast<T>(), ray.direction.template cast<T>(),
          static_cast<T>(ray.t_max)};
}

/// The keys that every cast's answer has.
template <class T>
void add_cast(Answer& answer, const CastResult<T>& result) {
  answer.facts.status = name_of(result.status);
  answer.facts.hit = result.found();
  answer.facts.t = sum(result.t_base, result.t_offset);
  answer.json["status"] = answer.facts.status;
  if (result.status != Status::miss) {
    answer.json["t"] = number_json(answer.facts.t);
    answer.json["t_lo"] = number_json(sum_or_less(double(result.t_base), double(result.offset_lo)));
    answer.json["t_hi"] = number_json(sum_or_more(double(result.t_base), double(result.offset_hi)));
  }
  if (!result.normal.isZero(T(0))) {
    answer.facts.normal = result.normal.template cast<double>();
    answer.json["normal"] = point_json(result.normal);
  }
}

template <class T>
void add_costs(Answer& answer, int iterations, int supports) {
  answer.json["iterations"] = iterations;
  answer.json["supports"] = supports;
}

/// Proves the answer, and reports the margins: docs/certificates.md.
template <class T>
void add_certificate(Answer& answer, const Shape<T>& shape, const Ray<T>& ray,
                     const CastResult<T>& result) {
  const Shape<double> same = convert<double>(shape);
  const Ray<double> same_ray = convert_ray<double>(ray);
  const SupportFunction support = supports_of(same);
  const Claim claim = claim_of(result);
  const CertificateVerdict verdict =
      check_certificate(support, same_ray, claim, certify(support, same_ray, claim));
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

template <class T>
CastOptions<T> cast_options(const AnswerOptions& options) {
  CastOptions<T> cast;
  cast.solver = options.solver;
  return cast;
}

template <class T>
void solve(const RayQuery& query, const AnswerOptions& options, Answer& answer) {
  const Shape<T> plain = convert<T>(query.shape);
  const PreparedShape<T> shape(plain);
  const Ray<T> ray = convert_ray<T>(query.ray);
  CastTrace<T> trace;
  if (options.trace)
    trace = trace_ray(shape, ray, cast_options<T>(options));
  else
    trace.result = cast_ray(shape, ray, cast_options<T>(options));
  const CastResult<T>& result = trace.result;
  add_cast(answer, result);
  if (result.found()) {
    // From far away the terms are much larger than their sum: the product is not rounded.
    using Long = long double;
    Vec3<T> point;
    for (int axis = 0; axis < 3; ++axis) {
      const Long direction = ray.direction[axis];
      const Long near = std::fma(Long(result.t_base), direction, Long(ray.origin[axis]));
      point[axis] = static_cast<T>(std::fma(Long(result.t_offset), direction, near));
    }
    answer.json["point"] = point_json(point);
  }
  add_costs<T>(answer, result.iterations, result.supports);
  if (options.certify) add_certificate(answer, plain, ray, result);
  if (options.trace) answer.json["trace"] = trace_json(trace);
}

template <class T>
void solve_turning(const ShapeQuery& query, const AnswerOptions& options, Answer& answer) {
  const auto body = [](const Shape<double>& shape, const Vec3<double>& velocity,
                       const Vec3<double>& turn) {
    return MovingBody<T>{
        convert<T>(shape), {}, velocity.template cast<T>(), turn.template cast<T>()};
  };
  const RotatingCastResult<T> result =
      cast_rotating(body(query.obstacle, query.obstacle_direction, query.obstacle_turn),
                    body(query.moving, query.direction, query.turn), static_cast<T>(query.t_max),
                    query.steps, cast_options<T>(options));
  const bool found = result.status == Status::hit || result.status == Status::inside;
  answer.facts.status = name_of(result.status);
  answer.facts.hit = found;
  answer.facts.t = double(result.t);
  answer.json["status"] = answer.facts.status;
  if (found) answer.json["t"] = number_json(result.t);
  answer.json["t_lo"] = number_json(result.t_lo);
  if (result.status == Status::miss) answer.json["proven"] = result.proven;
  answer.json["position_error"] = number_json(result.position_error);
  if (!result.normal.isZero(T(0))) {
    answer.facts.normal = result.normal.template cast<double>();
    answer.json["normal"] = point_json(result.normal);
  }
  if (found) {
    answer.json["point_a"] = point_json(result.point_a);
    answer.json["point_b"] = point_json(result.point_b);
  }
  answer.json["steps"] = result.steps;
  add_costs<T>(answer, result.iterations, result.supports);
}

template <class T>
void solve(const ShapeQuery& query, const AnswerOptions& options, Answer& answer) {
  if (query.turns()) return solve_turning<T>(query, options, answer);
  const PreparedPair<T> pair(centred(convert<T>(query.obstacle)),
                             centred(convert<T>(query.moving)));
  const Vec3<T> of_moving = query.direction.cast<T>(),
                of_obstacle = query.obstacle_direction.cast<T>();
  const ShapeCastResult<T> result = cast_shapes<T>(
      pair, of_obstacle, of_moving, static_cast<T>(query.t_max), cast_options<T>(options));
  add_cast(answer, result.cast);
  if (result.cast.found()) {
    answer.json["point_a"] = point_json(result.point_a);
    answer.json["point_b"] = point_json(result.point_b);
  }
  add_costs<T>(answer, result.cast.iterations, result.cast.supports);
  const Ray<T> ray{pair.b().centre - pair.a().centre, of_moving - of_obstacle,
                   static_cast<T>(query.t_max)};
  if (options.certify) {
    const Shape<T> obstacle = MinkowskiDifference<T>{pair.a().about_centre, pair.b().about_centre};
    add_certificate(answer, obstacle, ray, result.cast);
  }
  if (!options.trace) return;
  answer.json["trace"] = trace_json(trace_ray(pair.obstacle(), ray, cast_options<T>(options)));
}

template <class T>
void solve(const DistanceQuery& query, const AnswerOptions& options, Answer& answer) {
  Json trace = Json::array();
  DistanceObserver<T> observer;
  if (options.trace)
    observer = [&](const DistanceIteration<T, 3>& step) {
      Json simplex = Json::array();
      for (const Vec3<T>& y : step.after) simplex.push_back(point_json(y));
      trace.push_back({{"v", point_json(step.v)},
                       {"w", point_json(step.w)},
                       {"simplex", std::move(simplex)},
                       {"lower", number_json(step.lower)},
                       {"upper", number_json(step.upper)}});
    };
  const DistanceResult<T, 3> result =
      distance_between(centred(convert<T>(query.a)), centred(convert<T>(query.b)), {},
                       options.subalgorithm, observer);
  answer.facts.status = name_of(result.status);
  answer.facts.distance = double(result.distance);
  answer.json["status"] = answer.facts.status;
  answer.json["distance"] = number_json(result.distance);
  answer.json["lower"] = number_json(result.lower);
  answer.json["certificate"] = number_json(result.certificate);
  if (!result.axis.isZero(T(0))) answer.json["normal"] = point_json(result.axis);
  answer.json["point_a"] = point_json(result.point_a);
  answer.json["point_b"] = point_json(result.point_b);
  add_costs<T>(answer, result.iterations, result.supports);
  if (options.trace) answer.json["trace"] = std::move(trace);
}

/// A length in the requested precision; bounds are rounded outward.
template <class T>
Json bound_json(double value, T outward) {
  T rounded = static_cast<T>(value);
  if ((outward < 0 && double(rounded) > value) || (outward > 0 && double(rounded) < value))
    rounded = std::nextafter(rounded, outward);
  return number_json(rounded);
}

/// Null where nothing is known.
template <class T>
Json value_json(const SignedDistance& distance) {
  return distance.is_unknown() ? Json() : Json(number_json(static_cast<T>(distance.value)));
}

template <class T>
void solve(const SignedDistanceQuery& query, const AnswerOptions& options, Answer& answer) {
  SignedDistanceOptions how;
  how.tolerance = options.tolerance;
  how.at_most = query.at_most;
  how.only_sign = query.only_sign;
  constexpr T infinity = std::numeric_limits<T>::infinity();
  const SignedDistance result =
      signed_distance(ContactShape(convert<T>(query.a)), ContactShape(convert<T>(query.b)), how);
  answer.facts.status = name_of(result.status);
  answer.facts.hit = result.status == SignedStatus::overlapping;
  answer.facts.distance = result.value;
  answer.json["status"] = answer.facts.status;
  answer.json["value"] = value_json<T>(result);
  answer.json["lower"] = bound_json<T>(result.lower, -infinity);
  answer.json["upper"] = bound_json<T>(result.upper, infinity);
  if (!result.normal.isZero(0)) {
    answer.facts.normal = result.normal;
    answer.json["normal"] = point_json(Vec3<T>(result.normal.cast<T>()));
  }
  if (std::isfinite(result.upper)) {
    answer.json["point_a"] = point_json(Vec3<T>(result.point_a.cast<T>()));
    answer.json["point_b"] = point_json(Vec3<T>(result.point_b.cast<T>()));
  }
  answer.json["supports"] = result.supports;
  if (result.is_exhausted) answer.json["settled"] = false;
}

template <class T>
void solve(const ManifoldQuery& query, const AnswerOptions& options, Answer& answer) {
  const ContactShape a(convert<T>(query.a)), b(convert<T>(query.b));
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
  answer.json["value"] = value_json<T>(nearest);
  answer.json["normal"] = point_json(Vec3<T>(found.normal.cast<T>()));
  Json points = Json::array();
  for (int i = 0; i < found.count; ++i) {
    const ContactPoint& point = found.points[static_cast<std::size_t>(i)];
    points.push_back({{"point_a", point_json(Vec3<T>(point.point_a.cast<T>()))},
                      {"point_b", point_json(Vec3<T>(point.point_b.cast<T>()))},
                      {"distance", number_json(static_cast<T>(point.distance))}});
  }
  answer.json["points"] = std::move(points);
}

/// The shape in a frame about its pivot, and that frame's motion.
template <class T>
std::pair<ContactShape, RigidMotion> body_of(const Shape<double>& shape,
                                             const ImpactMotion& motion) {
  const Shape<double> rounded = convert<double>(convert<T>(shape));
  return {ContactShape(rounded, {Mat3<double>::Identity(), -motion.pivot}),
          RigidMotion{{Mat3<double>::Identity(), motion.pivot}, motion.velocity, motion.turn}};
}

template <class T>
void solve(const ImpactQuery& query, const AnswerOptions&, Answer& answer) {
  const auto [a, motion_a] = body_of<T>(query.a, query.motion_a);
  const auto [b, motion_b] = body_of<T>(query.b, query.motion_b);
  constexpr T infinity = std::numeric_limits<T>::infinity();
  const Impact result = first_impact(a, motion_a, b, motion_b, query.t_max);
  answer.facts.status = name_of(result.status);
  answer.facts.hit = result.status == ImpactStatus::hit || result.status == ImpactStatus::inside;
  answer.facts.t = result.t_lo;
  answer.json["status"] = answer.facts.status;
  answer.json["t_lo"] = bound_json<T>(result.t_lo, -infinity);
  answer.json["t_hi"] = answer.facts.hit ? bound_json<T>(result.t_hi, infinity) : Json();
  answer.facts.normal = result.normal;
  answer.json["normal"] = point_json(Vec3<T>(result.normal.cast<T>()));
  if (std::isfinite(result.distance)) {  // the distance is known
    answer.json["distance"] = number_json(static_cast<T>(result.distance));
    answer.json["point_a"] = point_json(Vec3<T>(result.point_a.cast<T>()));
    answer.json["point_b"] = point_json(Vec3<T>(result.point_b.cast<T>()));
  }
  answer.json["steps"] = result.steps;
}

}  // namespace

Answer answer(const Query& query, const AnswerOptions& options) {
  Answer result;
  if (!query.name.empty()) result.json["name"] = query.name;
  std::visit(
      [&](const auto& kind) {
        if (options.precision == Precision::in_float)
          solve<float>(kind, options, result);
        else
          solve<double>(kind, options, result);
      },
      query.kind);
  return result;
}

}  // namespace minkray
