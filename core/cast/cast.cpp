// SPDX-License-Identifier: MIT
// Casts one ray: tries the filter; if that is inconclusive, the later stages run.
#include "core/cast/cast.h"

#include "core/cast/filter.h"
#include "core/cast/form_cast.h"
#include "core/cast/later_stages.h"

namespace minkray {
namespace {

/// True if the shape has a closed form and no particular solver was requested.
template <class T>
bool asks_filter(const PreparedShape<T>& shape, const CastOptions<T>& options) {
  return options.solver == SolverKind::automatic &&
         shape.definition().form().kind != FormKind::none;
}

/// A miss has no parameter.
template <class T>
CastResult<T> result_of(const Filtered<T>& answer) {
  CastResult<T> result;
  write_result(answer, result);
  if (result.status == Status::miss)
    result.t_base = result.t_offset = result.offset_lo = result.offset_hi = T(0);
  return result;
}

template <class T>
CastResult<T> exit_by_any_stage(const PreparedShape<T>& shape, const Ray<T>& ray,
                                const CastOptions<T>& options) {
  if (asks_filter(shape, options)) {
    const Filtered<T> filtered = filter<true>(shape, ray, true);
    if (filtered.is_certain()) return result_of(filtered);
  }
  return exit_by_later_stages(shape, ray, options);
}

}  // namespace

template <class T>
CastResult<T> cast_ray(const PreparedShape<T>& shape, const Ray<T>& ray,
                       const CastOptions<T>& options, const CastObserver<T>& observer) {
  if (asks_filter(shape, options) && !observer) {
    const Filtered<T> answer = filter<false>(shape, ray, true);
    if (answer.is_certain()) return result_of(answer);
  }
  return cast_by_later_stages(shape, ray, options, observer);
}

CastResult<double> cast_ray(const ShapeDefinition<double>& definition, const Affine<double>& pose,
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
  return cast_ray(PreparedShape<double>(definition, definition.placed(pose)), ray);
}

template <class T>
CastResult<T> cast_exit(const PreparedShape<T>& shape, const Ray<T>& ray,
                        const CastOptions<T>& options) {
  CastResult<T> result = exit_by_any_stage(shape, ray, options);
  // The ray may start inside, so no lower bound is claimed.
  if (result.status == Status::hit) result.offset_lo = -std::numeric_limits<T>::infinity();
  return result;
}

CastResult<double> cast_exit_within(const PreparedShape<double>& shape, const Ray<double>& ray,
                                    const CastOptions<double>& options) {
  CastResult<double> result = exit_by_any_stage(shape, ray, options);
  // Without an enclosing triangle there is no lower bound.
  if (result.status == Status::hit && !(result.offset_lo <= result.t_offset))
    result.offset_lo = -std::numeric_limits<double>::infinity();
  return result;
}

template CastResult<float> cast_ray(const PreparedShape<float>&, const Ray<float>&,
                                    const CastOptions<float>&, const CastObserver<float>&);
template CastResult<double> cast_ray(const PreparedShape<double>&, const Ray<double>&,
                                     const CastOptions<double>&, const CastObserver<double>&);
template CastResult<float> cast_exit(const PreparedShape<float>&, const Ray<float>&,
                                     const CastOptions<float>&);
template CastResult<double> cast_exit(const PreparedShape<double>&, const Ray<double>&,
                                      const CastOptions<double>&);

}  // namespace minkray
