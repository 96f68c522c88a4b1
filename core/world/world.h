// SPDX-License-Identifier: MIT
// Many shapes and the question which of them a ray meets: joins the hierarchy of boxes with the
// solvers.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>

#include "core/bvh/bvh.h"
#include "core/cast/cast.h"
#include "core/math/ray.h"
#include "core/world/instances.h"

namespace minkray {

struct BlockHits;
struct SlabRay;

/// "No instance": as an answer, nothing was met; as the instance to leave out, none is.
inline constexpr std::uint32_t no_instance = std::numeric_limits<std::uint32_t>::max();

/// What queries cost, and how often a solver gave up. Adds up over rays.
struct QueryCounts {
  std::uint64_t nodes = 0;  ///< visited; by rays that go together, once for all of them
  std::uint64_t casts = 0;  ///< shapes cast at
  std::uint64_t iterations = 0;
  std::uint64_t supports = 0;
  std::array<std::uint64_t, path_count> by_path = {};  ///< of `casts`, those that a path answered
  std::uint64_t exhausted = 0;  ///< casts that neither hit nor missed; the shape was passed through

  std::uint64_t answered_by(Path path) const { return by_path[static_cast<std::size_t>(path)]; }

  /// The furthest path that any cast needed; the first, if there was none.
  Path furthest_path() const {
    std::size_t path = path_count - 1;
    while (path > 0 && by_path[path] == 0) --path;
    return static_cast<Path>(path);
  }

  /// One more cast.
  void add_cast(int its_supports, int its_iterations, Path path, bool is_exhausted) {
    ++casts;
    iterations += static_cast<std::uint64_t>(its_iterations);
    supports += static_cast<std::uint64_t>(its_supports);
    ++by_path[static_cast<std::size_t>(path)];
    exhausted += is_exhausted ? 1 : 0;
  }
  template <class T>
  void add_cast(const CastResult<T>& result) {
    add_cast(result.supports, result.iterations, result.path, result.status == Status::exhausted);
  }

  QueryCounts& operator+=(const QueryCounts& other) {
    nodes += other.nodes;
    casts += other.casts;
    iterations += other.iterations;
    supports += other.supports;
    for (std::size_t i = 0; i < by_path.size(); ++i) by_path[i] += other.by_path[i];
    exhausted += other.exhausted;
    return *this;
  }
};

/// The first instance that a ray meets.
template <class T>
struct WorldHit {
  std::uint32_t instance = no_instance;
  CastResult<T> cast;  ///< of that instance (status hit or inside); if none was met, status miss

  bool found() const { return instance != no_instance; }
  /// Whether another instance, met at t, comes before this.
  bool yields_to(std::uint32_t other, T t) const {
    return !found() || t < cast.t() || (t == cast.t() && other < instance);
  }
};

/// A ray, the instance that it leaves, when it is cast (from 0 to 1), and of which kinds it is: it
/// meets what is shown to one of them.
template <class T>
struct WorldRay {
  Ray<T> ray;
  std::uint32_t skip = no_instance;
  T time = T(0);
  RayKinds kinds = all_ray_kinds;

  /// Whether it goes through the instance, whatever that is like.
  bool passes(const Instances<T>& instances, std::uint32_t instance) const {
    return instance == skip || !instances.is_shown_to(instance, kinds);
  }
};

/// So many rays can be asked for at once.
inline constexpr int most_rays_at_once = ray_group_capacity;

/// It is immutable but for pose_all, so any number of threads may ask. An answer depends on nothing
/// but the ray: the same bit for bit whether it is asked for alone or with others, and for whatever
/// hierarchy.
template <class T>
class World {
 public:
  World() = default;
  explicit World(Instances<T> instances, const CastOptions<T>& options = {},
                 BvhBuild build = BvhBuild::quality);

  /// The instance that the ray meets first, with 0 <= t <= t_max; where several are met at the same
  /// t, that of the least index. `skip` is left out: a ray that leaves a convex shape does not meet
  /// it again. Casts that exhaust their solver are counted and taken for neither: the caller must
  /// look.
  WorldHit<T> closest_hit(const Ray<T>& ray, QueryCounts& counts, std::uint32_t skip = no_instance,
                          T time = T(0)) const {
    return closest_hit(WorldRay<T>{ray, skip, time}, counts);
  }
  WorldHit<T> closest_hit(const WorldRay<T>& ray, QueryCounts& counts) const;

  /// Whether any instance but `skip` is met with 0 <= t <= t_max.
  bool occluded(const Ray<T>& ray, QueryCounts& counts, std::uint32_t skip = no_instance,
                T time = T(0)) const {
    return occluded(WorldRay<T>{ray, skip, time}, counts);
  }
  bool occluded(const WorldRay<T>& ray, QueryCounts& counts) const;

  /// Answers up to most_rays_at_once rays, faster the closer together they run. hits[i] answers
  /// rays[i].
  void closest_hits(std::span<const WorldRay<T>> rays, std::span<WorldHit<T>> hits,
                    QueryCounts& counts) const;

  /// Bit i answers rays[i].
  RayGroupMask occluded(std::span<const WorldRay<T>> rays, QueryCounts& counts) const;

  /// Answer any number of rays that go each their own way.
  void closest_hits_in_stream(std::span<const WorldRay<T>> rays, std::span<WorldHit<T>> hits,
                              QueryCounts& counts) const;
  /// met[i] becomes 1 if rays[i] is occluded, 0 if not.
  void occluded_in_stream(std::span<const WorldRay<T>> rays, std::span<std::uint8_t> met,
                          QueryCounts& counts) const;

  /// Answers any number of rays, those that follow each other and run alike together, others as
  /// a stream.
  void closest_hits_of_all(std::span<const WorldRay<T>> rays, std::span<WorldHit<T>> hits,
                           QueryCounts& counts) const;

  /// Answers up to 64 rays from one point that run nearly alike (core/world/ray_block.h), which follow
  /// each other `stride` bytes apart; false if they do not run so, or instances are not alike.
  bool closest_of_block(const Ray<T>* rays, std::size_t stride, std::size_t count, BlockHits& hits,
                        QueryCounts& counts) const;

  /// Moves all instances: the i-th to pose_of(i), which is asked from several threads at once, and
  /// if there is a movement_of, from there as that says while time goes from 0 to 1. The
  /// hierarchy stays the same tree around other boxes, unless these make rays visit half as much
  /// again: then it is built anew.
  void pose_all(const std::function<Affine<T>(std::size_t)>& pose_of,
                const std::function<Movement<T>(std::size_t)>& movement_of = {});

  const Instances<T>& instances() const { return instances_; }
  const Bvh& bvh() const { return bvh_; }
  const CastOptions<T>& options() const { return options_; }

  /// Memory of instances and hierarchy, without the points of hulls, which shapes share.
  std::size_t bytes() const { return bvh_.bytes() + instances_.bytes(); }

 private:
  /// The ray is made ready. They tell what comes before the closest hit so far, if any; and whether
  /// anything is met.
  void closer_hit(const WorldRay<T>& ray, SlabRay& slabs, WorldHit<T>& closest,
                  QueryCounts& counts) const;
  bool is_blocked(const WorldRay<T>& ray, const SlabRay& slabs, QueryCounts& counts) const;
  /// They look at half-spaces alone, which are in no hierarchy.
  bool closer_half_space(const WorldRay<T>& ray, WorldHit<T>& closest, QueryCounts& counts) const;
  bool blocked_by_half_space(const WorldRay<T>& ray, QueryCounts& counts) const;

  /// Answer so many rays of a stream as stay in the cache.
  void closest_of_pairs(std::span<const WorldRay<T>> rays, std::span<WorldHit<T>> hits,
                        QueryCounts& counts) const;
  void occluded_of_pairs(std::span<const WorldRay<T>> rays, std::span<std::uint8_t> met,
                         QueryCounts& counts) const;
  /// Likewise, where lanes look at all instances alike (Instances::kind_of_all).
  void closest_of_alike(std::span<const WorldRay<T>> rays, std::span<WorldHit<T>> hits,
                        QueryCounts& counts) const;
  void occluded_of_alike(std::span<const WorldRay<T>> rays, std::span<std::uint8_t> met,
                         QueryCounts& counts) const;
  /// What walks call with instances that they may come to.
  auto prefetching() const {
    return [this, have_own_maps = instances_.have_own_maps()](std::uint32_t instance) {
      instances_.prefetch_place(instance);
      if (have_own_maps) instances_.prefetch_own_map(instance);
    };
  }
  /// Whether lanes of floats may look at pairs first.
  bool has_screen() const;

  Instances<T> instances_;
  Bvh bvh_;
  BvhBuild build_ = BvhBuild::quality;
  double visits_as_built_ = 0;  ///< expected of a ray; 0: not asked for yet
  CastOptions<T> options_;
  bool in_packets_ = true;  ///< whether the options are those of packets
};

extern template class World<float>;
extern template class World<double>;

}  // namespace minkray
