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

template <class T>
bool is_certain(const Filtered<T>& answer) {
  return answer.hit || answer.miss || answer.inside;
}

template <class T>
CastResult<T> result_of(const Filtered<T>& answer) {
  const Status status = answer.hit ? Status::hit : answer.miss ? Status::miss : Status::inside;
  if (status == Status::miss)
    return {status,
            Path::filter,
            T(0),
            T(0),
            T(0),
            T(0),
            {answer.normal.x(), answer.normal.y(), answer.normal.z()},
            0,
            0};
  return {status,
          Path::filter,
          answer.t_base,
          answer.t_offset,
          answer.offset_lo,
          answer.offset_hi,
          {answer.normal.x(), answer.normal.y(), answer.normal.z()},
          0,
          0};
}

}  // namespace

template <class T>
CastResult<T> cast_ray(const PreparedShape<T>& shape, const Ray<T>& ray,
                       const CastOptions<T>& options, const CastObserver<T>& observer) {
  if (asks_filter(shape, options) && !observer) {
    const Filtered<T> answer = filter<false>(shape, ray, true);
    if (is_certain(answer)) return result_of(answer);
  }
  return cast_by_later_stages(shape, ray, options, observer);
}

CastResult<double> cast_ray(const ShapeDefinition<double>& definition, const Affine<double>& pose,
                            const Ray<double>& ray) {
  if (definition.is_plain() && keeps_lengths(pose.linear)) {
    const Mat3<double> to_inner = pose.linear.transpose();
    CastResult<double> result;
    const bool is_turned = !definition.is_round() && pose.linear != Mat3<double>::Identity();
    const FormPlace place(
        definition,
        rounded_plain_centre(pose.translation, to_inner, definition.inner_ball().centre),
        is_turned ? &to_inner : nullptr);
    if (cast_by_form(place, ray, result)) return result;
  }
  return cast_ray(PreparedShape<double>(definition, definition.placed(pose)), ray);
}

template <class T>
CastResult<T> cast_exit(const PreparedShape<T>& shape, const Ray<T>& ray,
                        const CastOptions<T>& options) {
  const auto answer = [&] {
    if (asks_filter(shape, options)) {
      const Filtered<T> filtered = filter<true>(shape, ray, true);
      if (is_certain(filtered)) return result_of(filtered);
    }
    return exit_by_later_stages(shape, ray, options);
  };
  CastResult<T> result = answer();
  // The ray may start inside, so no lower bound is claimed.
  if (result.status == Status::hit) result.offset_lo = -std::numeric_limits<T>::infinity();
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
