// SPDX-License-Identifier: MIT
// Casts a float ray at a float shape in double: all numbers of the query are exact in double,
// except for the map into the shape's frame.
#pragma once

#include <vector>

#include "core/cast/cast.h"
#include "core/query/on_ray.h"

namespace minkray {

inline CastObserver<double> in_double(const CastObserver<float>& observer) {
  if (!observer) return {};
  return [&](const CastIteration<double>& iteration) {
    std::vector<Vec3<float>> simplex;
    for (const Vec3<double>& p : iteration.simplex) simplex.push_back(p.cast<float>());
    observer(CastIteration<float>{float(iteration.lambda), iteration.x.cast<float>(),
                                  iteration.v.cast<float>(), iteration.p.cast<float>(),
                                  iteration.w.cast<float>(), simplex});
  };
}

/// `cast` is cast_ray or cast_exit in double; the shape must have in_double().
template <class Cast>
CastResult<float> ask_in_double(const PreparedShape<float>& shape, const Ray<float>& ray,
                                const CastOptions<float>& options, const Cast& cast) {
  const ShapeDefinition<double>& definition = *shape.definition().in_double();
  const PreparedShape<double> same(definition, definition.placed({}));
  // Maps the ray to the float shape's inner frame, with the same parameter.
  const TwoFoldVec3<float>& centre = shape.two_fold_centre();
  Vec3<double> origin =
      (ray.origin.cast<double>() - centre.high.cast<double>()) - centre.low.cast<double>();
  Vec3<double> direction = ray.direction.cast<double>();
  if (const Mat3<float>* map = shape.linear_to_inner()) {
    origin = map->cast<double>() * origin;
    direction = map->cast<double>() * direction;
  }
  origin += shape.inner_ball().centre.cast<double>();

  CastOptions<double> same_options;
  same_options.solver = options.solver;
  same_options.max_iterations = options.max_iterations;
  if (!options.v0.isZero(0)) same_options.v0 = shape.normal_to_inner(options.v0).cast<double>();
  const CastResult<double> found =
      cast(same, Ray<double>{origin, direction, double(ray.t_max)}, same_options);

  CastResult<float> result;
  result.status = found.status;
  result.path = Path::finer;
  result.iterations = found.iterations;
  result.supports = found.supports;
  result.normal = shape.normal_to_outer(Vec3<float>(found.normal.cast<float>()));
  result.offset_hi = 0;
  if (found.status == Status::hit) {
    result.t_base = static_cast<float>(found.t_base);
    const double rest = found.t_base - double(result.t_base), offset = rest + found.t_offset;
    const double rounding = tolerance::form_digits<float> * std::abs(offset);
    result.t_offset = static_cast<float>(offset);
    result.offset_lo = static_cast<float>(rest + found.offset_lo - rounding);
    result.offset_hi = static_cast<float>(rest + found.offset_hi + rounding);
    keep_on_ray(ray, result);
  }
  const bool has_t = std::isfinite(result.t());
  const bool has_normal = found.status != Status::miss || !result.normal.isZero(0);
  if (!has_t || !has_normal || !has_numbers<float>(result, result.normal)) {
    result.status = Status::exhausted;
    result.normal.setZero();
  }
  return result;
}

}  // namespace minkray
