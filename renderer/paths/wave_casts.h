// SPDX-License-Identifier: MIT
// Casts the rays of a wave, and reports them to the observer, if any.
#pragma once

#include <span>
#include <vector>

#include "renderer/paths/integrator_options.h"

namespace minkray {

/// Refers to the world.
class WaveCasts {
 public:
  WaveCasts(const World& world, const IntegratorOptions& options)
      : world_(world), observer_(options.observer) {}

  /// hits[i] answers rays[i], which is of the kind kind_of(i).
  template <class KindOf>
  void find_hits(const KindOf& kind_of, std::span<const WorldRay> rays, std::vector<WorldHit>& hits,
                 QueryCounts& counts) const {
    hits.resize(rays.size());
    world_.closest_hits(rays, hits, counts);
    for (std::size_t i = 0; observer_ && i < rays.size(); ++i)
      observer_->closest(kind_of(i), rays[i].ray, rays[i].skip, hits[i]);
  }
  /// met[i] answers rays[i].
  void find_blocked(RayKind kind, std::span<const WorldRay> rays, std::vector<std::uint8_t>& met,
                    QueryCounts& counts) const;

 private:
  const World& world_;
  RayObserver* observer_;
};

}  // namespace minkray
