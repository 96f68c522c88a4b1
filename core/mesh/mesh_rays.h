// SPDX-License-Identifier: MIT
// Casts many rays at one mesh. Faster than single casts (mesh_ray.h), with the same results.
#pragma once

#include <span>

#include "core/mesh/mesh_ray.h"

namespace minkray {

struct PartRay {
  Ray<double> ray;
  double t_min = 0;
};

/// Sets hits[i] to closest_part of rays[i].
void closest_parts(const TriangleMesh& mesh, std::span<const PartRay> rays, std::span<PartHit> hits,
                   PartCounts& counts);
/// Sets met[i] to 1 if meets_part is true for rays[i], to 0 if not.
void meet_parts(const TriangleMesh& mesh, std::span<const PartRay> rays,
                std::span<std::uint8_t> met, PartCounts& counts);

}  // namespace minkray
