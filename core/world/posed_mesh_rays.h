// SPDX-License-Identifier: MIT
// Casts many rays at one posed mesh, with the results of single casts but faster.
#pragma once

#include <span>

#include "core/world/posed_mesh.h"

namespace minkray {

/// Parameters of a ray for cast_ray.
struct MeshQuery {
  Ray<double> ray;
  double most = std::numeric_limits<double>::infinity();
  bool leaves = false;
  double loss = 0;
};

struct CastTaker {
  void (*take)(void* context, std::size_t i, const MeshCast& cast);
  void* context;
};
void cast_for(const PosedMesh& posed, std::span<const MeshQuery> queries, PartCounts& counts,
              const CastTaker& taker);
/// Calls take(i, cast) for each query in order; `cast` is the result of cast_ray for queries[i].
template <class Take>
void cast_rays(const PosedMesh& posed, std::span<const MeshQuery> queries, PartCounts& counts,
               Take&& take) {
  const auto plain = [](void* context, std::size_t i, const MeshCast& cast) {
    (*static_cast<std::remove_reference_t<Take>*>(context))(i, cast);
  };
  cast_for(posed, queries, counts, CastTaker{plain, &take});
}
/// Sets met[i] to the result of is_met for queries[i], as 1 or 0. Ignores `most` and `loss`.
void are_met(const PosedMesh& posed, std::span<const MeshQuery> queries,
             std::span<std::uint8_t> met, PartCounts& counts);

}  // namespace minkray
