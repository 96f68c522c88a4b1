// SPDX-License-Identifier: MIT
#include "renderer/query/answer_json.h"

#include <cmath>

#include "core/math/outward_sum.h"
#include "renderer/json/number_json.h"

namespace minkray {
namespace {

/// Null where nothing is known.
Json value_json(const SignedDistance& distance) {
  return distance.is_unknown() ? Json() : Json(number_json(distance.value));
}

}  // namespace

void add_normal(Answer& answer, const Vec3<double>& normal) {
  if (normal.isZero(0)) return;
  answer.facts.normal = normal;
  answer.json["normal"] = point_json(normal);
}

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
  add_normal(answer, result.normal);
}

void add_hit_point(Answer& answer, const Ray<double>& ray, const CastResult<double>& result) {
  if (!result.found()) return;
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

void add_verdict(Answer& answer, const CertificateVerdict& verdict, Status status) {
  answer.verdict = verdict;
  Json json = {{"holds", verdict.holds}};
  if (!verdict.holds) json["complaint"] = verdict.complaint;
  if (status == Status::hit) {
    json["t_lo"] = number_json(verdict.t_lo());
    json["t_hi"] = number_json(verdict.t_hi());
    json["gap"] = number_json(verdict.gap);
  }
  if (status == Status::hit || status == Status::inside)
    json["lateral"] = number_json(verdict.lateral);
  if (status == Status::miss) json["margin"] = number_json(verdict.margin);
  json["allowed"] = number_json(verdict.allowed);
  answer.json["certified"] = std::move(json);
}

void add_signed_distance(Answer& answer, const SignedDistance& result) {
  answer.signed_distance = result;
  answer.facts.status = name_of(result.status);
  answer.facts.hit = result.status == SignedStatus::overlapping;
  answer.facts.distance = result.value;
  answer.json["status"] = answer.facts.status;
  answer.json["value"] = value_json(result);
  answer.json["lower"] = number_json(result.lower);
  answer.json["upper"] = number_json(result.upper);
  add_normal(answer, result.normal);
  if (!std::isfinite(result.upper)) return;
  answer.json["point_a"] = point_json(result.point_a);
  answer.json["point_b"] = point_json(result.point_b);
}

void add_contacts(Answer& answer, const SignedDistance& nearest, const ContactManifold& found) {
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

void add_impact(Answer& answer, const Impact& result) {
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

}  // namespace minkray
