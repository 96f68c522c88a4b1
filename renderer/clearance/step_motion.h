// SPDX-License-Identifier: MIT
// Motion of a robot from one row of joint values to the next: each joint at a constant rate (balls
// the shorter way round), or as a cubic or quintic where rows have rates. Bounds of the speed and
// curvature of the links' points extend what was found at some times to all times.
#pragma once

#include <limits>
#include <map>
#include <vector>

#include "core/math/two_fold.h"
#include "renderer/clearance/joint_piece.h"
#include "renderer/import/model/model.h"
#include "renderer/import/scene_of_model.h"

namespace minkray {

/// All joints' values in each row, in the model's order; mimics follow.
struct JointPath {
  /// Throws BadInput if a value, or a joint's way in a step, exceeds the range of numbers, or if a
  /// joint gets its first value after the first row: its motion until then is unknown.
  JointPath(const Model& model, const std::vector<JointRow>& rows);

  Model skeleton;  ///< links and joints alone
  std::vector<double> times;
  std::vector<std::vector<std::vector<double>>> values;  ///< row, joint, number
  /// First and second derivatives by time of hinges, slides and planar joints, ordered as `values`;
  /// a list is empty where nothing is known. Steps with rates at both ends are cubic for that
  /// joint, with accelerations as well quintic.
  std::vector<std::vector<std::vector<double>>> rates = {}, accelerations = {};

  /// Number `number` of a joint on its way from row `first` to row `last`.
  JointPiece piece(std::size_t first, std::size_t last, std::size_t joint,
                   std::size_t number) const;
  /// True if the joint's rate is not constant on this interval.
  bool is_curved(std::size_t first, std::size_t last, std::size_t joint) const;

  /// The skeleton with the joints' values at that time of the path: those of a row as they were
  /// given, between rows with quaternions of length 1.
  Model posed_at(double time) const;

  /// A single row is a path of one step at rest.
  std::size_t steps() const { return times.size() > 1 ? times.size() - 1 : 1; }
};

/// Bounds for a link's points while s goes from 0 to 1, relative to another link.
struct MotionBound {
  double reach = 0;  ///< no point is further from the other's origin
  double speed = 0;
  double acceleration = 0;
  double rounding = 0;  ///< no point's place is computed wrong by more

  /// True if squares of lengths do not overflow.
  bool is_within_numbers() const {
    return reach < 1e150 && speed < 1e150 && acceleration < std::numeric_limits<double>::infinity();
  }
};

class StepMotion {
 public:
  StepMotion(const JointPath& path, std::size_t step);

  /// The links' poses in the world, s from 0 to 1. Kept until this is gone.
  const std::vector<Affine<double>>& links_at(double s) { return places_at(s).poses; }

  /// Their translations in twice the digits: a robot may be far from the world's origin.
  struct Places {
    std::vector<Affine<double>> poses;
    std::vector<Vec3<double>> lows;  ///< rounding errors of the poses' translations

    TwoFoldVec3<double> origin(std::size_t link) const {
      return {poses[link].translation, lows[link]};
    }
  };
  const Places& places_at(double s);

  /// The seconds of the path.
  double time_at(double s) const { return begin_ + s * (end_ - begin_); }

  /// Holds for the points within `reach` of the link's origin, as `ancestor` sees them; -1: the
  /// world.
  ///
  /// A point p goes to R p + t. If R turns at a speed alpha that changes by beta, and p moves by v
  /// and a in its own frame, R p moves by alpha |p| + v and accelerates by
  /// (alpha^2 + beta) |p| + 2 alpha v + a.
  MotionBound bound(int link, int ancestor, double reach) const;

  /// Bound of the difference between the link's linear part and a rotation.
  double turn_error(int link) const;

  /// The link whose frame contains both, the furthest from the world; -1: the world.
  int common_ancestor(int a, int b) const;

 private:
  struct Rate {
    double turn = 0;           ///< radians in the step, at its fastest
    double turn_change = 0;    ///< by which that changes in the step, at most
    double slide = 0;          ///< the origin's way in the step, at its fastest
    double slide_change = 0;   ///< as turn_change
    double way = 0;            ///< JointPiece::way() of a slide that is not straight
    double angle = 0;          ///< the largest number that an angle is made of
    double offset = 0;         ///< the furthest that the origin is from where it is at rest
    bool has_values = false;   ///< false if at rest
    bool is_absolute = false;  ///< places the link in the world, independent of its parents
  };

  Rate rate_of(const ModelJoint& joint, std::size_t at) const;
  TwoFoldVec3<double> shift_of(const ModelJoint& joint, std::size_t at, double s) const;

  const JointPath& path_;
  std::size_t first_, last_;
  double begin_, end_;
  Model model_;
  std::vector<std::vector<Rate>> rates_;  ///< link, joint
  std::vector<int> parents_;              ///< links placed by a free joint have none
  std::map<double, Places> kept_;
};

}  // namespace minkray
