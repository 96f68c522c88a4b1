// SPDX-License-Identifier: MIT
// Rays that are each cast at their own time: what stands still is one world, what moves is posed
// anew for each ray that comes near it. An answer has the same bits as that of a world whose bodies
// were all posed at the ray's time.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/bvh/bvh.h"
#include "core/world/world.h"
#include "renderer/scene/scene.h"

namespace minkray {

/// It refers to the scene. Instances are numbered as make_world numbers them.
class MovingScene {
 public:
  explicit MovingScene(const Scene& scene);

  /// How many bodies move.
  std::size_t movers() const { return movers_.size(); }

 private:
  friend class SceneWhile;
  struct Mover {
    std::uint32_t object = 0;
    std::shared_ptr<const ShapeDefinition<double>> definition;  ///< null: it has no shape
  };

  /// What an instance that stands still is called in still_.
  std::uint32_t still_number(std::uint32_t instance) const {
    return instance < place_.size() ? place_[instance]
                                    : instance - static_cast<std::uint32_t>(movers_.size());
  }

  const Scene& scene_;
  World still_;
  std::vector<std::uint32_t> object_of_still_;  ///< empty: all stand still
  std::vector<std::uint32_t> place_;            ///< by object: in still_ or in movers_
  std::vector<Mover> movers_;
};

/// A scene from one moment to a later one; the shorter, the faster. For one thread.
class SceneWhile {
 public:
  SceneWhile(const MovingScene& scene, double begin, double end);

  /// hits[i] answers rays[i], which is cast at times[i], within the while; a ray's own time and
  /// what it skips are not looked at. The more rays, the faster, up to some thousand.
  void closest_hits(std::span<const WorldRay> rays, std::span<const double> times,
                    std::span<WorldHit> hits, QueryCounts& counts);

  WorldHit closest_hit(const WorldRay& ray, double time, QueryCounts& counts);

  /// Where the ray leaves an instance, which is not a half-space; of a mesh, where it has entered.
  CastResult<double> exit(std::uint32_t instance, const Ray<double>& ray, double time);

  bool is_half_space(std::uint32_t instance) const;

 private:
  struct Placed {
    double time = 0;
    bool is_known = false;
    ShapeDefinition<double>::Placement placement;
  };
  bool moves(std::uint32_t instance) const;
  PreparedShape<double> mover_at(std::size_t mover, double time);
  void meet_movers(const WorldRay& ray, double time, WorldHit& closest, QueryCounts& counts);

  const MovingScene& scene_;
  std::vector<std::uint32_t> bodies_, shapeless_;  ///< into movers_
  Bvh bvh_;                                        ///< of the boxes that bodies_ sweep
  std::vector<Placed> placed_;                     ///< by mover: where it was asked for last
};

}  // namespace minkray
