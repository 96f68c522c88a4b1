// SPDX-License-Identifier: MIT
// Finds which of many bodies are near each other, with their signed distances: by a hierarchy of
// boxes that is walked against itself or another one. Not for half-spaces, which have no box.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/bvh/bvh.h"
#include "core/pair_distance/signed_distance.h"
#include "core/parts/parts_body.h"

namespace minkray {

struct ContactBody {
  ContactShape shape;
  Affine<double> pose;  ///< rigid, to the world
  /// Two bodies are a pair if each one's mask has a bit of the other's category.
  std::uint32_t category = 1;
  std::uint32_t mask = ~std::uint32_t{0};
  std::shared_ptr<const TriangleMesh> mesh = {};  ///< if there is one it is that, not the shape

  PartsBody parts() const { return mesh ? PartsBody(*mesh) : PartsBody(shape); }
  bool is_pair_with(const ContactBody& other) const {
    return (category & other.mask) != 0 && (other.category & mask) != 0;
  }
};

/// A box that holds the body: of a shape the least but for a rounding outwards.
inline Bounds<double> bounds_of(const ContactBody& body) {
  return bounds_of(body.parts(), body.pose);
}

/// Bodies with the hierarchy of their boxes. Immutable.
class ContactWorld {
 public:
  explicit ContactWorld(std::vector<ContactBody> bodies);

  const std::vector<ContactBody>& bodies() const { return bodies_; }
  const Bvh& hierarchy() const { return hierarchy_; }

 private:
  std::vector<ContactBody> bodies_;
  Bvh hierarchy_;
};

/// Indices of two bodies, of the first and of the second world; within one world a < b.
struct NearPair {
  std::size_t a = 0, b = 0;
  SignedDistance distance;
};

struct NearPairsOptions {
  double at_most =
      0;  ///< pairs that are further apart are left out; 0: those that overlap or touch
  /// Returns true if the pair of these two indices is wanted, where masks are not enough: allowed
  /// pairs.
  std::function<bool(std::size_t a, std::size_t b)> wanted;
  double tolerance = SignedDistanceOptions{}.tolerance;
};

/// All pairs of a world whose signed distance is not proven to be above `at_most`, in the order of
/// their indices, whatever the number of threads. Those whose distance is unknown are among them.
std::vector<NearPair> near_pairs(const ContactWorld& world, const NearPairsOptions& options);

/// All pairs of a body of one world and one of the other.
std::vector<NearPair> near_pairs(const ContactWorld& first, const ContactWorld& second,
                                 const NearPairsOptions& options);

/// The `count` bodies nearest to another one, the nearest first; fewer if there are fewer. `a` is
/// 0. Masks apply. Bodies whose distance is unknown (SignedDistance::is_unknown()) come last, and
/// only if there are fewer than `count` others. Those that are proven to be further away than
/// `at_most` are left out.
std::vector<NearPair> nearest_bodies(const ContactBody& to, const ContactWorld& world,
                                     std::size_t count,
                                     double at_most = std::numeric_limits<double>::infinity());

}  // namespace minkray
