// SPDX-License-Identifier: MIT
// Bodies of a robot and around it during one step of a path, prepared for many queries on pairs:
// their poses at some moments, and bounds of their speed and acceleration.
#pragma once

#include <vector>

#include "core/pair_distance/signed_distance.h"
#include "renderer/clearance/bodies.h"
#include "renderer/clearance/step_motion.h"

namespace minkray {

/// Two bodies and their least allowed distance.
struct RefereePair {
  std::size_t a = 0, b = 0;
  double margin = 0;
};

/// Bounds of a pair in a whole step, s from 0 to 1.
struct StepBound {
  int frame = -1;    ///< link in whose frame both are measured; -1: the world
  double size = 0;   ///< sum of both sizes
  double speed = 0;  ///< largest speed of any point of one relative to the other
  double acceleration = 0;
  double loss = 0;  ///< error bound of computed positions
  bool is_within_numbers = true;
};

class StepPairs {
 public:
  StepPairs(const JointPath& path, const std::vector<ClearanceBody>& bodies, std::size_t step);

  /// Lower bound of the pair's clearance in the step, by bounding balls alone.
  double lower_by_balls(const RefereePair& pair) const;

  StepBound bound(const RefereePair& pair) const;

  /// Returns the distance of the pair at s; beyond `at_most` a lower bound is enough. The normal
  /// has the axes of the bound's frame.
  SignedDistance at(const RefereePair& pair, const StepBound& bound, double s, double at_most,
                    bool only_sign = false);

  /// Lower bound of the pair's distance across the plane with normal n at s.
  double gap(const RefereePair& pair, const StepBound& bound, const Vec3<double>& n, double s);

  /// Converts a result of `at` to the world.
  SignedDistance in_world(const RefereePair& pair, const StepBound& bound, SignedDistance found,
                          double s);

  double time_at(double s) const { return motion_.time_at(s); }
  StepMotion& motion() { return motion_; }

 private:
  struct Place {
    Mat3<double> linear;
    TwoFoldVec3<double> middle;
  };
  struct Around {
    Vec3<double> centre;  ///< centre in the middle of the step
    double radius = 0;    ///< radius of a ball that contains the body during the whole step
  };

  /// Pose in the world's axes.
  Place place(const ClearanceBody& body, double s);
  const Place& kept_place(std::size_t body, double s);
  const Mat3<double>& frame_turn(const StepBound& bound, double s);
  Between between(const RefereePair& pair, const StepBound& bound, double s, Mat3<double>& turn_a,
                  Mat3<double>& turn_b);

  /// Poses of a recent moment: queries on many pairs share few moments.
  struct Moment {
    double s = -1;
    std::vector<Place> places;
    std::vector<bool> known;
  };
  static constexpr std::size_t most_moments = 8;

  const std::vector<ClearanceBody>& bodies_;
  StepMotion motion_;
  std::vector<MotionBound> in_world_;  ///< bound of each body that is not a half-space
  std::vector<Around> around_;
  std::vector<Moment> moments_;
  std::size_t next_moment_ = 0;
};

}  // namespace minkray
