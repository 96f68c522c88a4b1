// SPDX-License-Identifier: MIT
// --check: compares a result with a case's `expect`.
#include <sstream>

#include "core/derived/shape_bounds.h"
#include "core/query/tolerances.h"
#include "core/shape_cast/distance.h"
#include "renderer/query/answer.h"

namespace minkray {
namespace {

double largest_coordinate(const Shape<double>& shape) {
  const Bounds<double> bounds = bounds_of<double>(shape);
  return bounds.lower.cwiseAbs().cwiseMax(bounds.upper.cwiseAbs()).maxCoeff();
}

/// The largest coordinate of a query, and the direction of its motion.
struct Extent {
  double size = 0;
  Vec3<double> direction = Vec3<double>::Zero();
};

Extent extent(const RayQuery& query) {
  return {std::max(largest_coordinate(query.shape), query.ray.origin.cwiseAbs().maxCoeff()),
          query.ray.direction};
}
Extent extent(const ShapeQuery& query) {
  return {std::max(largest_coordinate(query.moving), largest_coordinate(query.obstacle)),
          query.direction - query.obstacle_direction};
}
Extent extent(const DistanceQuery& query) {
  return {std::max(largest_coordinate(query.a), largest_coordinate(query.b))};
}
Extent extent(const SignedDistanceQuery& query) {
  return {std::max(largest_coordinate(query.a), largest_coordinate(query.b))};
}
Extent extent(const ManifoldQuery& query) {
  return {std::max(largest_coordinate(query.a), largest_coordinate(query.b))};
}
Extent extent(const ImpactQuery& query) {
  return {std::max(largest_coordinate(query.a), largest_coordinate(query.b)),
          query.motion_b.velocity - query.motion_a.velocity};
}

struct Allowance {
  double length = 0, t = 0, normal = 0;
};

/// Allowance in float, beyond the case's own tolerances; in double, for the normals, which have
/// none, the rounding of a plane through points that are rounded themselves.
Allowance allowance(const Query& query, const AnswerFacts& facts, Precision precision) {
  constexpr double normal_in_double = 1e-6;
  if (precision == Precision::in_double) return {0, 0, normal_in_double};
  const Extent of = std::visit([](const auto& kind) { return extent(kind); }, query.kind);
  Allowance allowed;
  const double relative = float_roundings * double(tolerance::epsilon<float>);
  allowed.length = relative * of.size;
  const double speed =
      facts.normal ? std::abs(facts.normal->dot(of.direction)) : of.direction.norm();
  if (facts.hit && facts.t > 0) allowed.t = allowed.length / speed;
  allowed.normal = std::sqrt(relative);
  return allowed;
}

/// The distance, in double, between the shape and all that the ray passes: how far a miss is from
/// being a hit.
double miss_distance(const Shape<double>& shape, const Vec3<double>& origin,
                     const Vec3<double>& direction, double t_max) {
  const CentredShape<double> target = centred(shape);
  const double length = direction.norm();
  const double enough = (origin - target.centre).norm() + 2 * target.radius;
  const double t_end = length > 0 ? std::min(t_max, enough / length) : 0;
  const Segment<double> path{{origin, Vec3<double>(origin + t_end * direction)}};
  return distance_between(target, centred(Shape<double>(path))).distance;
}

double miss_distance(const RayQuery& query) {
  return miss_distance(query.shape, query.ray.origin, query.ray.direction, query.ray.t_max);
}
double miss_distance(const ShapeQuery& query) {
  const MinkowskiDifference<double> obstacle{Nested<double>(query.obstacle),
                                             Nested<double>(query.moving)};
  return miss_distance(Shape<double>(obstacle), Vec3<double>::Zero(),
                       query.direction - query.obstacle_direction, query.t_max);
}
double miss_distance(const DistanceQuery&) {
  return 0;
}
double miss_distance(const SignedDistanceQuery&) {
  return 0;
}
double miss_distance(const ManifoldQuery&) {
  return 0;
}
double miss_distance(const ImpactQuery&) {
  return 0;
}

std::string number(double value) {
  std::ostringstream text;
  text.precision(17);
  text << value;
  return text.str();
}

}  // namespace

std::vector<std::string> complaints(const Query& query, const AnswerFacts& facts,
                                    Precision precision) {
  std::vector<std::string> found;
  if (!query.expect) return found;
  const Expectation& expect = *query.expect;
  const Allowance allowed = allowance(query, facts, precision);
  // Written so that NaN is wrong.
  const auto compare = [&](const std::string& what, double is, double expected, double tolerance) {
    if (std::abs(is - expected) <= tolerance) return;
    found.push_back(what + " is " + number(is) + ", expected " + number(expected) + " (off by " +
                    number(std::abs(is - expected)) + ", allowed " + number(tolerance) + ")");
  };
  const bool gave_up = facts.status == "exhausted" || facts.status == "undecided";
  if (gave_up) found.push_back("status is " + facts.status);
  if (expect.hit && !gave_up) {
    // In float a miss by less than the query's own rounding may be a hit.
    const bool is_within_rounding = precision == Precision::in_float && facts.hit && !*expect.hit &&
                                    std::visit([](const auto& kind) { return miss_distance(kind); },
                                               query.kind) <= allowed.length;
    if (facts.hit != *expect.hit && !expect.either && !is_within_rounding)
      found.push_back("status is " + facts.status + ", expected " +
                      (*expect.hit ? "hit or inside" : "miss"));
    if (expect.t && facts.hit) compare("t", facts.t, *expect.t, expect.t_abs_tol + allowed.t);
    if (expect.normal && facts.hit && facts.normal)
      compare("the normal's angle to the expected one", (*facts.normal - *expect.normal).norm(), 0,
              allowed.normal);
    if (expect.normal && facts.hit && !facts.normal && facts.t > 0)
      found.push_back("there is no normal");
  }
  if (expect.distance)
    compare("distance", facts.distance, *expect.distance, expect.abs_tol + allowed.length);
  return found;
}

}  // namespace minkray
