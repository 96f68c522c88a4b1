// SPDX-License-Identifier: MIT
#include "renderer/query/trace.h"

#include "renderer/json/number_json.h"

namespace minkray {

template <class T>
CastTrace<T> trace_ray(const PreparedShape<T>& shape, const Ray<T>& ray,
                       const CastOptions<T>& options) {
  CastTrace<T> trace{shape.to_inner(ray), shape.inner_ball(), {}, {}};
  ClippedRay<T> clipped(trace.ray);
  trace.result = cast_ray<T>(shape, ray, options, [&](const CastIteration<T>& step) {
    const Clip<T> clip = clipped.clip(step.v, step.p);
    trace.iterations.push_back({step.lambda, step.x, step.v, step.p, step.w,
                                std::vector<Vec3<T>>(step.simplex.begin(), step.simplex.end()),
                                clip, clipped.lower(), clipped.upper()});
  });
  return trace;
}

template <class T>
Json trace_json(const CastTrace<T>& trace) {
  Json list = Json::array();
  for (const TracedIteration<T>& step : trace.iterations) {
    Json simplex = Json::array();
    for (const Vec3<T>& p : step.simplex) simplex.push_back(point_json(p));
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

#define MINKRAY_INSTANTIATE(T)                                                                    \
  template CastTrace<T> trace_ray(const PreparedShape<T>&, const Ray<T>&, const CastOptions<T>&); \
  template Json trace_json(const CastTrace<T>&);
MINKRAY_INSTANTIATE(float)
MINKRAY_INSTANTIATE(double)
#undef MINKRAY_INSTANTIATE

}  // namespace minkray
