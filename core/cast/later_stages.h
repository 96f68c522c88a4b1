// SPDX-License-Identifier: MIT
// Later stages of a cast, for shapes without a closed form and for rays that the filter
// (core/cast/filter.h) leaves in doubt: bounds, models, and the GJK ray cast, in double and with
// more digits.
#pragma once

#include "core/cast/cast.h"

namespace minkray {

/// Same as cast_ray (cast.h), without the filter.
CastResult<double> cast_by_later_stages(const PreparedShape& shape, const Ray<double>& ray,
                                        const CastOptions& options, const CastObserver& observer);

/// Same as cast_exit (cast.h), without the filter.
CastResult<double> exit_by_later_stages(const PreparedShape& shape, const Ray<double>& ray,
                                        const CastOptions& options);

/// Adds the upper bound of t to a hit that a packet found, as cast_by_later_stages does.
void bound_hit(const PreparedShape& shape, const Ray<double>& ray, CastResult<double>& result);

}  // namespace minkray
