// SPDX-License-Identifier: MIT
// Bodies of a robot and around it during one step of a path, prepared for many queries on pairs:
// their poses at some moments, and bounds of their speed and acceleration.
#pragma once

#include <vector>

#include "renderer/clearance/step_pair.h"

namespace minkray {

/// Two bodies and their least allowed distance.
struct RefereePair {
  std::size_t a = 0, b = 0;
  double margin = 0;
};

class StepPairs {
 public:
  StepPairs(const JointPath& path, const std::vector<ClearanceBody>& bodies, std::size_t step);

  /// Lower bound of the pair's clearance in the step, by bounding balls alone.
  double lower_by_balls(const RefereePair& pair) const;

  StepBound bound(const RefereePair& pair) const;

  /// Returns the distance of the pair at s; beyond `at_most` a lower bound is enough.
  SignedDistance at(const RefereePair& pair, const StepBound& bound, double s, double at_most,
                    bool only_sign = false);

  /// Lower bound of the pair's distance across the plane with normal n at s.
  double gap(const RefereePair& pair, const StepBound& bound, const Vec3<double>& n, double s);

  /// Converts a result of `at` to the world.
  SignedDistance in_world(const RefereePair& pair, const StepBound& bound,
                          const SignedDistance& found, double s);

  double time_at(double s) const { return motion_.time_at(s); }
  StepMotion& motion() { return motion_; }

 private:
  struct Around {
    Vec3<double> centre;  ///< centre in the middle of the step
    double radius = 0;    ///< radius of a ball that contains the body during the whole step
  };

  const BodyPlace& kept_place(std::size_t body, double s);
  StepMoment moment(const RefereePair& pair, const StepBound& bound, double s);

  /// Poses of a recent moment: queries on many pairs share few moments.
  struct Moment {
    double s = -1;
    std::vector<BodyPlace> places;
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
