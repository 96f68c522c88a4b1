// SPDX-License-Identifier: MIT
#include "renderer/inspect/pair_replay.h"

#include <algorithm>
#include <cmath>

#include "core/parts/parts_distance.h"
#include "renderer/inspect/replay.h"
#include "renderer/inspect/shape_mesh.h"
#include "renderer/json/number_json.h"
#include "renderer/paper/distance.h"
#include "renderer/paper/shape_cast.h"
#include "renderer/query/pair_body.h"
#include "renderer/scene/scene_instances.h"

namespace minkray {
namespace {

using Point2 = Vec<double, 2>;

/// Number of directions around the plane for an outline.
constexpr int outline_directions = 240;

/// Number of the scene's first objects among which pairs are searched.
constexpr std::size_t most_objects_paired = 300;

template <int Dim>
Json points_json(std::span<const Vec<double, Dim>> points) {
  Json list = Json::array();
  for (const auto& point : points) list.push_back(point_json(point));
  return list;
}

template <int Dim>
Json step_json(const DistanceIteration<double, Dim>& step) {
  return {{"v", point_json(step.v)},
          {"w", point_json(step.w)},
          {"v_next", point_json(step.v_next)},
          {"lower", number_json(step.lower)},
          {"upper", number_json(step.upper)},
          {"before", points_json<Dim>(step.before)},
          {"after", points_json<Dim>(step.after)}};
}

template <int Dim>
Json answer_json(const DistanceResult<double, Dim>& result, Json steps) {
  return {{"status", name_of(result.status)},
          {"distance", number_json(result.distance)},
          {"lower", number_json(result.lower)},
          {"iterations", result.iterations},
          {"supports", result.supports},
          {"point_a", point_json(result.point_a)},
          {"point_b", point_json(result.point_b)},
          {"axis", point_json(result.axis)},
          {"steps", std::move(steps)}};
}

Json distance_json(const PreparedPair& pair) {
  Json steps = Json::array();
  const auto result = distance_between(
      pair.a(), pair.b(), {}, SubalgorithmKind::projection,
      [&](const DistanceIteration<double, 3>& step) { steps.push_back(step_json<3>(step)); });
  Json json = answer_json(result, std::move(steps));
  const Vec3<double> x = pair.b().centre - pair.a().centre;
  json["x"] = point_json(x);
  // The page mirrors the mesh of A - B, which is about the ball's centre, to C = {x} - (A - B).
  json["mirrored_at"] = point_json(Vec3<double>(x - pair.obstacle().inner_ball().centre));
  return json;
}

Json impact_json(const PreparedPair& pair) {
  const Vec3<double> apart = pair.b().centre - pair.a().centre;
  const Ray<double> ray{apart, -apart, 1.0};
  return replay_json(trace_ray(pair.obstacle(), ray, CastOptions()));
}

Json plane_json(const PreparedPair& pair) {
  Json steps = Json::array();
  const auto result = distance_in_plane(
      pair.a(), pair.b(), {}, SubalgorithmKind::projection,
      [&](const DistanceIteration<double, 2>& step) { steps.push_back(step_json<2>(step)); });
  Json json = answer_json(result, std::move(steps));
  Json outline = Json::array();
  const Point2 x = (pair.b().centre - pair.a().centre).head<2>();
  for (int i = 0; i < outline_directions; ++i) {
    const double angle = 2 * std::acos(-1.0) * i / outline_directions;
    const Vec3<double> n(std::cos(angle), std::sin(angle), 0);
    const Vec3<double> p =
        pair.a().about_centre.support(n) - pair.b().about_centre.support(Vec3<double>(-n));
    outline.push_back(point_json(Vec<float, 2>((x - p.head<2>()).cast<float>())));
  }
  json["outline"] = std::move(outline);
  return json;
}

/// Two convex shapes of a pair: objects, or the nearest triangles of meshes.
struct PairShapes {
  CentredShape a, b;
  PartPair parts;
};

QueryBody body_of(const Object& object) {
  if (object.mesh) return QueryBody(object.mesh, object.pose);
  return QueryBody(Shape(Transform{Nested(object.shape), object.pose}));
}

/// Nothing if one lies within the other's mesh: no two parts are nearest.
std::optional<PairShapes> shapes_of(const Object& a, const Object& b) {
  if (!a.mesh && !b.mesh) return PairShapes{centred(a.shape, a.pose), centred(b.shape, b.pose), {}};
  const QueryBody body_a = body_of(a), body_b = body_of(b);
  const PairBody posed_a(body_a), posed_b(body_b);
  PartPair parts;
  signed_distance(posed_a.parts(), posed_a.pose(), posed_b.parts(), posed_b.pose(), {}, &parts);
  if ((a.mesh && parts.a == no_part) || (b.mesh && parts.b == no_part)) return std::nullopt;
  return PairShapes{centred(posed_a.part(parts.a)), centred(posed_b.part(parts.b)), parts};
}

/// A ball that contains the object: a gap of two is no more than their distance.
Ball<double> ball_of(const Object& object) {
  if (!object.mesh) {
    const CentredShape shape = centred(object.shape, object.pose);
    return {shape.centre, shape.radius};
  }
  const Bounds<double>& box = object.mesh->bounds();
  return {object.pose(box.centre()),
          (object.pose.linear.cwiseAbs() * box.reach_of_centre()).norm()};
}

}  // namespace

std::vector<ObjectPair> nearest_pairs(const Scene& scene, std::size_t most) {
  std::vector<std::size_t> solid;
  std::vector<Ball<double>> balls;
  for (std::size_t i = 0; i < std::min(scene.objects.size(), most_objects_paired); ++i) {
    if (scene.objects[i].half_space) continue;
    solid.push_back(i);
    balls.push_back(ball_of(scene.objects[i]));
  }
  struct Candidate {
    double gap;
    ObjectPair pair;
  };
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < solid.size(); ++i)
    for (std::size_t j = i + 1; j < solid.size(); ++j)
      candidates.push_back(
          {(balls[i].centre - balls[j].centre).norm() - balls[i].radius - balls[j].radius,
           {solid[i], solid[j]}});
  const auto kept = std::min(most, candidates.size());
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& p, const Candidate& q) { return p.gap < q.gap; });
  std::vector<ObjectPair> pairs;
  for (std::size_t i = 0; i < kept; ++i) pairs.push_back(candidates[i].pair);
  return pairs;
}

std::optional<Json> pair_json(const Scene& scene, const ObjectPair& pair) {
  const auto shapes = shapes_of(scene.objects[pair.a], scene.objects[pair.b]);
  if (!shapes) return std::nullopt;
  const PreparedPair prepared(shapes->a, shapes->b);
  const PreparedShape& obstacle = prepared.obstacle();
  Json json = {{"a", pair.a},
               {"b", pair.b},
               {"mesh", mesh_json(obstacle.inner_shape(), obstacle.inner_ball(), fine_mesh)},
               {"distance", distance_json(prepared)},
               {"impact", impact_json(prepared)},
               {"plane", plane_json(prepared)}};
  if (shapes->parts.a != no_part) json["triangle_a"] = shapes->parts.a;
  if (shapes->parts.b != no_part) json["triangle_b"] = shapes->parts.b;
  return json;
}

}  // namespace minkray
