// SPDX-License-Identifier: MIT
// Follows a ray through nested clear bodies. Entries and exits are cast one by one, so rounding
// cannot put the ray on the wrong side, and no offset is needed. A ray that leaves a convex body
// does not meet it again; one that enters it leaves at the exit found by cast_exit.
#pragma once

#include <array>
#include <span>

#include "core/world/world.h"

namespace minkray {

/// The bodies that hold a place, in the order in which they were entered.
class Inside {
 public:
  /// No place is held by more.
  static constexpr std::size_t most = 16;

  bool none() const { return count_ == 0; }
  std::span<const std::uint32_t> bodies() const { return std::span(bodies_).first(count_); }
  bool holds(std::uint32_t body) const;

  /// False if there is no room.
  bool enter(std::uint32_t body);
  void leave(std::uint32_t body);

 private:
  std::array<std::uint32_t, most> bodies_;
  std::size_t count_ = 0;
};

/// Largest half extents of a world's instances, which many rays in turn need: the last ones are
/// kept.
class HalfExtents {
 public:
  /// Forgets all, for a world that was changed, or for another one.
  void begin(const World& world);
  double of(std::uint32_t instance);

 private:
  struct Kept {
    std::uint32_t instance = no_instance;
    double half_extent = 0;
  };
  const World* world_ = nullptr;
  std::array<Kept, 256> kept_;  ///< by the last bits of the instance
};

/// The next boundary along a ray.
struct Boundary {
  std::uint32_t instance = no_instance;  ///< none: the ray is unbounded
  std::uint32_t part = no_part;          ///< the triangle of a mesh
  bool leaves = false;                   ///< goes out of the body, not in
  bool is_within = false;  ///< the ray begins in a body that it was not known to be in
  bool is_lost = false;    ///< the solver did not converge
  double t = 0;
  Vec3<double> normal = Vec3<double>::Zero();  ///< outward
};

/// The first body entered or left. `left` is the instance whose surface the ray begins on. Where a
/// body is entered within rounding of where another is left, it is entered: an object on glass is
/// seen through the glass.
Boundary next_boundary(const World& world, const WorldRay& ray, const Inside& inside,
                       QueryCounts& counts);

/// Same for several rays, with the bodies around each ray. Casts exits from one body together.
void next_boundaries(const World& world, std::span<const WorldRay> rays,
                     std::span<const Inside* const> insides, std::span<Boundary> nexts,
                     HalfExtents& half_extents, QueryCounts& counts);

/// Length of a ray within the body that it has met, or begins in; 0 if it met none.
double length_within(const World& world, const Ray<double>& ray, const WorldHit& hit);

/// A hit of the world as the boundary that it is.
Boundary boundary_of(const WorldHit& hit);

/// Error bound of hit points, in lengths: a few hundred roundings of the largest number that went
/// into them.
double rounding_at(const World& world, std::uint32_t instance, const Vec3<double>& point, double t);
/// Same, by the half extent of the instance.
double rounding_at(double half_extent, const Vec3<double>& point, double t);

}  // namespace minkray
