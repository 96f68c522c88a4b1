// SPDX-License-Identifier: MIT
// How the rays of a wave are cast: neighbours that go side by side in groups, others, each their
// own way, as a stream. The bits are the same. The observer, if there is one, is told.
#pragma once

#include <span>
#include <vector>

#include "renderer/light/integrator_options.h"

namespace minkray {

enum class RaysGo : unsigned char { side_by_side, each_its_way };

/// Refers to the world.
class WaveCasts {
 public:
  WaveCasts(const RenderWorld& world, const IntegratorOptions& options)
      : world_(world),
        observer_(options.observer),
        group_(static_cast<std::size_t>(options.ray_group)) {}

  /// hits[i] answers rays[i], which is of the kind kind_of(i).
  template <class KindOf>
  void find_hits(const KindOf& kind_of, std::span<const WorldRay<Real>> rays, RaysGo how,
                 std::vector<WorldHit<Real>>& hits, QueryCounts& counts) const {
    cast(rays, how, hits, counts);
    for (std::size_t i = 0; observer_ && i < rays.size(); ++i)
      observer_->closest(kind_of(i), rays[i].ray, rays[i].skip, hits[i]);
  }
  /// met[i] answers rays[i].
  void find_blocked(RayKind kind, std::span<const WorldRay<Real>> rays, RaysGo how,
                    std::vector<std::uint8_t>& met, QueryCounts& counts) const;

 private:
  void cast(std::span<const WorldRay<Real>> rays, RaysGo how, std::vector<WorldHit<Real>>& hits,
            QueryCounts& counts) const;
  template <class Cast>
  void in_groups(std::size_t rays, const Cast& cast) const;

  const RenderWorld& world_;
  RayObserver* observer_;
  std::size_t group_;  ///< how many neighbours at most are cast together
};

}  // namespace minkray
