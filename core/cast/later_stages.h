// SPDX-License-Identifier: MIT
// Later stages of a cast, for shapes without a form and for rays that leave the filter
// (core/cast/filter.h) in doubt: bounds, models, the GJK ray cast, and both with more digits.
#pragma once

#include "core/cast/cast.h"

namespace minkray {

/// Same as cast_ray, without the filter.
CastResult<double> cast_by_later_stages(const PreparedShape& shape, const Ray<double>& ray,
                                        const CastOptions& options, const CastObserver& observer);

/// Same as cast_exit, without the filter.
CastResult<double> exit_by_later_stages(const PreparedShape& shape, const Ray<double>& ray,
                                        const CastOptions& options);

/// Adds the upper bound of t to a hit that a packet found, as cast_by_later_stages does.
void bound_hit(const PreparedShape& shape, const Ray<double>& ray, CastResult<double>& result);

}  // namespace minkray
