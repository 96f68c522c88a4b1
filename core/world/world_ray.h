// SPDX-License-Identifier: MIT
// Rays and results of a World, and views of many rays without a copy.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <span>

#include "core/query/result.h"
#include "core/world/instances.h"

namespace minkray {

/// Cost of queries, and how often a solver failed to converge, summed over rays.
struct QueryCounts {
  std::uint64_t nodes = 0;  ///< visited BVH nodes; a block of rays counts each visit once
  std::uint64_t casts = 0;  ///< casts at single shapes
  std::uint64_t iterations = 0;
  std::uint64_t supports = 0;
  std::array<std::uint64_t, path_count> by_path =
      {};                       ///< number of `casts` that ended on each path
  std::uint64_t exhausted = 0;  ///< casts that did not converge; the ray continues

  std::uint64_t answered_by(Path path) const { return by_path[static_cast<std::size_t>(path)]; }

  /// Returns the latest stage (Path) that any cast needed; without casts, the first one.
  Path furthest_path() const {
    std::size_t path = path_count - 1;
    while (path > 0 && by_path[path] == 0) --path;
    return static_cast<Path>(path);
  }

  void add_cast(int its_supports, int its_iterations, Path path, bool is_exhausted) {
    ++casts;
    iterations += static_cast<std::uint64_t>(its_iterations);
    supports += static_cast<std::uint64_t>(its_supports);
    ++by_path[static_cast<std::size_t>(path)];
    exhausted += is_exhausted ? 1 : 0;
  }
  void add_cast(const CastResult<double>& result) {
    add_cast(result.supports, result.iterations, result.path, result.status == Status::exhausted);
  }
  void add_parts(const PartCounts& parts) {
    nodes += parts.nodes;
    add_filtered(parts.triangles);
  }
  /// Adds `count` casts that the closed form decided.
  void add_filtered(std::uint64_t count) {
    casts += count;
    by_path[static_cast<std::size_t>(Path::filter)] += count;
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
struct WorldHit {
  std::uint32_t instance = no_instance;
  CastResult<double> cast;       ///< hit or inside; miss if the ray meets no instance
  std::uint32_t part = no_part;  ///< number of the part, for a mesh or compound

  static WorldHit miss() {
    WorldHit none;
    none.cast.status = Status::miss;
    return none;
  }
  bool found() const { return instance != no_instance; }
  /// True if a hit of the instance `other` at t comes before this hit.
  bool yields_to(std::uint32_t other, double t) const {
    return !found() || t < cast.t() || (t == cast.t() && other < instance);
  }
};

/// A point where a ray enters or leaves an instance.
struct WorldCrossing {
  std::uint32_t instance = no_instance;
  std::uint32_t part = no_part;      ///< number of the part, for a mesh or compound
  double t = 0, t_lo = 0, t_hi = 0;  ///< t and its bounds
  Vec3<double> point, normal;        ///< outward normal; for a mesh, by the order of vertices
  bool leaves = false;
};

/// A ray with its time (0 to 1), its kinds, and an instance to skip. The ray hits only instances
/// that are shown to one of its kinds.
struct WorldRay {
  Ray<double> ray;
  std::uint32_t skip = no_instance;
  double time = 0;
  RayKinds kinds = all_ray_kinds;

  /// True if the ray ignores the instance: it is skipped, or not shown to the ray's kinds.
  bool passes(const Instances& instances, std::uint32_t instance) const {
    return instance == skip || !instances.is_shown_to(instance, kinds);
  }
};

/// View of the caller's array of rays (WorldRays or plain rays), which are a fixed number of bytes
/// apart. Plain rays skip no instance, have time 0 and are of all kinds.
class RaySpan {
 public:
  RaySpan(std::span<const WorldRay> rays)
      : first_(rays.empty() ? nullptr : reinterpret_cast<const char*>(&rays.front().ray)),
        stride_(sizeof(WorldRay)),
        size_(rays.size()),
        has_more_(true) {}
  RaySpan(const Ray<double>* first, std::size_t stride, std::size_t size)
      : first_(reinterpret_cast<const char*>(first)), stride_(stride), size_(size) {}

  std::size_t size() const { return size_; }
  std::size_t stride() const { return stride_; }
  const char* data() const { return first_; }
  const Ray<double>& ray(std::size_t i) const {
    return *reinterpret_cast<const Ray<double>*>(first_ + i * stride_);
  }
  WorldRay operator[](std::size_t i) const { return has_more_ ? more(i) : WorldRay{ray(i)}; }
  RaySpan part(std::size_t from, std::size_t count) const {
    RaySpan part = *this;
    part.first_ += from * stride_;
    part.size_ = count;
    return part;
  }

  std::uint32_t skip(std::size_t i) const { return has_more_ ? more(i).skip : no_instance; }
  double time(std::size_t i) const { return has_more_ ? more(i).time : 0; }
  RayKinds kinds(std::size_t i) const { return has_more_ ? more(i).kinds : all_ray_kinds; }
  bool passes(const Instances& instances, std::size_t i, std::uint32_t instance) const {
    return instance == skip(i) || !instances.is_shown_to(instance, kinds(i));
  }

 private:
  /// Converts the pointer, since a WorldRay begins with its ray.
  const WorldRay& more(std::size_t i) const {
    return *reinterpret_cast<const WorldRay*>(first_ + i * stride_);
  }

  const char* first_;
  std::size_t stride_, size_;
  bool has_more_ = false;
};

}  // namespace minkray
