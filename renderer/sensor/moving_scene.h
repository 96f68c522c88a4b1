// SPDX-License-Identifier: MIT
// Casts rays at their own times: bodies at rest are in one world, moving bodies are posed for each
// ray that comes near them. Results have the same bits as in a world with all bodies posed at the
// ray's time.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/bvh/bvh.h"
#include "core/world/world.h"
#include "renderer/scene/scene.h"

namespace minkray {

/// Refers to the scene, which must outlive this. Instances are numbered as by make_world.
class MovingScene {
 public:
  explicit MovingScene(const Scene& scene);

  /// Number of moving bodies.
  std::size_t movers() const { return movers_.size(); }

 private:
  friend class SceneWhile;
  struct Mover {
    std::uint32_t object = 0;
    std::shared_ptr<const ShapeDefinition> definition;  ///< null: the body has no shape
  };

  /// Number in still_ of an instance at rest.
  std::uint32_t still_number(std::uint32_t instance) const {
    return instance < place_.size() ? place_[instance]
                                    : instance - static_cast<std::uint32_t>(movers_.size());
  }

  const Scene& scene_;
  World still_;
  std::vector<std::uint32_t> object_of_still_;  ///< empty: all are at rest
  std::vector<std::uint32_t> place_;            ///< by object: index in still_ or in movers_
  std::vector<Mover> movers_;
};

/// A scene during an interval of time; short intervals are faster. For one thread.
class SceneWhile {
 public:
  SceneWhile(const MovingScene& scene, double begin, double end);

  /// Casts rays[i] at times[i], within the interval, into hits[i]. Ignores the rays' own times and
  /// skipped instances. More rays per call are faster, up to some thousand.
  void closest_hits(std::span<const WorldRay> rays, std::span<const double> times,
                    std::span<WorldHit> hits, QueryCounts& counts);

  WorldHit closest_hit(const WorldRay& ray, double time, QueryCounts& counts);

  /// Finds the exit of the ray from an instance, which must not be a half-space. A ray at a mesh
  /// must start outside and enter it.
  CastResult<double> exit(std::uint32_t instance, const Ray<double>& ray, double time);

  bool is_half_space(std::uint32_t instance) const;

 private:
  struct Placed {
    double time = 0;
    bool is_known = false;
    ShapeDefinition::Placement placement;
  };
  bool moves(std::uint32_t instance) const;
  PreparedShape mover_at(std::size_t mover, double time);
  void meet_movers(const WorldRay& ray, double time, WorldHit& closest, QueryCounts& counts);

  const MovingScene& scene_;
  std::vector<std::uint32_t> bodies_, shapeless_;  ///< indices into movers_
  Bvh bvh_;                                        ///< BVH of the boxes that bodies_ sweep
  std::vector<Placed> placed_;                     ///< by mover: the last placement and its time
};

}  // namespace minkray
