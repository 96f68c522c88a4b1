// SPDX-License-Identifier: MIT
// Many shapes and the question which of them a ray meets: joins the hierarchy of boxes with the
// solvers.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "core/bvh/bvh.h"
#include "core/math/ray.h"
#include "core/solver/cast.h"
#include "core/world/instances.h"

namespace minkray {

/// "No instance": as an answer, nothing was met; as the instance to leave out, none is.
inline constexpr std::uint32_t no_instance = std::numeric_limits<std::uint32_t>::max();

/// What queries cost, and how often a solver gave up. Adds up over rays.
struct QueryCounts {
  std::uint64_t nodes = 0;  ///< boxes tested
  std::uint64_t casts = 0;  ///< shapes cast at
  std::uint64_t iterations = 0;
  std::uint64_t supports = 0;
  std::uint64_t exhausted = 0;  ///< casts that neither hit nor missed; the shape was passed through

  QueryCounts& operator+=(const QueryCounts& other) {
    nodes += other.nodes;
    casts += other.casts;
    iterations += other.iterations;
    supports += other.supports;
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
};

/// Immutable once made, so any number of threads may ask.
template <class T>
class World {
 public:
  World() = default;
  explicit World(Instances<T> instances, const CastOptions<T>& options = {});

  /// The instance that the ray meets first, with 0 <= t <= t_max; where several are met at the same
  /// t, one of them. `skip` is left out: a ray that leaves a convex shape does not meet it again.
  /// Casts that exhaust their solver are counted and taken for neither: the caller must look.
  WorldHit<T> closest_hit(const Ray<T>& ray, QueryCounts& counts,
                          std::uint32_t skip = no_instance) const;

  /// Whether any instance but `skip` is met with 0 <= t <= t_max.
  bool occluded(const Ray<T>& ray, QueryCounts& counts, std::uint32_t skip = no_instance) const;

  const Instances<T>& instances() const { return instances_; }
  const Bvh& bvh() const { return bvh_; }
  const CastOptions<T>& options() const { return options_; }

  /// Memory of instances and hierarchy, without the points of hulls, which shapes share.
  std::size_t bytes() const { return bvh_.bytes() + instances_.bytes(); }

 private:
  Instances<T> instances_;
  Bvh bvh_;
  CastOptions<T> options_;
};

extern template class World<float>;
extern template class World<double>;

}  // namespace minkray
