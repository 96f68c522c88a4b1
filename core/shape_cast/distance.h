// SPDX-License-Identifier: MIT
// Distance of two shapes, by the GJK distance algorithm with any of the subalgorithms.
#pragma once

#include <functional>

#include "core/gjk/gjk_distance.h"
#include "core/gjk/subalgorithm.h"
#include "core/model/centred_shape.h"

namespace minkray {

using DistanceObserver = std::function<void(const DistanceIteration<double, 3>&)>;

/// Points and axis are in the world. The distance is exact to a few epsilon of itself and of the
/// sizes, of curved shapes in double to 1e-9 at worst; `lower` bounds it. Touching counts as
/// overlapping, unless it is exhausted. The observer sees every iteration but those of a retry.
DistanceResult<double, 3> distance_between(
    const CentredShape& a, const CentredShape& b, const DistanceOptions<double, 3>& options = {},
    SubalgorithmKind subalgorithm = SubalgorithmKind::projection,
    const DistanceObserver& observer = {});

/// Measures in the plane: between the shapes' shadows on z = 0.
DistanceResult<double, 2> distance_in_plane(
    const CentredShape& a, const CentredShape& b, const DistanceOptions<double, 2>& options = {},
    SubalgorithmKind subalgorithm = SubalgorithmKind::projection,
    const std::function<void(const DistanceIteration<double, 2>&)>& observer = {});

}  // namespace minkray
