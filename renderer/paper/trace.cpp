// SPDX-License-Identifier: MIT
#include "renderer/paper/trace.h"

#include "renderer/json/number_json.h"

namespace minkray {

CastTrace trace_ray(const PreparedShape& shape, const Ray<double>& ray,
                    const CastOptions& options) {
  CastTrace trace{shape.to_inner(ray), shape.inner_ball(), {}, {}};
  ClippedRay<double> clipped(trace.ray);
  trace.result = cast_ray(shape, ray, options, [&](const CastIteration<double>& step) {
    const Clip<double> clip = clipped.clip(step.v, step.p);
    trace.iterations.push_back({step.lambda, step.x, step.v, step.p, step.w,
                                std::vector<Vec3<double>>(step.simplex.begin(), step.simplex.end()),
                                clip, clipped.lower(), clipped.upper()});
  });
  return trace;
}

Json trace_json(const CastTrace& trace) {
  Json list = Json::array();
  for (const TracedIteration& step : trace.iterations) {
    Json simplex = Json::array();
    for (const Vec3<double>& p : step.simplex) simplex.push_back(point_json(p));
    list.push_back({{"lambda", number_json(step.lambda)},
                    {"t", number_json(trace.t(step.lambda))},
                    {"x", point_json(step.x)},
                    {"v", point_json(step.v)},
                    {"p", point_json(step.p)},
                    {"w", point_json(step.w)},
                    {"simplex", std::move(simplex)},
                    {"case", static_cast<int>(step.clip.which)},
                    {"t_clip", number_json(trace.t(step.clip.lambda))},
                    {"t_lo", number_json(trace.t(step.lower))},
                    {"t_hi", number_json(trace.t(step.upper))}});
  }
  return list;
}

}  // namespace minkray
