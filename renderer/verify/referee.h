// SPDX-License-Identifier: MIT
// The referee of motions: whether all pairs of bodies stay apart all along a path, between its rows
// too, or which of them collide from when to when.
//
// A part of a step is proven by a plane that separates a pair at both of its ends by more than what
// the pair can bend in between (core/contact/least_distance.h). What no plane proves is halved.
#pragma once

#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "renderer/verify/step_pairs.h"

namespace minkray {

enum class MotionStatus : unsigned char {
  free,      ///< every pair is proven to stay further apart than its margin
  collides,  ///< a pair is closer than its margin at a moment that is named
  undecided,
};
std::string_view name_of(MotionStatus status);

struct RefereeOptions {
  /// How near the bounds of the least clearance shall be to each other, relative to it.
  double tolerance = 0.01;
  /// Whether the least clearance of each step is asked for, not of the whole path only.
  bool every_step = false;
  /// Whether the planes are kept that prove a motion free.
  bool keep_planes = false;
  /// Planes that prove this clearance are enough.
  double enough = std::numeric_limits<double>::infinity();
  /// Leaves meshes undecided that no plane keeps apart.
  bool only_planes = false;
  /// Distances of one pair in one step. A motion that needs more is undecided.
  std::size_t budget = 4000;
};

/// The least clearance: the distance less the pair's margin.
struct LeastClearance {
  double lower = std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  std::size_t pair = 0;  ///< says nothing if upper is infinite; nor does the rest
  double time = 0;
  SignedDistance distance;  ///< in the world
};

/// A stretch of time outside of which, for as long as the neighbouring ones of this pair allow, the
/// pair is proven to be apart.
struct Stretch {
  std::size_t pair = 0;
  double begin = 0, end = 0;
  bool collides = false;  ///< a moment of it was found at which they do; else it is undecided
  double time = 0;        ///< of that moment
  double upper = 0;       ///< their clearance then is no more than this, which is below 0
  /// It is in the middle of the two points, one of each body, by which the overlap was found.
  Vec3<double> point = Vec3<double>::Zero();
};

/// A plane that proves a pair apart while s goes from `first` to `last` in a step.
struct SeparatingPlane {
  std::size_t pair = 0, step = 0;
  double first = 0, last = 1;
  Vec3<double> normal;  ///< from a to b, in the frame that both hang on
};

struct MotionVerdict {
  MotionStatus status = MotionStatus::undecided;
  LeastClearance least;
  std::vector<LeastClearance> steps;    ///< if asked for
  std::vector<Stretch> stretches;       ///< in the order of pairs, then of time
  std::vector<SeparatingPlane> planes;  ///< if asked for; the other pairs' balls stay apart
  /// Pairs of meshes in each other's hollows, with no planes for all the time; ascending.
  std::vector<std::size_t> without_planes = {};
  std::size_t distances = 0;
};

/// `pairs` are numbers of bodies. Uses the threads of parallel_for; the answer is the same for any
/// number of them.
MotionVerdict verdict_of(const JointPath& path, const std::vector<ClearanceBody>& bodies,
                         const std::vector<RefereePair>& pairs, const RefereeOptions& options = {});

}  // namespace minkray
