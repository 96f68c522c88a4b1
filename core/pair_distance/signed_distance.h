// SPDX-License-Identifier: MIT
// Signed distance of two convex shapes: their distance or, for an overlap, minus the length of the
// shortest translation that separates them (S. Cameron, R. Culley, 1986). Equals the largest signed
// gap between two parallel planes, one bounding A, the other B. Such a pair of planes proves the
// lower bound. A point of each shape proves the upper bound; for an overlap, points of B - A that
// enclose the origin.
#pragma once

#include <limits>
#include <string_view>

#include "core/pair/contact_shape.h"
#include "core/support/named_kind.h"

namespace minkray {

enum class SignedStatus : unsigned char {
  separated,    ///< lower > 0
  touching,     ///< 0 is between the bounds, which differ by at most 1e-9 of the sizes' sum
  overlapping,  ///< upper < 0
  undecided,    ///< 0 is between the bounds, which differ by more than for `touching`
};

constexpr std::string_view name_of(SignedStatus status) {
  return name_at({"separated", "touching", "overlapping", "undecided"}, status);
}

struct SignedDistance {
  SignedStatus status = SignedStatus::undecided;
  double value = 0;  ///< in [lower, upper]; the bounds include rounding errors. See is_unknown()
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  /// Nearest points of A and B in the world. For an overlap: the points where the shapes just touch
  /// after B is moved by -value * normal. point_b - point_a = value * normal, up to the error in
  /// docs/contact.md.
  Vec3<double> point_a = Vec3<double>::Zero();
  Vec3<double> point_b = Vec3<double>::Zero();
  /// Unit vector from A to B: the normal of two planes, one bounding A, the other B. If the shapes
  /// are separated, the planes are at least `lower` apart. For an overlap, the half-spaces behind
  /// the two planes, which contain A and B, overlap by at most -`lower`; moving B along the normal
  /// separates the shapes.
  Vec3<double> normal = Vec3<double>::Zero();
  int supports = 0;  ///< number of support points of B - A; each costs one of A and one of B
  /// Set if the limit of support points was reached: the bounds hold, but are not within the
  /// tolerance.
  bool is_exhausted = false;
  /// A shape is its core, such as a capsule's segment, grown by a radius. True if the two cores
  /// overlap, and the direction of their penetration depth is proven to be unique. False if that
  /// was not proven or not tested.
  bool has_one_direction = false;

  /// True if the search failed: the shapes may or may not overlap, and there is no upper bound.
  /// Then `value` and the points are meaningless.
  bool is_unknown() const {
    return status == SignedStatus::undecided && !(upper < std::numeric_limits<double>::infinity());
  }
};

struct SignedDistanceOptions {
  /// Largest gap between the bounds, relative to the sum of the shapes' sizes (radii of their
  /// bounding balls).
  double tolerance = 1e-10;
  /// Distance beyond which a lower bound is enough: `upper` may then be infinite, and `value`
  /// equals `lower`.
  double at_most = std::numeric_limits<double>::infinity();
  /// Only decides whether the shapes overlap, without computing the depth. If they do, `lower` is
  /// -infinity, or any bound that the search happened to find.
  bool only_sign = false;
  /// Maximum number of support points for branch and bound, the last method, which runs if all
  /// others fail. In addition, the contact points then cost some tens of support points. If all
  /// directions are equally good, no limit is large enough for ten digits: for example, a point at
  /// the centre of a ball that is known only by its support mapping.
  int max_supports = 50000;
  /// Also makes the normal and the points of curved shapes accurate to about 1e-9, which
  /// derivatives of the distance need. Costs less than a `tolerance` that has the same effect.
  bool is_for_derivatives = false;
};

/// Returns the signed distance of A and B. The poses must be rigid. The bounds include all rounding
/// errors: 16 machine epsilons times the sum of the shapes' sizes and the distance of their middles
/// (a middle is the centre of a shape's core). The bounds hold however far the shapes are from the
/// world's origin. If a middle is not the origin of the shape's own frame, the rounding of the
/// middle's position is added.
SignedDistance signed_distance(const ContactShape& a, const Affine<double>& pose_a,
                               const ContactShape& b, const Affine<double>& pose_b,
                               const SignedDistanceOptions& options = {});

/// Warm start: begins from the state that the last query on this pair stored in `memory`, and
/// stores its own final state there. Faster if bodies move little between queries (hulls: about
/// twice as fast). The bounds hold for any contents of `memory`; the result's last digits depend on
/// the contents.
SignedDistance signed_distance(const ContactShape& a, const Affine<double>& pose_a,
                               const ContactShape& b, const Affine<double>& pose_b,
                               PairMemory& memory, const SignedDistanceOptions& options = {});

/// Variant for a relative placement: `linear_a` and `linear_b` rotate from each body's frame to a
/// common frame; `between` is the vector from A's middle to B's in that frame. Returned points are
/// relative to A's middle. `memory` may be null.
SignedDistance signed_distance(const ContactShape& a, const Mat3<double>& linear_a,
                               const ContactShape& b, const Mat3<double>& linear_b,
                               const Between& between, const SignedDistanceOptions& options,
                               PairMemory* memory);

/// Variant for shapes that are already in the world's frame.
SignedDistance signed_distance(const ContactShape& a, const ContactShape& b,
                               const SignedDistanceOptions& options = {});

}  // namespace minkray
