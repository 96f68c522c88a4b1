// SPDX-License-Identifier: MIT
// Pairs of near bodies, within a robot or scene or between files, at one time: signed distances
// with bounds.
#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "renderer/clearance/bodies.h"

namespace minkray {

struct PosedBodies {
  std::vector<ClearanceBody> bodies;
  std::vector<Affine<double>> poses;  ///< of the bodies' frames in the world; rigid
  std::vector<LinkPlace> places;      ///< of a robot's bodies; empty: of a scene's

  /// Adds those of another one, which are a scene's from then on.
  void append(PosedBodies&& others);
};

/// The shapes that `geometry` chooses, where the joints' values place them.
PosedBodies posed_bodies(const Model& model, GeometryChoice geometry);
PosedBodies posed_bodies(const Scene& scene);

struct NearBodies {
  std::size_t a = 0, b = 0;
  SignedDistance distance;
};

struct NearBodiesOptions {
  double within = std::numeric_limits<double>::infinity();
  double tolerance = SignedDistanceOptions{}.tolerance;
};

/// Pairs of a body of the first and one of the others, numbered after them, whose distance is not
/// proven to be above `within`; and of two of the first that `wanted` wants. The nearest come
/// first, those whose distance is unknown last. Two half-spaces are no pair. Throws BadInput if
/// `within` is infinite and there are more than most_pairs.
std::vector<NearBodies> near_bodies(const PosedBodies& first, const PosedBodies& others,
                                    const std::function<bool(std::size_t, std::size_t)>& wanted,
                                    const NearBodiesOptions& options);

}  // namespace minkray
