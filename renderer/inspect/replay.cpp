// SPDX-License-Identifier: MIT
#include "renderer/inspect/replay.h"

#include <algorithm>

#include "renderer/json/number_json.h"

namespace minkray {
namespace {

Json in_float(const Vec3<double>& point) {
  return point_json(Vec3<float>(point.cast<float>()));
}

/// The vertex by the number of the step that found it, which saves its digits; by itself if none
/// did.
Json vertex_json(const std::vector<TracedIteration>& steps, std::size_t k,
                 const Vec3<double>& vertex) {
  for (std::size_t i = k + 1; i-- > 0;)
    if (steps[i].p == vertex) return i;
  return in_float(vertex);
}

}  // namespace

Json replay_json(const CastTrace& trace) {
  const CastResult<double>& result = trace.result;
  Json json{{"status", name_of(result.status)}, {"path", name_of(result.path)}};
  if (result.found()) {
    json["t"] = number_json(result.t_base + result.t_offset);
    json["t_lo"] = number_json(result.t_base + result.offset_lo);
    json["t_hi"] = number_json(result.t_base + result.offset_hi);
  }
  json["normal"] = point_json(result.normal);
  json["iterations"] = result.iterations;
  json["supports"] = result.supports;
  json["radius"] = number_json(trace.ball.radius);
  const RayNearBall<double>& ray = trace.ray;
  json["s"] = point_json(ray.s);
  json["r"] = point_json(ray.r);
  json["lambda"] = Json::array({number_json(ray.lambda_min), number_json(ray.lambda_max)});
  json["t_of"] = Json::array(
      {number_json(ray.t_base), number_json(ray.t_shift), number_json(ray.t_per_length)});
  Json steps = Json::array();
  for (std::size_t k = 0; k < trace.iterations.size(); ++k) {
    const TracedIteration& step = trace.iterations[k];
    Json simplex = Json::array();
    for (const Vec3<double>& vertex : step.simplex)
      simplex.push_back(vertex_json(trace.iterations, k, vertex));
    steps.push_back(Json::array({number_json(step.lambda), static_cast<int>(step.clip.which),
                                 number_json(step.clip.lambda), number_json(step.lower),
                                 number_json(step.upper), in_float(step.v), in_float(step.p),
                                 in_float(step.w), std::move(simplex)}));
  }
  json["steps"] = std::move(steps);
  return json;
}

}  // namespace minkray
