// SPDX-License-Identifier: MIT
// Many shapes, and which of them a ray meets: joins the hierarchy of boxes with the solvers.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "core/bvh/bvh.h"
#include "core/cast/cast.h"
#include "core/cast/packet_cast.h"
#include "core/world/instances.h"
#include "core/world/world_ray.h"

namespace minkray {

struct SingleRay;
struct SingleWorld;
struct SlabRay;

/// Answers of up to 64 rays that follow each other, in packets of four.
struct BlockHits {
  std::array<CastPacket<double>, 16> casts;
  std::array<std::uint32_t, 64> instance;
  std::uint64_t found;  ///< bits of rays whose answers are hits, or inside
};

/// Receives the answers of many rays, in parts, in any order. Each ray is answered once.
class HitReceiver {
 public:
  virtual ~HitReceiver() = default;
  /// `exhausted`: a solver failed to converge at any instance.
  virtual void take(std::size_t ray, const WorldHit& hit, bool exhausted) = 0;
  /// Rays from `first` on whose bits are set in `which`.
  virtual void take(std::size_t first, std::uint64_t which, const BlockHits& hits) = 0;
};

/// Any number of threads may query a world while none changes it. A result depends on nothing but
/// the ray: it is the same bit for bit for a single ray and within a batch, and for any hierarchy.
class World {
 public:
  World() = default;
  explicit World(Instances instances, const CastOptions<double>& options = {},
                 BvhBuild build = BvhBuild::quality);

  /// The instance that the ray meets first, with 0 <= t <= t_max; where several are met at the
  /// same t, that of the least index. `skip` is left out: a ray that leaves a convex shape does
  /// not meet it again. On a mesh, only the part nearest to the ray's origin is left out
  /// (leaving_mesh). A cast that does not converge is neither a hit nor a miss; check
  /// `counts.exhausted`.
  WorldHit closest_hit(const Ray<double>& ray, QueryCounts& counts,
                       std::uint32_t skip = no_instance, double time = 0) const {
    return closest_hit(WorldRay{ray, skip, time}, counts);
  }
  WorldHit closest_hit(const WorldRay& ray, QueryCounts& counts) const;

  /// True if any instance but `skip` is met with 0 <= t <= t_max.
  bool occluded(const Ray<double>& ray, QueryCounts& counts, std::uint32_t skip = no_instance,
                double time = 0) const {
    return occluded(WorldRay{ray, skip, time}, counts);
  }
  bool occluded(const WorldRay& ray, QueryCounts& counts) const;

  /// Answers any number of rays; faster the more there are, and the closer neighbours run together.
  void closest_hits(const RaySpan& rays, HitReceiver& to, QueryCounts& counts) const;
  /// hits[i] answers rays[i].
  void closest_hits(std::span<const WorldRay> rays, std::span<WorldHit> hits,
                    QueryCounts& counts) const;
  /// met[i] becomes 1 if rays[i] is occluded, 0 if not.
  void occluded(const RaySpan& rays, std::span<std::uint8_t> met, QueryCounts& counts) const;
  void occluded(std::span<const WorldRay> rays, std::span<std::uint8_t> met,
                QueryCounts& counts) const {
    occluded(RaySpan(rays), met, counts);
  }

  /// Moves all instances: the i-th to pose_of(i), which several threads call at once, and with a
  /// movement_of, from there along movement_of(i) while time goes from 0 to 1. The hierarchy stays
  /// the same tree around other boxes, unless these make rays visit half as much again: then it is
  /// rebuilt.
  void pose_all(const std::function<Affine<double>(std::size_t)>& pose_of,
                const std::function<Movement<double>(std::size_t)>& movement_of = {});

  /// Moves one instance; rays find it there once pose_all was called.
  void set_pose(std::size_t i, const Affine<double>& pose) { instances_.set_pose(i, pose); }

  const Instances& instances() const { return instances_; }
  /// Takes the instances out, to be changed and made a world of again.
  Instances release() && { return std::move(instances_); }
  const Bvh& bvh() const { return bvh_; }
  const CastOptions<double>& options() const { return options_; }

  /// Memory of instances and hierarchy, without the points of hulls, which shapes share.
  std::size_t bytes() const { return bvh_.bytes() + mesh_boxes_.bytes() + instances_.bytes(); }

 private:
  void build(const FirstTouchVector<Bounds<float>>& boxes);
  std::vector<Bounds<float>> boxes_of_meshes(const FirstTouchVector<Bounds<float>>& boxes) const;
  /// Casts at an instance that does not move, with the default options.
  CastResult<double> cast_at_rest(std::uint32_t instance, const Ray<double>& ray) const;
  /// Tries float lanes first; false if they do not decide.
  bool closer_candidate(const WorldRay& ray, WorldHit& closest, QueryCounts& counts) const;
  SingleRay single_ray(const WorldRay& ray) const;
  SingleWorld single_world() const;
  void closer_hit(const WorldRay& ray, SlabRay& slabs, WorldHit& closest,
                  QueryCounts& counts) const;
  /// Half-spaces are in no hierarchy, meshes in one of their own: all but shapes. True if one is
  /// met before the closest so far.
  bool closer_shapeless(const WorldRay& ray, WorldHit& closest, QueryCounts& counts) const;
  bool closer_half_space(const WorldRay& ray, WorldHit& closest, QueryCounts& counts) const;
  bool closer_mesh(const WorldRay& ray, WorldHit& closest, QueryCounts& counts) const;
  bool blocked_by_shapeless(const WorldRay& ray, QueryCounts& counts) const;
  /// Finds the closest of these for many rays, which pass through each mesh together. Sets
  /// is_exhausted[i] to 1 where a cast of rays[i] does not converge.
  void closest_shapeless(const RaySpan& rays, std::span<WorldHit> closest,
                         std::span<std::uint8_t> is_exhausted, QueryCounts& counts) const;
  /// Sets met[i] to 1 or 0.
  void blocked_by_shapeless(const RaySpan& rays, std::span<std::uint8_t> met,
                            QueryCounts& counts) const;

  /// False if the rays are no block: nothing was answered.
  bool answer_block(const RaySpan& rays, std::size_t first, HitReceiver& to,
                    QueryCounts& counts) const;
  /// At most rays_of_stream rays that go each their own way; they are the caller's from `first` on.
  void answer_stream(const RaySpan& rays, std::size_t first, HitReceiver& to,
                     QueryCounts& counts) const;
  void occluded_in_stream(const RaySpan& rays, std::span<std::uint8_t> met,
                          QueryCounts& counts) const;
  /// True if float lanes may screen pairs first.
  bool has_screen() const;
  auto prefetching() const {
    return [this](std::uint32_t instance) { instances_.prefetch(instance); };
  }

  Instances instances_;
  Bvh bvh_;         ///< of instances with shapes
  Bvh mesh_boxes_;  ///< of meshes, by their order
  BvhBuild build_ = BvhBuild::quality;
  bool has_repeated_ = false;   ///< instances that the hierarchy leaves out
  double visits_as_built_ = 0;  ///< expected per ray; 0: not known yet
  CastOptions<double> options_;
  bool is_default_ = true;  ///< the options are those of packets and closed forms
  FormKind kind_of_all_ = FormKind::none;
};

/// Rays whose numbers stay in the cache while they are under way.
inline constexpr std::size_t rays_of_stream = 1024;

}  // namespace minkray
