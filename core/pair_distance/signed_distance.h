// SPDX-License-Identifier: MIT
// Distance of two convex shapes or, if they overlap, minus the length of the least translation that
// separates them (S. Cameron, R. Culley, "Determining the minimum translational distance between
// two convex polyhedra", 1986): the largest gap between two parallel planes with A on one side and
// B on the other. One plane proves the lower bound; two points, or points of B - A around the
// origin, the upper one.
#pragma once

#include <limits>
#include <string_view>

#include "core/pair/contact_shape.h"

namespace minkray {

enum class SignedStatus : unsigned char {
  separated,    ///< lower > 0
  touching,     ///< the bounds are on both sides of 0, and within the tolerance
  overlapping,  ///< upper < 0
  undecided,    ///< the bounds hold, but are not within the tolerance
};

constexpr std::string_view name_of(SignedStatus status) {
  switch (status) {
    case SignedStatus::separated:
      return "separated";
    case SignedStatus::touching:
      return "touching";
    case SignedStatus::overlapping:
      return "overlapping";
    case SignedStatus::undecided:
      break;
  }
  return "undecided";
}

struct SignedDistance {
  SignedStatus status = SignedStatus::undecided;
  double value = 0;  ///< in [lower, upper], which allow for rounding; see is_unknown()
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  /// Points of A and B, in the world, with point_b - point_a = value * normal but for the
  /// deviation allowed in docs/contact.md: the nearest ones; or where the two touch first, moved
  /// apart.
  Vec3<double> point_a = Vec3<double>::Zero();
  Vec3<double> point_b = Vec3<double>::Zero();
  /// Unit vector from A to B, across planes `lower` apart. Moving B by it separates.
  Vec3<double> normal = Vec3<double>::Zero();
  int supports = 0;  ///< of the difference B - A: each is one of A and one of B
  /// Set if the limit of support points was reached: the bounds hold, but are not within the
  /// tolerance.
  bool is_exhausted = false;
  /// True if the depth of overlapping cores has one direction, proven. Else nothing is known.
  bool has_one_direction = false;

  /// The search failed: it is unknown if they are apart or overlap, and the distance has no upper
  /// bound. `value` is no distance then, and there are no points.
  bool is_unknown() const {
    return status == SignedStatus::undecided && !(upper < std::numeric_limits<double>::infinity());
  }
};

struct SignedDistanceOptions {
  /// Largest gap between the bounds, relative to the sum of the shapes' sizes.
  double tolerance = 1e-10;
  /// Beyond this distance it is enough to know that they are: value is `lower` then, and upper may
  /// be infinite.
  double at_most = std::numeric_limits<double>::infinity();
  /// Computes only if they overlap: not the depth, and lower is -infinity or a bound found in
  /// passing.
  bool only_sign = false;
  /// Limit of support points for branch and bound, the last resort (some tens more are used in the
  /// end to find the points of contact). No number suffices for ten digits on a body whose
  /// directions are all equally good: a ball known by its support mapping only, around a point.
  int max_supports = 50000;
  /// Finds the normal of curved shapes, too, to some 1e-9, and the points with it: for
  /// derivatives. Costs less than a tolerance fine enough for that.
  bool is_for_derivatives = false;
};

/// The poses are rigid. Their rounding, and that of all numbers here, is allowed for by 16 epsilons
/// of the shapes' sizes and of the distance of their middles, wherever the two are; shapes that are
/// far from the origin of their own frames, and turned there, add what that turn was rounded to.
SignedDistance signed_distance(const ContactShape& a, const Affine<double>& pose_a,
                               const ContactShape& b, const Affine<double>& pose_b,
                               const SignedDistanceOptions& options = {});

/// Begins with what the last query on this pair left in `memory`, and leaves there what it ended
/// with: of bodies that move little from one query to the next it is faster, of hulls twice
/// (docs/contact.md). The bounds hold whatever is in it; the answer's last digits depend on it.
SignedDistance signed_distance(const ContactShape& a, const Affine<double>& pose_a,
                               const ContactShape& b, const Affine<double>& pose_b,
                               PairMemory& memory, const SignedDistanceOptions& options = {});

/// Bodies that have been brought near: `linear_a` and `linear_b` turn to the axes along which
/// `between` leads from A's middle to B's. Points are seen from A's middle. There may be a memory.
SignedDistance signed_distance(const ContactShape& a, const Mat3<double>& linear_a,
                               const ContactShape& b, const Mat3<double>& linear_b,
                               const Between& between, const SignedDistanceOptions& options,
                               PairMemory* memory);

/// Both shapes are in the world's frame.
SignedDistance signed_distance(const ContactShape& a, const ContactShape& b,
                               const SignedDistanceOptions& options = {});

}  // namespace minkray
