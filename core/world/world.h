// SPDX-License-Identifier: MIT
// A world of instances: finds the first instance that a ray hits, using the BVH and solvers.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "core/bvh/bvh.h"
#include "core/cast/cast.h"
#include "core/cast/packet_cast.h"
#include "core/world/instances.h"
#include "core/world/repeated.h"
#include "core/world/world_ray.h"

namespace minkray {

struct SingleRay;
struct SingleWorld;
struct SlabRay;

/// Results of up to 64 consecutive rays, stored in packets of four.
struct BlockHits {
  std::array<CastPacket, 16> casts;
  std::array<std::uint32_t, 64> instance;
  std::uint64_t found;  ///< bit i is set if ray i hits an instance or starts inside one
};

/// Receives the results of many rays: exactly one per ray, in any order, one by one or up to 64 in
/// one call.
class HitReceiver {
 public:
  virtual ~HitReceiver() = default;
  /// Takes the result of one ray. `exhausted` is true if a cast at any instance did not converge.
  virtual void take(std::size_t ray, const WorldHit& hit, bool exhausted) = 0;
  /// Takes the results of several rays: of ray `first` + i for each bit i that is set in `which`.
  virtual void take(std::size_t first, std::uint64_t which, const BlockHits& hits) = 0;
};

/// Any number of threads may query a world while no thread changes it. The result of a ray has the
/// same bits in any batch that contains the ray, and with any BVH.
class World {
 public:
  World() = default;
  explicit World(Instances instances, const CastOptions& options = {},
                 BvhBuild build = BvhBuild::quality);

  /// Returns the first instance that the ray hits with 0 <= t <= t_max. If several are hit at the
  /// same t, returns the one with the least index. `skip` is the instance on whose surface the ray
  /// starts: if it is a convex shape, it is ignored; if it is a mesh, it is ignored only very near
  /// the ray's origin (leaving_mesh). A cast that does not converge is neither a hit nor a miss;
  /// check `counts.exhausted`.
  WorldHit closest_hit(const Ray<double>& ray, QueryCounts& counts,
                       std::uint32_t skip = no_instance, double time = 0) const {
    return closest_hit(WorldRay{ray, skip, time}, counts);
  }
  WorldHit closest_hit(const WorldRay& ray, QueryCounts& counts) const;

  /// True if the ray hits any instance except `skip` with 0 <= t <= t_max.
  bool occluded(const Ray<double>& ray, QueryCounts& counts, std::uint32_t skip = no_instance,
                double time = 0) const {
    return occluded(WorldRay{ray, skip, time}, counts);
  }
  bool occluded(const WorldRay& ray, QueryCounts& counts) const;

  /// Appends all points with 0 <= t <= t_max where the ray enters or leaves an instance, sorted by
  /// t, then by instance. For an instance that contains the ray's origin, appends only the exit;
  /// for one that contains the ray's end, only the entry. Ignores `skip` completely.
  void all_hits(const WorldRay& ray, std::vector<WorldCrossing>& to, QueryCounts& counts) const;

  /// Finds the first hits of many rays. Faster in large batches, and if consecutive rays are
  /// similar (ray_block.h).
  void closest_hits(const RaySpan& rays, HitReceiver& to, QueryCounts& counts) const;
  /// Sets hits[i] to the result of rays[i].
  void closest_hits(std::span<const WorldRay> rays, std::span<WorldHit> hits,
                    QueryCounts& counts) const;
  /// Sets met[i] to 1 if rays[i] is occluded, to 0 if not.
  void occluded(const RaySpan& rays, std::span<std::uint8_t> met, QueryCounts& counts) const;
  void occluded(std::span<const WorldRay> rays, std::span<std::uint8_t> met,
                QueryCounts& counts) const {
    occluded(RaySpan(rays), met, counts);
  }

  /// Moves all instances: the i-th to pose_of(i). With movement_of, the i-th then moves along
  /// movement_of(i) while time goes from 0 to 1. Calls both from several threads at once.
  /// Refits the BVH, or rebuilds it if its expected cost is 1.5 times that after the last build.
  void pose_all(const std::function<Affine<double>(std::size_t)>& pose_of,
                const std::function<Movement<double>(std::size_t)>& movement_of = {});

  /// Moves one instance but not its box. Before the next query, call pose_all with a pose_of that
  /// returns the new pose for this instance.
  void set_pose(std::size_t i, const Affine<double>& pose) { instances_.set_pose(i, pose); }

  const Instances& instances() const { return instances_; }
  /// Moves out the instances, to change them and make a new world.
  Instances release() && { return std::move(instances_); }
  const Bvh& bvh() const { return bvh_; }
  const CastOptions& options() const { return options_; }

  /// Number of rays in different directions to trace together: more if there are many meshes, as
  /// the rays at one mesh are traced together.
  std::size_t rays_at_once() const;

  /// Memory of instances and BVH, without the hulls' points, which are shared.
  std::size_t bytes() const {
    return bvh_.bytes() + mesh_boxes_.bytes() + compound_boxes_.bytes() + instances_.bytes();
  }

 private:
  void build(const FirstTouchVector<Bounds<float>>& boxes);
  void take_boxes_of_parts(const FirstTouchVector<Bounds<float>>& boxes);
  /// Casts at an instance that does not move, with the default options.
  CastResult<double> cast_at_rest(std::uint32_t instance, const Ray<double>& ray) const;
  void add_shape_crossings(const WorldRay& ray, std::uint32_t instance,
                           std::vector<WorldCrossing>& to, QueryCounts& counts) const;
  void add_compound_crossings(const WorldRay& ray, const PosedCompound& compound,
                              std::vector<WorldCrossing>& to, QueryCounts& counts) const;
  void add_shapeless_crossings(const WorldRay& ray, std::vector<WorldCrossing>& to,
                               QueryCounts& counts) const;
  /// Tries to decide the ray in float lanes (SIMD); returns false if the lanes are inconclusive.
  bool closer_candidate(const WorldRay& ray, WorldHit& closest, QueryCounts& counts) const;
  SingleRay single_ray(const WorldRay& ray) const;
  SingleWorld single_world() const;
  void closer_hit(const WorldRay& ray, SlabRay& slabs, WorldHit& closest,
                  QueryCounts& counts) const;
  /// Tests half-spaces, meshes and compounds, which are not in the BVH of the shapes. Returns true
  /// if one is hit before `closest`.
  bool closer_shapeless(const WorldRay& ray, WorldHit& closest, QueryCounts& counts) const;
  bool closer_half_space(const WorldRay& ray, WorldHit& closest, QueryCounts& counts) const;
  bool closer_compound(const WorldRay& ray, WorldHit& closest, QueryCounts& counts) const;
  bool closer_mesh(const WorldRay& ray, WorldHit& closest, QueryCounts& counts) const;
  bool has_others_than_meshes() const {
    return !instances_.half_spaces().empty() || !instances_.compounds().empty();
  }
  /// For half-spaces and compounds.
  bool closer_but_meshes(const WorldRay& ray, WorldHit& closest, QueryCounts& counts) const;
  bool blocked_but_by_meshes(const WorldRay& ray, QueryCounts& counts) const;
  bool blocked_by_shapeless(const WorldRay& ray, QueryCounts& counts) const;
  /// Finds the closest shapeless instance (half-space or mesh) for many rays, mesh by mesh. Sets
  /// is_exhausted[i] to 1 if a cast of rays[i] does not converge.
  void closest_shapeless(const RaySpan& rays, std::span<WorldHit> closest,
                         std::span<std::uint8_t> is_exhausted, QueryCounts& counts) const;
  /// Same as closest_hits, in a world of half-spaces and meshes alone.
  void answer_shapeless(const RaySpan& rays, HitReceiver& to, QueryCounts& counts) const;
  /// Sets met[i] to 1 if a half-space or mesh blocks rays[i], to 0 if not.
  void blocked_by_shapeless(const RaySpan& rays, std::span<std::uint8_t> met,
                            QueryCounts& counts) const;

  /// Traces 16 to 64 rays from one point in similar directions, with one traversal of the BVH
  /// (ray_block.h). Returns false, without results, if the rays are not of this form.
  bool answer_block(const RaySpan& rays, std::size_t first, HitReceiver& to,
                    QueryCounts& counts) const;
  /// Traces a stream: up to rays_of_stream rays in any directions, which traverse the BVH in turns.
  /// Reports the i-th ray to `to` as ray `first` + i.
  void answer_stream(const RaySpan& rays, std::size_t first, HitReceiver& to,
                     QueryCounts& counts) const;
  void occluded_in_stream(const RaySpan& rays, std::span<std::uint8_t> met,
                          QueryCounts& counts) const;
  /// True if the processor and the options allow screening instances in float lanes (screen.h).
  bool has_screen() const;
  auto prefetching() const {
    return [this](std::uint32_t instance) { instances_.prefetch(instance); };
  }

  Instances instances_;
  Bvh bvh_;         ///< contains the instances with shapes
  Bvh mesh_boxes_;  ///< contains the meshes, by their index in Instances::meshes()
  std::vector<Bounds<float>> boxes_of_meshes_;
  Bvh compound_boxes_;  ///< contains the compounds, by their index in Instances::compounds()
  std::vector<Bounds<float>> boxes_of_compounds_;
  BvhBuild build_ = BvhBuild::quality;
  /// Instances left out of the BVH because they repeat others (repeated.h), sorted by the instance
  /// that each repeats.
  std::vector<RepeatedInstance> repeated_;
  double visits_as_built_ = 0;  ///< expected node visits per ray; 0: not known yet
  CastOptions options_;
  bool is_default_ = true;  ///< the options allow packets and closed forms
  FormKind kind_of_all_ = FormKind::none;
};

/// Maximum number of rays in a stream, so that their data fit in the cache.
inline constexpr std::size_t rays_of_stream = 1024;

}  // namespace minkray
