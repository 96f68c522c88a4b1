// SPDX-License-Identifier: MIT
// Distance of two shapes, by the GJK distance algorithm with any of the subalgorithms.
#pragma once

#include <functional>

#include "core/gjk/gjk_distance.h"
#include "core/gjk/subalgorithm.h"
#include "core/model/centred_shape.h"

namespace minkray {

template <class T>
using DistanceObserver = std::function<void(const DistanceIteration<T, 3>&)>;

/// Points and axis are in the world. The error of the distance is a few epsilon of the distance and
/// of the sizes; for curved shapes in double at most 1e-9. `lower` is a lower bound. Shapes that
/// touch count as overlapping, unless the result is exhausted. The observer receives every
/// iteration except those of a retry.
template <class T>
DistanceResult<T, 3> distance_between(const CentredShape<T>& a, const CentredShape<T>& b,
                                      const DistanceOptions<T, 3>& options = {},
                                      SubalgorithmKind subalgorithm = SubalgorithmKind::projection,
                                      const DistanceObserver<T>& observer = {});

/// Distance in the plane: between the shapes' projections onto z = 0.
template <class T>
DistanceResult<T, 2> distance_in_plane(
    const CentredShape<T>& a, const CentredShape<T>& b, const DistanceOptions<T, 2>& options = {},
    SubalgorithmKind subalgorithm = SubalgorithmKind::projection,
    const std::function<void(const DistanceIteration<T, 2>&)>& observer = {});

}  // namespace minkray
