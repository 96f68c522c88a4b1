// SPDX-License-Identifier: MIT
// Casts one ray: tries the filter; if that is inconclusive, the later stages run.
#include "core/cast/cast.h"

#include "core/cast/filter.h"
#include "core/cast/form_cast.h"
#include "core/cast/later_stages.h"

namespace minkray {
namespace {

/// True if the shape has a closed form and no particular solver was requested.
bool asks_filter(const PreparedShape& shape, const CastOptions& options) {
  return options.solver == &solver::automatic && shape.definition().form().kind != FormKind::none;
}

/// For a miss, sets all numbers of t to 0.
CastResult<double>& cleared_if_missed(CastResult<double>& result) {
  if (result.status == Status::miss)
    result.t_base = result.t_offset = result.offset_lo = result.offset_hi = 0.0;
  return result;
}

CastResult<double> exit_by_any_stage(const PreparedShape& shape, const Ray<double>& ray,
                                     const CastOptions& options) {
  if (asks_filter(shape, options)) {
    const Filtered<double> filtered = filter<true>(shape, ray, true);
    CastResult<double> result;
    if (filtered.is_certain()) {
      write_result(filtered, result);
      return cleared_if_missed(result);
    }
  }
  return exit_by_later_stages(shape, ray, options);
}

}  // namespace

CastResult<double> cast_ray(const PreparedShape& shape, const Ray<double>& ray,
                            const CastOptions& options, const CastObserver& observer) {
  if (asks_filter(shape, options) && !observer) {
    CastResult<double> result;
    const FormPlace place(shape.definition(), shape.centre(), shape.linear_to_inner());
    if (cast_by_form(place, ray, result)) return cleared_if_missed(result);
  }
  return cast_by_later_stages(shape, ray, options, observer);
}

CastResult<double> cast_ray(const ShapeDefinition& definition, const Affine<double>& pose,
                            const Ray<double>& ray) {
  if (definition.is_plain() && keeps_lengths(pose.linear)) {
    const Mat3<double> to_inner = pose.linear.transpose();
    CastResult<double> result;
    const bool is_turned = !definition.is_round() && pose.linear != Mat3<double>::Identity();
    const FormPlace place(definition,
                          definition.rounded_plain_centre(pose, definition.inner_ball().centre),
                          is_turned ? &to_inner : nullptr);
    if (cast_by_form(place, ray, result)) return result;
  }
  return cast_ray(PreparedShape(definition, definition.placed(pose)), ray);
}

CastResult<double> cast_exit(const PreparedShape& shape, const Ray<double>& ray,
                             const CastOptions& options) {
  CastResult<double> result = exit_by_any_stage(shape, ray, options);
  // The ray may start inside, so there is no lower bound.
  if (result.status == Status::hit) result.offset_lo = -std::numeric_limits<double>::infinity();
  return result;
}

CastResult<double> cast_exit_within(const PreparedShape& shape, const Ray<double>& ray,
                                    const CastOptions& options) {
  CastResult<double> result = exit_by_any_stage(shape, ray, options);
  // Without an enclosing triangle there is no lower bound.
  if (result.status == Status::hit && !(result.offset_lo <= result.t_offset))
    result.offset_lo = -std::numeric_limits<double>::infinity();
  return result;
}

}  // namespace minkray
