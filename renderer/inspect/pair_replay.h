// SPDX-License-Identifier: MIT
// Replays of two of a scene's objects for the page: their GJK distance, their time of impact when
// one moves straight at the other, and the textbook's sequence in the plane for their shadows.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "renderer/json/json.h"
#include "renderer/scene/scene.h"

namespace minkray {

struct ObjectPair {
  std::size_t a, b;
};

/// The pairs of objects that are closest by their bounding balls, closest first, at most `most`.
/// Half-spaces are in none of them.
std::vector<ObjectPair> nearest_pairs(const Scene& scene, std::size_t most);

/// {"a", "b", "mesh", "distance", "impact", "plane"}: instances, the meshes of A - B, and a replay
/// each. The motion of "impact" is that of b's centre to a's, in one unit of time. An object with a
/// mesh is replaced by its nearest triangle, "triangle_a" or "triangle_b". Nothing if one object
/// lies within the other's mesh.
std::optional<Json> pair_json(const Scene& scene, const ObjectPair& pair);

}  // namespace minkray
