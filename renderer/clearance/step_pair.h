// SPDX-License-Identifier: MIT
// Two bodies during one step of a path: bounds of their motion, and at a moment their distance, and
// the gap at a plane between them. Both are measured in the frame of the link that both hang on.
#pragma once

#include "renderer/clearance/bodies.h"
#include "renderer/clearance/step_motion.h"

namespace minkray {

/// Bounds of a pair in a whole step, s from 0 to 1.
struct StepBound {
  int frame = -1;    ///< link in whose frame both are measured; -1: the world
  double size = 0;   ///< sum of both sizes
  double speed = 0;  ///< largest speed of any point of one relative to the other
  double acceleration = 0;
  double loss = 0;  ///< error bound of computed positions
  bool is_within_numbers = true;
};

/// `a_in_world` and `b_in_world` are bounds relative to the world, where they are known.
StepBound step_bound(const ClearanceBody& a, const ClearanceBody& b, const StepMotion& motion,
                     const MotionBound* a_in_world = nullptr,
                     const MotionBound* b_in_world = nullptr);

/// Place of a body at a moment, in the world.
struct BodyPlace {
  Mat3<double> linear;
  TwoFoldVec3<double> middle;
};
BodyPlace place_of(const ClearanceBody& body, StepMotion& motion, double s);

/// The pair at a moment.
struct StepMoment {
  StepMoment(const ClearanceBody& a, const BodyPlace& of_a, const ClearanceBody& b,
             const BodyPlace& of_b, const StepBound& bound, StepMotion& motion, double s);

  /// Points are seen from A's middle, or of half-spaces in the world.
  SignedDistance distance(const SignedDistanceOptions& options) const;
  /// Lower bound of the distance across the plane with normal n.
  double gap(const Vec3<double>& n) const;
  /// Converts a result of distance() to the world.
  SignedDistance in_world(SignedDistance found) const;

  const ClearanceBody &a, &b;
  BodyPlace of_a, of_b;      ///< turned to the frame; middles in the world
  const Mat3<double>* turn;  ///< of the frame in the world; null for the world itself
  Between between;           ///< in the frame
};

}  // namespace minkray
