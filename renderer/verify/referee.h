// SPDX-License-Identifier: MIT
// Referee of motions: proves that all pairs of bodies stay apart along a whole path, also between
// its rows, or finds the pairs that collide and when. A plane proves a part of a step if it
// separates a pair at both ends by more than the pair can deviate in between
// (core/pair_motion/least_distance.h). Parts that no plane proves are halved.
#pragma once

#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "renderer/verify/step_pairs.h"

namespace minkray {

enum class MotionStatus : unsigned char {
  free,      ///< every pair is proven to stay further apart than its margin
  collides,  ///< a pair is closer than its margin at a reported moment
  undecided,
};
std::string_view name_of(MotionStatus status);

struct RefereeOptions {
  /// Largest difference between the bounds of the least clearance, relative to it.
  double tolerance = 0.01;
  /// True to compute the least clearance of each step, not only of the whole path.
  bool every_step = false;
  /// True to store the planes that prove a motion free.
  bool keep_planes = false;
  /// Planes that prove this clearance are enough.
  double enough = std::numeric_limits<double>::infinity();
  /// True to leave meshes undecided that no plane keeps apart.
  bool only_planes = false;
  /// Limit of distances of one pair in one step. A motion that needs more is undecided.
  std::size_t budget = 4000;
};

/// Least clearance: the distance minus the pair's margin.
struct LeastClearance {
  double lower = std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  std::size_t pair = 0;  ///< undefined if upper is infinite, and so are the members below
  double time = 0;
  SignedDistance distance;  ///< in the world
};

/// An interval of time. Outside the stretches of a pair, the pair is proven to be apart.
struct Stretch {
  std::size_t pair = 0;
  double begin = 0, end = 0;
  bool collides = false;  ///< true if a moment with a collision was found in it; else undecided
  double time = 0;        ///< time of that moment
  double upper = 0;       ///< upper bound of the clearance at that moment, below 0
  /// Middle of the two points, one of each body, that show the overlap.
  Vec3<double> point = Vec3<double>::Zero();
};

/// A plane that proves a pair apart for s from `first` to `last` in a step.
struct SeparatingPlane {
  std::size_t pair = 0, step = 0;
  double first = 0, last = 1;
  Vec3<double> normal;  ///< from a to b, in the frame that both share
};

struct MotionVerdict {
  MotionStatus status = MotionStatus::undecided;
  LeastClearance least;
  std::vector<LeastClearance> steps;    ///< empty unless every_step
  std::vector<Stretch> stretches;       ///< in the order of pairs, then of time
  std::vector<SeparatingPlane> planes;  ///< empty unless keep_planes; the bounding balls of all
                                        ///< other pairs stay apart
  /// Pairs of meshes in each other's hollows, without planes for the whole time; ascending.
  std::vector<std::size_t> without_planes = {};
  std::size_t distances = 0;
};

/// `pairs` are numbers of bodies. Uses the threads of parallel_for; the result does not depend on
/// their number.
MotionVerdict verdict_of(const JointPath& path, const std::vector<ClearanceBody>& bodies,
                         const std::vector<RefereePair>& pairs, const RefereeOptions& options = {});

}  // namespace minkray
