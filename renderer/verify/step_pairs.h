// SPDX-License-Identifier: MIT
// The bodies of a robot and around it during one step of a path, made ready for many questions on
// pairs: where each is at some moments, and how fast and how crookedly it moves at most.
#pragma once

#include <vector>

#include "core/contact/signed_distance.h"
#include "renderer/clearance/bodies.h"
#include "renderer/clearance/step_motion.h"

namespace minkray {

/// Two bodies, and how far they must stay apart.
struct RefereePair {
  std::size_t a = 0, b = 0;
  double margin = 0;
};

/// What holds of a pair in a whole step, s from 0 to 1.
struct StepBound {
  int frame = -1;    ///< the link in which both are seen; -1: the world
  double size = 0;   ///< of both together
  double speed = 0;  ///< no point of one moves faster as the other sees it
  double acceleration = 0;
  double loss = 0;  ///< by how much places may be computed wrong
  bool is_within_numbers = true;
};

class StepPairs {
 public:
  StepPairs(const JointPath& path, const std::vector<ClearanceBody>& bodies, std::size_t step);

  /// No distance of the pair in the step is less, by the balls around the two alone.
  double lower_by_balls(const RefereePair& pair) const;

  StepBound bound(const RefereePair& pair) const;

  /// The distance of the pair at s; beyond `at_most` a lower bound is enough. The normal has the
  /// axes of the bound's frame.
  SignedDistance at(const RefereePair& pair, const StepBound& bound, double s, double at_most,
                    bool only_sign = false);

  /// How far the plane across n keeps the pair apart at s, or a little less.
  double gap(const RefereePair& pair, const StepBound& bound, const Vec3<double>& n, double s);

  /// What `at` has found, in the world.
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
    Vec3<double> centre;  ///< in the middle of the step
    double radius = 0;    ///< of a ball that holds the body all the time
  };

  /// In the world's axes.
  Place place(const ClearanceBody& body, double s);
  const Place& kept_place(std::size_t body, double s);
  const Mat3<double>& frame_turn(const StepBound& bound, double s);
  Between between(const RefereePair& pair, const StepBound& bound, double s, Mat3<double>& turn_a,
                  Mat3<double>& turn_b);

  /// The last moment that was asked for: questions on many pairs have few moments.
  struct Moment {
    double s = -1;
    std::vector<Place> places;
    std::vector<bool> known;
  };
  static constexpr std::size_t most_moments = 8;

  const std::vector<ClearanceBody>& bodies_;
  StepMotion motion_;
  std::vector<MotionBound> in_world_;  ///< of each body that is not a half-space
  std::vector<Around> around_;
  std::vector<Moment> moments_;
  std::size_t next_moment_ = 0;
};

}  // namespace minkray
