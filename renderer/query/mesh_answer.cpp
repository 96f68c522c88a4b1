// SPDX-License-Identifier: MIT
#include "renderer/query/mesh_answer.h"

#include <cmath>

#include "core/parts/parts_contact.h"
#include "core/parts/parts_distance.h"
#include "core/parts/parts_impact.h"
#include "core/world/posed_mesh.h"
#include "renderer/audit/mesh_verdict.h"
#include "renderer/json/number_json.h"
#include "renderer/query/answer_json.h"
#include "renderer/query/pair_body.h"

namespace minkray {
namespace {

/// Adds the solver's iterations at two parts, or at the triangle that is hit: those of the same
/// query on convex shapes.
template <class OfParts>
void add_trace(Answer& answer, const OfParts& of_parts, const AnswerOptions& options) {
  const Answer at_parts = minkray::answer({"", of_parts, {}}, options);
  if (const Json* const trace = at_parts.json.find("trace")) answer.json["trace"] = *trace;
}

/// Adds the numbers of the triangles. Returns false if the result has no two parts.
bool add_triangles(Answer& answer, const PairQuery& query, const PartPair& parts) {
  if (parts.a != no_part) answer.json["triangle_a"] = parts.a;
  if (parts.b != no_part) answer.json["triangle_b"] = parts.b;
  return (!query.a.mesh || parts.a != no_part) && (!query.b.mesh || parts.b != no_part);
}

/// Time after which the bodies only move apart: no contact is later.
double end_of_contacts(const PairBody& a, const PairBody& b) {
  const double speed = length_of(Vec3<double>(b.motion().velocity - a.motion().velocity));
  if (speed == 0) return 0;
  const double way = length_of(Vec3<double>(b.middle() - a.middle())) + a.radius() + b.radius();
  return 2 * way / speed;
}

/// Converts an impact to the result of a cast.
CastResult<double> cast_of(const Impact& impact) {
  CastResult<double> cast;
  cast.normal = impact.normal;
  cast.t_base = impact.t_lo;
  cast.offset_lo = 0;
  cast.offset_hi = impact.t_hi - impact.t_lo;
  switch (impact.status) {
    case ImpactStatus::hit:
      cast.status = Status::hit;
      break;
    case ImpactStatus::miss:
      cast.status = Status::miss;
      break;
    case ImpactStatus::inside:
      cast.status = Status::inside;
      break;
    case ImpactStatus::undecided:
      cast.status = Status::exhausted;
      break;
  }
  return cast;
}

}  // namespace

void answer_at_mesh(const RayQuery& query, const AnswerOptions& options, Answer& answer) {
  const PosedMesh posed(0, query.body.mesh, query.body.pose);
  const Ray<double>& ray = query.ray;
  PartCounts counts;
  const PartCast found =
      cast_ray(posed, ray, std::numeric_limits<double>::infinity(), false, 0, counts);
  add_cast(answer, found.cast);
  add_hit_point(answer, ray, found.cast);
  if (found.part != no_part) answer.json["triangle"] = found.part;
  answer.json["nodes"] = counts.nodes;
  answer.json["triangles"] = counts.triangles;
  if (options.certify) {
    add_verdict(answer, verdict_of(posed, ray, claim_of(found.cast)), found.cast.status);
    answer.json["certified"].erase("margin");  // each triangle has its own
  }
  if (options.trace && found.part != no_part)
    add_trace(answer, RayQuery{posed_triangle(*posed.mesh, found.part, posed.pose), ray}, options);
}

void answer_at_mesh(const ShapeQuery& query, const AnswerOptions& options, Answer& answer) {
  const PairBody a(query.obstacle, {query.obstacle_direction, query.obstacle_turn, {0, 0, 0}}),
      b(query.moving, {query.direction, query.turn, {0, 0, 0}});
  const double t_max = std::isfinite(query.t_max) ? query.t_max : end_of_contacts(a, b);
  PartPair parts;
  const Impact impact =
      first_impact(a.parts(), a.motion(), b.parts(), b.motion(), t_max, {}, &parts);
  add_cast(answer, cast_of(impact));
  if (answer.facts.hit && std::isfinite(impact.distance)) {
    answer.json["point_a"] = point_json(impact.point_a);
    answer.json["point_b"] = point_json(impact.point_b);
  }
  const bool has_parts = add_triangles(answer, {query.obstacle, query.moving}, parts);
  answer.json["steps"] = impact.steps;
  if (!options.trace || !has_parts || query.turns()) return;
  ShapeQuery of_parts = query;
  of_parts.obstacle = a.part(parts.a);
  of_parts.moving = b.part(parts.b);
  add_trace(answer, of_parts, options);
}

void answer_at_mesh(const DistanceQuery& query, const AnswerOptions& options, Answer& answer) {
  const PairBody a(query.a), b(query.b);
  PartPair parts;
  const SignedDistance result =
      signed_distance(a.parts(), a.pose(), b.parts(), b.pose(), {}, &parts);
  add_signed_distance(answer, result);
  // The status is one of distances, and the value is the distance.
  const bool is_apart = result.status == SignedStatus::separated;
  answer.facts.status = is_apart ? "separated" : result.is_unknown() ? "exhausted" : "overlapping";
  answer.json["status"] = answer.facts.status;
  answer.json.erase("value");
  answer.json["distance"] = number_json(result.value);
  if (add_triangles(answer, query, parts) && options.trace)
    add_trace(answer, DistanceQuery{{a.part(parts.a), b.part(parts.b)}}, options);
}

void answer_at_mesh(const SignedDistanceQuery& query, const AnswerOptions& options,
                    Answer& answer) {
  const PairBody a(query.a), b(query.b);
  SignedDistanceOptions how;
  how.tolerance = options.tolerance;
  how.at_most = query.at_most;
  how.only_sign = query.only_sign;
  PartPair parts;
  const SignedDistance result =
      signed_distance(a.parts(), a.pose(), b.parts(), b.pose(), how, &parts);
  add_signed_distance(answer, result);
  add_triangles(answer, query, parts);
  if (result.is_exhausted) answer.json["settled"] = false;
}

void answer_at_mesh(const ManifoldQuery& query, const AnswerOptions& options, Answer& answer) {
  const PairBody a(query.a), b(query.b);
  SignedDistanceOptions how;
  how.tolerance = options.tolerance;
  const SignedDistance nearest = signed_distance(a.parts(), a.pose(), b.parts(), b.pose(), how);
  add_contacts(answer, nearest, contact_manifold(a.parts(), a.pose(), b.parts(), b.pose()));
}

void answer_at_mesh(const ImpactQuery& query, const AnswerOptions&, Answer& answer) {
  const PairBody a(query.a, query.motion_a), b(query.b, query.motion_b);
  PartPair parts;
  add_impact(answer,
             first_impact(a.parts(), a.motion(), b.parts(), b.motion(), query.t_max, {}, &parts));
  add_triangles(answer, query, parts);
}

}  // namespace minkray
