// SPDX-License-Identifier: MIT
// Casts many rays at one posed mesh: faster than single casts, with the same results.
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
/// Calls take(i, cast) with cast_ray of queries[i], in their order.
template <class Take>
void cast_rays(const PosedMesh& posed, std::span<const MeshQuery> queries, PartCounts& counts,
               Take&& take) {
  const auto plain = [](void* context, std::size_t i, const MeshCast& cast) {
    (*static_cast<std::remove_reference_t<Take>*>(context))(i, cast);
  };
  cast_for(posed, queries, counts, CastTaker{plain, &take});
}
/// Sets met[i] to 1 if is_met is true for queries[i], to 0 if not; ignores `most` and `loss`.
void are_met(const PosedMesh& posed, std::span<const MeshQuery> queries,
             std::span<std::uint8_t> met, PartCounts& counts);

}  // namespace minkray
