// SPDX-License-Identifier: MIT
// Casts many rays at one posed mesh, with the results of single casts but faster.
#pragma once

#include <limits>
#include <span>

#include "core/mesh/mesh_rays.h"
#include "core/parallel/first_touch.h"
#include "core/world/posed_mesh.h"

namespace minkray {

/// Loss of a ray that is mapped to a mesh's frame. Hits alone need the errors of the map itself.
struct MapLoss {
  double before = 0;  ///< error of the ray's position before the map
  int exponent = 0;   ///< the map also multiplies the direction by 2^exponent
};

/// Rays that are cast at one mesh together. One object may serve several meshes in turn, without
/// new allocations.
class RaysAtMesh {
 public:
  /// Forgets all rays. At most `most_rays` are added from now on, for this mesh.
  void begin(const PosedMesh& posed, std::size_t most_rays);
  /// Adds a ray, with the parameters of cast_ray, under the caller's number. Returns false, and
  /// adds nothing, if the direction is zero or numbers are too large.
  bool add(std::uint32_t number, const Ray<double>& ray, double most, bool leaves, double loss);
  std::size_t size() const { return count_; }

  void find_closest(PartCounts& counts);
  /// Calls take(number, cast) for each ray that hits the mesh, or whose cast is exhausted, with the
  /// result of cast_ray. ray_of(number) returns the ray that was added. Only after find_closest.
  template <class RayOf, class Take>
  void each_closest(RayOf&& ray_of, Take&& take) const {
    OriginLoss last;
    for (std::size_t i = 0; i < count_; ++i) {
      if (!hits_[i].found()) continue;
      if (const PartCast cast = closest(i, ray_of(numbers_[i]), last);
          cast.cast.status != Status::miss)
        take(numbers_[i], cast);
    }
  }
  /// Sets met[number] to 1 for each ray for which is_met is true.
  void find_any(std::span<std::uint8_t> met, PartCounts& counts);

 private:
  /// Error of an origin that the map adds; neighbours often share it.
  struct OriginLoss {
    Vec3<double> origin = Vec3<double>::Constant(std::numeric_limits<double>::quiet_NaN());
    double loss = 0;
  };
  PartCast closest(std::size_t i, const Ray<double>& ray, OriginLoss& last) const;

  const PosedMesh* posed_ = nullptr;
  std::size_t count_ = 0;
  Vec3<double> last_origin_;  ///< origin of the last ray, in the world
  FirstTouchVector<PartRay> rays_;
  FirstTouchVector<MapLoss> losses_;
  FirstTouchVector<std::uint32_t> numbers_;
  FirstTouchVector<PartHit> hits_;
  FirstTouchVector<std::uint8_t> met_;
};

}  // namespace minkray
