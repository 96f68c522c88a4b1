// SPDX-License-Identifier: MIT
// Finds all pairs of bodies that are near each other, and their signed distances. Traverses two
// BVHs together, or one BVH with itself. Half-spaces are not supported, since they have no box.
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
  Affine<double> pose;  ///< rigid; from the body's frame to the world
  /// Two bodies form a pair only if each body's mask shares a bit with the other's category.
  std::uint32_t category = 1;
  std::uint32_t mask = ~std::uint32_t{0};
  /// If one of these is not null, the body is that and has no shape.
  std::shared_ptr<const TriangleMesh> mesh = {};
  std::shared_ptr<const Compound> compound = {};

  bool is_shape() const { return !mesh && !compound; }
  PartsBody parts() const {
    if (mesh) return *mesh;
    if (compound) return *compound;
    return shape;
  }
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

/// Calls body(begin, end) for parts of [0, count), as parallel_for() does.
using RunParts =
    std::function<void(std::size_t count, std::size_t part_size,
                       const std::function<void(std::size_t begin, std::size_t end)>& body)>;

struct NearPairsOptions {
  double at_most = 0;  ///< omits pairs further apart; 0: returns only pairs that overlap or touch
  /// Optional filter, in addition to masks: returns false for pairs to skip.
  std::function<bool(std::size_t a, std::size_t b)> wanted;
  double tolerance = SignedDistanceOptions{}.tolerance;
  RunParts run = {};  ///< computes the distances, if set; may throw to end the search
};

/// Returns all pairs of bodies of a world, except pairs whose signed distance is proven to be above
/// `at_most`. Includes pairs with an unknown distance. Sorted by the bodies' indices.
std::vector<NearPair> near_pairs(const ContactWorld& world, const NearPairsOptions& options);

/// Returns the pairs of a body of `first` and a body of `second`.
std::vector<NearPair> near_pairs(const ContactWorld& first, const ContactWorld& second,
                                 const NearPairsOptions& options);

/// Returns up to `count` bodies nearest to `to`, the nearest first. In each result, a is 0. Skips
/// bodies that cannot form a pair due to their masks. Bodies whose distance is unknown
/// (SignedDistance::is_unknown()) come last, and only if there are fewer than `count` others. Omits
/// bodies proven to be further away than `at_most`. Writes the least lower bound of the other
/// bodies' distances to `others`, if not null, unless they are proven to be further away than all
/// results: then infinity.
std::vector<NearPair> nearest_bodies(const ContactBody& to, const ContactWorld& world,
                                     std::size_t count,
                                     double at_most = std::numeric_limits<double>::infinity(),
                                     double* others = nullptr);

}  // namespace minkray
