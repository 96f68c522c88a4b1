// SPDX-License-Identifier: MIT
#include "renderer/clearance/clearance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/contact/half_space_distance.h"
#include "core/contact/least_distance.h"
#include "core/parallel/parallel.h"

namespace minkray {
namespace {

Affine<double> rigid_inverse(const Affine<double>& pose) {
  const Mat3<double> turned = pose.linear.transpose();
  return {turned, -(turned * pose.translation)};
}

/// Two bodies during one step, in the frame that what they hang on has in common.
class StepPair : public MovingPair {
 public:
  StepPair(const ClearanceBody& a, const ClearanceBody& b, StepMotion& motion)
      : a_(a), b_(b), motion_(motion) {
    const bool is_in_world = a.half_space || b.half_space;
    frame_ = is_in_world ? -1 : motion.common_ancestor(a.link_index, b.link_index);
    for (const ClearanceBody* body : {&a, &b}) {
      if (body->half_space) continue;
      const MotionBound bound = motion.bound(body->link_index, frame_, body->reach());
      is_within_numbers_ &= bound.is_within_numbers();
      speed += bound.speed;
      acceleration += bound.acceleration;
      size += body->shape.ball_radius();
    }
  }

  SignedDistance at(double s, double at_most) const override {
    const Affine<double> of_a = pose(a_, s), of_b = pose(b_, s);
    if (a_.half_space)
      return distance_to_half_space(a_.half_space->normal, a_.half_space->offset, b_.shape, of_b);
    if (b_.half_space) {
      SignedDistance found =
          distance_to_half_space(b_.half_space->normal, b_.half_space->offset, a_.shape, of_a);
      std::swap(found.point_a, found.point_b);
      found.normal = -found.normal;
      return found;
    }
    SignedDistanceOptions options;
    options.at_most = at_most;
    return signed_distance(a_.shape, of_a, b_.shape, of_b, options);
  }

  double gap(const Vec3<double>& n, double s) const override {
    if (a_.half_space || b_.half_space) {
      const SignedDistance there = at(s, 0);
      const double turned = n.dot(there.normal);
      // Along any other direction a half-space has no end.
      return turned > 1 - 1e-12 ? there.lower : -std::numeric_limits<double>::infinity();
    }
    return gap_along(a_.shape, pose(a_, s), b_.shape, pose(b_, s), n);
  }

  /// From the common frame to the world.
  Affine<double> frame_at(double s) const {
    return frame_ < 0 ? Affine<double>{} : motion_.links_at(s)[static_cast<std::size_t>(frame_)];
  }

  /// If not, nothing can be said of the step.
  bool is_within_numbers() const { return is_within_numbers_; }

  /// No distance of the step is less, by the balls around the two alone.
  double lower_by_balls() const {
    if (a_.half_space || b_.half_space) return -std::numeric_limits<double>::infinity();
    const auto middle = [&](const ClearanceBody& body) {
      return pose(body, 0.5)(body.shape.middle());
    };
    const double lower = (middle(b_) - middle(a_)).norm() - size - speed / 2;
    // Beyond the numbers' range nothing is known.
    return std::isfinite(lower) ? lower : -std::numeric_limits<double>::infinity();
  }

 private:
  Affine<double> pose(const ClearanceBody& body, double s) const {
    if (body.link_index < 0) return frame_ < 0 ? body.pose : rigid_inverse(frame_at(s)) * body.pose;
    if (body.link_index == frame_) return body.pose;
    const Affine<double>& link = motion_.links_at(s)[static_cast<std::size_t>(body.link_index)];
    return frame_ < 0 ? link * body.pose : rigid_inverse(frame_at(s)) * link * body.pose;
  }

  const ClearanceBody &a_, &b_;
  StepMotion& motion_;
  int frame_;
  bool is_within_numbers_ = true;
};

SignedDistance in_world(SignedDistance found, const Affine<double>& frame) {
  found.point_a = frame(found.point_a);
  found.point_b = frame(found.point_b);
  found.normal = frame.linear * found.normal;
  return found;
}

class Search {
 public:
  Search(const JointPath& path, const std::vector<ClearanceBody>& bodies,
         const std::vector<BodyPair>& pairs, const ClearanceOptions& options)
      : path_(path), bodies_(bodies), pairs_(pairs), options_(options) {
    double size = 0;
    for (const ClearanceBody& body : bodies) size = std::max(size, body.shape.ball_radius());
    constexpr double least_gap = 1e-7;
    least_gap_ = least_gap * size;
  }

  Clearance run() {
    Clearance result;
    result.pairs = pairs_.size();
    result.steps_count = path_.steps();
    if (pairs_.empty()) return result;
    // What is seen at the rows says where there is no need to look closely.
    double enough = std::numeric_limits<double>::infinity();
    if (!options_.every_step) {
      std::vector<double> at_rows(path_.times.size());
      parallel_for(at_rows.size(), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) at_rows[i] = least_at_row(i);
      });
      enough = *std::ranges::min_element(at_rows);
    }
    std::vector<Step> steps(path_.steps());
    parallel_for(steps.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) steps[i] = search_step(i, enough);
    });
    for (const Step& step : steps) {
      Closest& closest = result.closest;
      const double lower = std::min(closest.lower, step.closest.lower);
      const bool is_settled = closest.is_settled && step.closest.is_settled;
      if (step.closest.upper < closest.upper) closest = step.closest;
      closest.lower = lower;
      closest.is_settled = is_settled;
      result.distances += step.distances;
      if (options_.every_step) result.steps.push_back(step.closest);
    }
    return result;
  }

 private:
  struct Step {
    Closest closest;
    std::size_t distances = 0;
  };

  double least_at_row(std::size_t row) const {
    const bool is_last = row == path_.steps() && row > 0;
    StepMotion motion(path_, is_last ? row - 1 : row);
    double least = std::numeric_limits<double>::infinity();
    for (const BodyPair& pair : pairs_) {
      const StepPair step(bodies_[pair.a], bodies_[pair.b], motion);
      least = std::min(least, step.at(is_last ? 1 : 0, least).upper);
    }
    return least;
  }

  Step search_step(std::size_t index, double enough) const {
    StepMotion motion(path_, index);
    Step step;
    Closest& closest = step.closest;
    if (options_.every_step) {
      enough = std::min(least_at_row(index),
                        least_at_row(index + 1 < path_.times.size() ? index + 1 : index));
    }
    LeastDistanceOptions how;
    how.gap = least_gap_;
    how.relative_gap = options_.tolerance;
    for (const BodyPair& pair : pairs_) {
      const StepPair moving(bodies_[pair.a], bodies_[pair.b], motion);
      if (!moving.is_within_numbers()) {
        closest.lower = -std::numeric_limits<double>::infinity();
        closest.is_settled = false;
        continue;
      }
      how.enough = std::min(enough, closest.upper);
      const double by_balls = moving.lower_by_balls();
      if (by_balls > how.enough) {
        closest.lower = std::min(closest.lower, by_balls);
        continue;
      }
      const LeastDistance found = least_distance(moving, how);
      step.distances += static_cast<std::size_t>(found.distances);
      closest.lower = std::min(closest.lower, found.lower);
      closest.is_settled &= found.is_settled;
      if (!(found.upper < closest.upper)) continue;
      closest.upper = found.upper;
      closest.time = motion.time_at(found.s);
      closest.a = pair.a;
      closest.b = pair.b;
      closest.distance = in_world(found.there, moving.frame_at(found.s));
    }
    return step;
  }

  const JointPath& path_;
  const std::vector<ClearanceBody>& bodies_;
  const std::vector<BodyPair>& pairs_;
  const ClearanceOptions& options_;
  double least_gap_;
};

}  // namespace

Clearance clearance_of(const JointPath& path, const std::vector<ClearanceBody>& bodies,
                       const std::vector<BodyPair>& pairs, const ClearanceOptions& options) {
  return Search(path, bodies, pairs, options).run();
}

}  // namespace minkray
