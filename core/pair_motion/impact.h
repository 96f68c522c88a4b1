// SPDX-License-Identifier: MIT
// Finds the first contact of two bodies that move and turn, by second-order conservative
// advancement with proven distances (B. Mirtich, "Impulse-based Dynamic Simulation of Rigid Body
// Systems", 1996, section 2.3). Bodies that do not turn need no time steps (swept_portal.h).
#pragma once

#include "core/pair_distance/signed_distance.h"
#include "core/support/named_kind.h"

namespace minkray {

/// Pose of a body at time 0 and its motion: `velocity` moves its pivot, `angular_velocity` turns
/// the body about its pivot (world axes, radians per unit of time).
struct RigidMotion {
  Affine<double> pose;  ///< rigid; the translation is the pivot
  Vec3<double> velocity = Vec3<double>::Zero();
  Vec3<double> angular_velocity = Vec3<double>::Zero();

  Affine<double> at(double time) const;
};

enum class ImpactStatus : unsigned char {
  miss,       ///< no contact from time 0 to t_max
  hit,        ///< the first contact is between t_lo and t_hi
  inside,     ///< the bodies overlap at time 0, or touch at time 0 and do not part
  undecided,  ///< no contact before t_lo; contacts after t_lo are unknown
};

constexpr std::string_view name_of(ImpactStatus status) {
  return name_at({"miss", "hit", "inside", "undecided"}, status);
}

/// Result of the search for the first contact of bodies A and B. A contact at time 0 after which
/// the bodies part does not count as a contact.
struct Impact {
  ImpactStatus status = ImpactStatus::undecided;
  double t_lo = 0;  ///< no contact before t_lo; t_max for a miss
  /// Hit: a time at which the bodies touch or overlap. Inside: 0. Miss: t_max. Undecided: infinite.
  double t_hi = std::numeric_limits<double>::infinity();
  /// Nearest points of A and B at t_lo, and the normal from A to B, in world coordinates.
  Vec3<double> point_a = Vec3<double>::Zero();
  Vec3<double> point_b = Vec3<double>::Zero();
  Vec3<double> normal = Vec3<double>::Zero();
  /// Distance at t_lo. Infinite if it is unknown, as for a miss without `points_of_misses`; point_a
  /// and point_b are then not set.
  double distance = std::numeric_limits<double>::infinity();
  /// Estimated error of the normal of a hit, in radians; infinite if the search has none.
  double normal_error = std::numeric_limits<double>::infinity();
  int steps = 0;  ///< number of distance queries
};

struct ImpactOptions {
  /// Distance, relative to the sum of the bodies' radii, up to which they count as touching. Bodies
  /// that pass each other more closely may be reported as a hit, but a reported miss is always a
  /// miss.
  double touching = 1e-10;
  int max_steps = 2000;  ///< maximum number of distance queries; beyond it the status is undecided
  /// True to compute the nearest points at t_max for a miss. The normal is always set.
  bool points_of_misses = true;
  /// Also makes the normal of a hit as accurate as derivatives need, where this costs little. The
  /// times are the same.
  bool is_for_derivatives = false;
};

/// Finds the first contact of A and B at times from 0 to t_max. If the bodies touch at time 0
/// (within `touching`) and do not part, the status is `inside`. If they part, the search continues
/// for the next contact.
///
/// Each step starts at a time at which the bodies are apart, and fixes a plane between them. While
/// a body turns by an angle theta, its extent along the plane's normal n is h(n(tau)). Here h is
/// the body's support function about its pivot, and n(tau) the normal in the body's frame, which
/// moves on a great circle. h is convex, so on the arc h is at most the interpolation of the values
/// at the two ends, plus (1 / cos(theta/2) - 1) times the larger value. The gaps at the beginning
/// and the end of a step therefore prove, up to a term in theta^2, that there is no contact in
/// between. Near the contact, convergence is quadratic.
Impact first_impact(const ContactShape& a, const RigidMotion& motion_a, const ContactShape& b,
                    const RigidMotion& motion_b, double t_max, const ImpactOptions& options = {});

/// Warm start: begins from the state that the last query on this pair stored in `memory`, and
/// stores its own final state there. The plane that proves a miss often proves a miss in the next
/// frame, too. The bounds hold for any contents of `memory`; the result's last digits depend on the
/// contents.
Impact first_impact(const ContactShape& a, const RigidMotion& motion_a, const ContactShape& b,
                    const RigidMotion& motion_b, double t_max, PairMemory& memory,
                    const ImpactOptions& options = {});

}  // namespace minkray
