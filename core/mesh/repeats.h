// SPDX-License-Identifier: MIT
// Triangles that a mesh has more than once: a ray crosses them once.
#pragma once

#include <algorithm>
#include <vector>

#include "core/mesh/mesh_ray.h"

namespace minkray {

/// True if both triangles have their corners at the same positions, in the same order around.
inline bool is_repeat(const TriangleMesh& mesh, std::uint32_t a, std::uint32_t b) {
  for (std::size_t from = 0; from < 3; ++from) {
    bool is_same = true;
    for (std::size_t k = 0; k < 3; ++k)
      is_same = is_same && mesh.corner(a, k) == mesh.corner(b, (from + k) % 3);
    if (is_same) return true;
  }
  return false;
}

/// Erases all but the first hit of repeated triangles. The hits must be sorted by t.
inline void erase_repeats(const TriangleMesh& mesh, std::vector<PartHit>& hits) {
  std::size_t kept = 0;
  double widest = 0;
  for (const PartHit& hit : hits) {
    bool is_new = true;
    widest = std::max(widest, hit.error);
    for (std::size_t i = kept; i > 0 && is_new; --i) {
      if (hits[i - 1].t + widest < hit.t - hit.error) break;
      is_new = !is_repeat(mesh, hits[i - 1].part, hit.part);
    }
    if (is_new) hits[kept++] = hit;
  }
  hits.resize(kept);
}

}  // namespace minkray
