// SPDX-License-Identifier: MIT
// Distance of two shapes, by the GJK distance algorithm with any of the subalgorithms.
#pragma once

#include <functional>

#include "renderer/paper/centred_shape.h"
#include "renderer/paper/gjk_distance.h"
#include "renderer/paper/subalgorithm.h"

namespace minkray {

using DistanceObserver = std::function<void(const DistanceIteration<double, 3>&)>;

/// Returns the distance of A and B. Points and axis are in the world. The error of the distance is
/// a few epsilon of the sum of the distance and the shapes' sizes; for curved shapes, at most 1e-9
/// of this sum. `lower` is a lower bound of the distance. For touching shapes the status is
/// overlapping, or exhausted if the solver does not converge. If the result is too coarse, the
/// query runs again in long double, without the observer.
DistanceResult<double, 3> distance_between(
    const CentredShape& a, const CentredShape& b, const DistanceOptions<double, 3>& options = {},
    SubalgorithmKind subalgorithm = SubalgorithmKind::projection,
    const DistanceObserver& observer = {});

/// Returns the distance of the shapes' projections to the plane z = 0.
DistanceResult<double, 2> distance_in_plane(
    const CentredShape& a, const CentredShape& b, const DistanceOptions<double, 2>& options = {},
    SubalgorithmKind subalgorithm = SubalgorithmKind::projection,
    const std::function<void(const DistanceIteration<double, 2>&)>& observer = {});

}  // namespace minkray
