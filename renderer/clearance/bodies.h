// SPDX-License-Identifier: MIT
// Bodies of a clearance query, the robot's shapes and the obstacles, and which of them are pairs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/pair_distance/half_space_distance.h"
#include "core/parts/parts_reach.h"
#include "renderer/clearance/allowed_pairs.h"
#include "renderer/import/model/import_options.h"
#include "renderer/scene/scene.h"

namespace minkray {

struct ClearanceBody {
  std::string name;
  std::string link;  ///< the name of the robot's link; empty: an obstacle
  int link_index = -1;
  ContactShape shape;
  Mat3<double> linear = Mat3<double>::Identity();  ///< from the body's frame to the link's axes
  PlacedMiddle middle = {};  ///< of the body, in the link's frame or in the world
  /// If there is one it is the space below, not `shape`; in the link's frame or in the world.
  std::optional<PlacedPlane> plane = {};
  std::shared_ptr<const TriangleMesh> mesh = {};  ///< if there is one it is that, not `shape`

  PartsBody parts() const { return mesh ? PartsBody(*mesh) : PartsBody(shape); }
  /// The middle in the body's frame, and the radius of a ball around it that holds the body.
  Vec3<double> own_middle() const { return middle_of(parts()); }
  double ball_radius() const;
  /// The ball of this radius around the link's origin holds the body.
  double reach() const { return middle.at.high.norm() + ball_radius(); }
  /// From the body's frame to the link's, or to the world.
  Affine<double> pose() const { return {linear, middle.at.rounded() - linear * own_middle()}; }
};

/// The plane under a rigid pose.
PlacedPlane moved(PlacedPlane plane, const Affine<double>& pose);

/// The distance of a body from a half-space, its middle at the place that is given.
SignedDistance distance_to_half_space(const PlacedPlane& plane, const ClearanceBody& body,
                                      const Mat3<double>& linear, const PlacedMiddle& middle);

/// Returns the obstacle, seen from a frame that is at `frame` in the world, a rigid pose.
ClearanceBody seen_from(const Affine<double>& frame, ClearanceBody obstacle);

/// The bodies that `geometry` chooses.
std::vector<ClearanceBody> bodies_of(const Model& model, GeometryChoice geometry);

/// Limits: all are in memory at once, some hundred bytes each, and each step checks them one by
/// one.
inline constexpr std::size_t most_obstacles = 1'000'000;
inline constexpr std::size_t most_pairs = 10'000'000;

/// All of a scene's objects and particles, at the scene's time, in the order in which worlds number
/// them. Throws BadInput if there are more than most_obstacles.
std::vector<ClearanceBody> bodies_of(const Scene& scene);
/// Number of each body's object: all parts of a compound have the same, all others have their own.
std::vector<std::uint32_t> objects_of_bodies(const Scene& scene);

/// Data that determines if a robot's shape moves against another.
struct LinkPlace {
  int group = -1;   ///< of links that are fixed to each other; -1: the world
  int parent = -2;  ///< the group that it hangs on; of the world, and of what is fixed to it, -2
  bool is_still = true;
};
/// `link` is an index, -1: the world. `groups` are rigid_groups(model).
LinkPlace place_of(int link, const Model& model, const std::vector<int>& groups);

/// True if two shapes of a robot are a pair: they move against each other, and no joint connects
/// them.
bool are_looked_at(const LinkPlace& a, const LinkPlace& b);

struct BodyPair {
  std::size_t a, b;
};

/// Pairs that move against each other; not of links that a joint connects, nor of allowed ones.
/// Without `self` only those of the robot and an obstacle. Throws BadInput if there are more than
/// most_pairs.
std::vector<BodyPair> pairs_of(const std::vector<ClearanceBody>& bodies, const Model& model,
                               const AllowedPairs& allowed, bool self);

}  // namespace minkray
