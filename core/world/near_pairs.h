// SPDX-License-Identifier: MIT
// Finds pairs of near bodies among many, and their signed distances, by traversing a BVH against
// itself or another BVH. Half-spaces are not supported, since they have no box.
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
  /// Two bodies are a pair only if each body's mask has a bit of the other's category.
  std::uint32_t category = 1;
  std::uint32_t mask = ~std::uint32_t{0};
  std::shared_ptr<const TriangleMesh> mesh =
      {};  ///< if not null, the body is this mesh instead of the shape

  PartsBody parts() const { return mesh ? PartsBody(*mesh) : PartsBody(shape); }
  bool is_pair_with(const ContactBody& other) const {
    return (category & other.mask) != 0 && (other.category & mask) != 0;
  }
};

/// Bounding box of the body; tight up to rounding for a shape.
inline Bounds<double> bounds_of(const ContactBody& body) {
  return bounds_of(body.parts(), body.pose);
}

/// Bodies with their BVH. Immutable.
class ContactWorld {
 public:
  explicit ContactWorld(std::vector<ContactBody> bodies);

  const std::vector<ContactBody>& bodies() const { return bodies_; }
  const Bvh& hierarchy() const { return hierarchy_; }

 private:
  std::vector<ContactBody> bodies_;
  Bvh hierarchy_;
};

/// Indices of two bodies, in the first and in the second world; within one world a < b.
struct NearPair {
  std::size_t a = 0, b = 0;
  SignedDistance distance;
};

struct NearPairsOptions {
  double at_most = 0;  ///< pairs further apart are omitted; 0: only pairs that overlap or touch
  /// Optional filter, in addition to masks: returns false for pairs to skip, such as allowed pairs.
  std::function<bool(std::size_t a, std::size_t b)> wanted;
  double tolerance = SignedDistanceOptions{}.tolerance;
};

/// All pairs of a world whose signed distance is not proven to be above `at_most`, including those
/// with an unknown distance. Sorted by their indices for any number of threads.
std::vector<NearPair> near_pairs(const ContactWorld& world, const NearPairsOptions& options);

/// All pairs of a body of one world and one of the other.
std::vector<NearPair> near_pairs(const ContactWorld& first, const ContactWorld& second,
                                 const NearPairsOptions& options);

/// Returns up to `count` bodies nearest to another one, the nearest first, with a = 0. Masks apply.
/// Bodies whose distance is unknown (SignedDistance::is_unknown()) come last, and only if there are
/// fewer than `count` others. Bodies proven to be further away than `at_most` are omitted.
std::vector<NearPair> nearest_bodies(const ContactBody& to, const ContactWorld& world,
                                     std::size_t count,
                                     double at_most = std::numeric_limits<double>::infinity());

}  // namespace minkray
