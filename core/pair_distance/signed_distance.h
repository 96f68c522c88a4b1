// SPDX-License-Identifier: MIT
// Distance of two convex shapes or, if they overlap, minus the length of the least translation that
// separates them (S. Cameron, R. Culley, "Determining the minimum translational distance between
// two convex polyhedra", 1986): the largest signed gap of parallel planes that bound A on one side,
// B on the other. One such gap proves the lower bound; two points, or points of B - A around the
// origin, the upper one.
#pragma once

#include <limits>
#include <string_view>

#include "core/pair/contact_shape.h"

namespace minkray {

enum class SignedStatus : unsigned char {
  separated,    ///< lower > 0
  touching,     ///< 0 is between the bounds, which differ by at most 1e-9 of the sizes
  overlapping,  ///< upper < 0
  undecided,    ///< 0 is between the bounds, which differ by more
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
  /// Nearest points of A and B, in the world, or those that touch first when the two are moved
  /// apart. point_b - point_a = value * normal, up to the error in docs/contact.md.
  Vec3<double> point_a = Vec3<double>::Zero();
  Vec3<double> point_b = Vec3<double>::Zero();
  /// Unit vector from A to B, normal to planes `lower` apart. Moving B along it separates.
  Vec3<double> normal = Vec3<double>::Zero();
  int supports = 0;  ///< of B - A: each takes one of A, one of B
  /// Set if the limit of support points was reached: the bounds hold, but are not within the
  /// tolerance.
  bool is_exhausted = false;
  /// True if it is proven that only one direction gives the depth of overlapping cores. False:
  /// unknown.
  bool has_one_direction = false;

  /// The search failed: whether they overlap is unknown, and the distance has no upper bound.
  /// `value` is no distance then, and there are no points.
  bool is_unknown() const {
    return status == SignedStatus::undecided && !(upper < std::numeric_limits<double>::infinity());
  }
};

struct SignedDistanceOptions {
  /// Largest gap between the bounds, relative to the sum of the shapes' sizes.
  double tolerance = 1e-10;
  /// If further apart, a lower bound suffices: upper may be infinite, and value is `lower` then.
  double at_most = std::numeric_limits<double>::infinity();
  /// Decides only whether they overlap: no depth; lower is -infinity or a bound found in passing.
  bool only_sign = false;
  /// Limit of support points for branch and bound, the last resort (some tens more find the points
  /// of contact). No limit gives ten digits where all directions are equally good: a point within a
  /// ball known by its support mapping only.
  int max_supports = 50000;
  /// Finds the normal and points of curved shapes, too, to about 1e-9, for derivatives. Cheaper
  /// than an equally fine tolerance.
  bool is_for_derivatives = false;
};

/// The poses are rigid. Their rounding, and that of all numbers here, is allowed for by 16 epsilons
/// of the shapes' sizes and of the distance of their middles, wherever the two are. A shape
/// turned, and far from the origin, in its own frame adds the rounding of that turn.
SignedDistance signed_distance(const ContactShape& a, const Affine<double>& pose_a,
                               const ContactShape& b, const Affine<double>& pose_b,
                               const SignedDistanceOptions& options = {});

/// Begins with what the last query on this pair left in `memory`, and leaves there what it ended
/// with: faster for bodies that move little between queries, about twice for hulls. The bounds hold
/// whatever is in it; the result's last digits depend on it.
SignedDistance signed_distance(const ContactShape& a, const Affine<double>& pose_a,
                               const ContactShape& b, const Affine<double>& pose_b,
                               PairMemory& memory, const SignedDistanceOptions& options = {});

/// For poses without their common offset: `linear_a`, `linear_b` turn to the axes of `between`,
/// which leads from A's middle to B's. Points are relative to A's middle. `memory` may be null.
SignedDistance signed_distance(const ContactShape& a, const Mat3<double>& linear_a,
                               const ContactShape& b, const Mat3<double>& linear_b,
                               const Between& between, const SignedDistanceOptions& options,
                               PairMemory* memory);

/// Both shapes are in the world's frame.
SignedDistance signed_distance(const ContactShape& a, const ContactShape& b,
                               const SignedDistanceOptions& options = {});

}  // namespace minkray
