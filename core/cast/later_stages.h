// SPDX-License-Identifier: MIT
// Later stages of a cast, for shapes without a form and for rays that leave the filter
// (core/cast/filter.h) in doubt: bounds, models, the GJK ray cast, and both with more digits.
#pragma once

#include "core/cast/cast.h"

namespace minkray {

/// Same as cast_ray, without the filter.
template <class T>
CastResult<T> cast_by_later_stages(const PreparedShape<T>& shape, const Ray<T>& ray,
                                   const CastOptions<T>& options, const CastObserver<T>& observer);

/// Same as cast_exit, without the filter.
template <class T>
CastResult<T> exit_by_later_stages(const PreparedShape<T>& shape, const Ray<T>& ray,
                                   const CastOptions<T>& options);

/// Same as cast_exit, with a lower bound of t as well; -infinity if there is none.
CastResult<double> cast_exit_within(const PreparedShape<double>& shape, const Ray<double>& ray,
                                    const CastOptions<double>& options = {});

/// Adds the upper bound of t to a hit that a packet found, as cast_by_later_stages does.
void bound_hit(const PreparedShape<double>& shape, const Ray<double>& ray,
               CastResult<double>& result);

extern template CastResult<float> cast_by_later_stages(const PreparedShape<float>&,
                                                       const Ray<float>&, const CastOptions<float>&,
                                                       const CastObserver<float>&);
extern template CastResult<double> cast_by_later_stages(const PreparedShape<double>&,
                                                        const Ray<double>&,
                                                        const CastOptions<double>&,
                                                        const CastObserver<double>&);
extern template CastResult<float> exit_by_later_stages(const PreparedShape<float>&,
                                                       const Ray<float>&,
                                                       const CastOptions<float>&);
extern template CastResult<double> exit_by_later_stages(const PreparedShape<double>&,
                                                        const Ray<double>&,
                                                        const CastOptions<double>&);

}  // namespace minkray
