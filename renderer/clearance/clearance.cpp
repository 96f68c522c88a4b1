// SPDX-License-Identifier: MIT
#include "renderer/clearance/clearance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/pair_distance/half_space_distance.h"
#include "core/pair_motion/least_distance.h"
#include "core/parallel/parallel.h"
#include "renderer/clearance/body_pair.h"

namespace minkray {
namespace {

/// Two bodies during one step, in the frame that what they hang on has in common.
class MovingBodies : public MovingPair {
 public:
  MovingBodies(const ClearanceBody& a, const ClearanceBody& b, StepMotion& motion)
      : a_(a), b_(b), motion_(motion) {
    const bool is_in_world = a.plane || b.plane;
    frame_ = is_in_world ? -1 : motion.common_ancestor(a.link_index, b.link_index);
    double reaches = 0;
    for (const ClearanceBody* body : {&a, &b}) {
      if (body->plane) continue;
      const MotionBound bound = motion.bound(body->link_index, frame_, body->reach());
      is_within_numbers_ &= bound.is_within_numbers();
      speed += bound.speed;
      acceleration += bound.acceleration;
      size += body->ball_radius();
      loss_ += bound.rounding + body->middle.loss;
      if (body->link_index >= 0) reaches += bound.reach;
    }
    loss_ += motion.turn_error(frame_) * reaches;
    if ((a.mesh || b.mesh) && !is_in_world) least = 0;
  }

  /// Points are seen from A's middle, or of half-spaces in the world.
  SignedDistance at(double s, double at_most) const override {
    const Place of_a = place(a_, s), of_b = place(b_, s);
    if (a_.plane) return distance_to_half_space(*a_.plane, b_, of_b.linear, {of_b.middle, loss_});
    if (b_.plane) {
      SignedDistance found =
          distance_to_half_space(*b_.plane, a_, of_a.linear, {of_a.middle, loss_});
      std::swap(found.point_a, found.point_b);
      found.normal = -found.normal;
      return found;
    }
    SignedDistanceOptions options;
    options.at_most = at_most;
    return distance_between(a_, of_a.linear, b_, of_b.linear, between(of_a, of_b), options);
  }

  double gap(const Vec3<double>& n, double s) const override {
    if (a_.plane || b_.plane) {
      const SignedDistance there = at(s, 0);
      const double turned = n.dot(there.normal);
      // Along any other direction a half-space has no end.
      return turned > 1 - 1e-12 ? there.lower : -std::numeric_limits<double>::infinity();
    }
    const Place of_a = place(a_, s), of_b = place(b_, s);
    return gap_between(a_, of_a.linear, b_, of_b.linear, between(of_a, of_b), n);
  }

  /// Converts a result at s to world space.
  SignedDistance in_world(SignedDistance found, double s) const {
    if (a_.plane || b_.plane || found.normal.isZero(0)) return found;
    const Mat3<double> turn = frame_turn(s);
    const Vec3<double> middle = place(a_, s).middle.high;
    found.point_a = middle + turn * found.point_a;
    found.point_b = middle + turn * found.point_b;
    found.normal = turn * found.normal;
    return found;
  }

  /// If not, nothing can be proven about the step.
  bool is_within_numbers() const { return is_within_numbers_; }

  /// No distance of the step is less, by the balls around the two alone.
  double lower_by_balls() const {
    if (a_.plane || b_.plane) return -std::numeric_limits<double>::infinity();
    const Between apart = between(place(a_, 0.5), place(b_, 0.5));
    const double distance = length_of(apart.x), lower = distance - size - speed / 2 -
                                                        core_rounding * (distance + size + speed) -
                                                        apart.loss;
    // Beyond the numbers' range nothing is known.
    return std::isfinite(lower) ? lower : -std::numeric_limits<double>::infinity();
  }

 private:
  /// Place of a body: the middle in the world, the turn to the axes of the common frame.
  struct Place {
    Mat3<double> linear;
    TwoFoldVec3<double> middle;
    const Affine<double>* frame;
  };

  Mat3<double> frame_turn(double s) const {
    if (frame_ < 0) return Mat3<double>::Identity();
    return motion_.links_at(s)[static_cast<std::size_t>(frame_)].linear;
  }

  Place place(const ClearanceBody& body, double s) const {
    const StepMotion::Places& links = motion_.places_at(s);
    const Affine<double>* frame =
        frame_ < 0 ? nullptr : &links.poses[static_cast<std::size_t>(frame_)];
    Place found{body.linear, body.middle.at, frame};
    if (body.link_index >= 0) {
      const auto link = static_cast<std::size_t>(body.link_index);
      const Mat3<double>& turn = links.poses[link].linear;
      found.linear = turn * body.linear;
      found.middle = links.origin(link) +
                     TwoFoldVec3<double>(turn * body.middle.at.high, turn * body.middle.at.low);
    }
    if (frame) found.linear = frame->linear.transpose() * found.linear;
    return found;
  }

  Between between(const Place& of_a, const Place& of_b) const {
    const Vec3<double> x = (of_b.middle - of_a.middle).rounded();
    return {of_a.frame ? Vec3<double>(of_a.frame->linear.transpose() * x) : x, loss_};
  }

  const ClearanceBody &a_, &b_;
  StepMotion& motion_;
  int frame_;
  bool is_within_numbers_ = true;
  double loss_ = 0;  ///< of the bodies' places, as the common frame has them
};

class Search {
 public:
  Search(const JointPath& path, const std::vector<ClearanceBody>& bodies,
         const std::vector<BodyPair>& pairs, const ClearanceOptions& options)
      : path_(path), bodies_(bodies), pairs_(pairs), options_(options) {
    double size = 0;
    for (const ClearanceBody& body : bodies) size = std::max(size, body.ball_radius());
    constexpr double least_gap = 1e-7;
    least_gap_ = least_gap * size;
  }

  Clearance run() {
    Clearance result;
    result.pairs = pairs_.size();
    result.steps_count = path_.steps();
    if (pairs_.empty()) return result;
    // Distances at the rows show which steps need no close examination.
    std::vector<Closest> at_rows(path_.times.size());
    parallel_for(at_rows.size(), 4, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) at_rows[i] = least_at_row(i);
    });
    const auto is_nearer = [](const Closest& a, const Closest& b) { return a.upper < b.upper; };
    const Closest& least = *std::ranges::min_element(at_rows, is_nearer);
    std::vector<Step> steps(path_.steps());
    parallel_for(steps.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        steps[i] = search_step(
            i, options_.every_step
                   ? std::min(at_rows[i], at_rows[std::min(i + 1, at_rows.size() - 1)], is_nearer)
                   : least);
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

  Closest least_at_row(std::size_t row) const {
    const bool is_last = row == path_.steps() && row > 0;
    StepMotion motion(path_, is_last ? row - 1 : row);
    Closest least;
    for (const BodyPair& pair : pairs_) {
      const MovingBodies step(bodies_[pair.a], bodies_[pair.b], motion);
      const double s = is_last ? 1 : 0;
      const SignedDistance found = step.at(s, least.upper);
      if (found.upper < least.upper) keep(least, pair, found, step, motion, s);
    }
    return least;
  }

  static void keep(Closest& closest, const BodyPair& pair, const SignedDistance& found,
                   const MovingBodies& moving, const StepMotion& motion, double s) {
    closest.upper = found.upper;
    closest.time = motion.time_at(s);
    closest.a = pair.a;
    closest.b = pair.b;
    closest.distance = moving.in_world(found, s);
  }

  /// `seen` is the least that was seen at rows: it is the answer if there is nothing nearer.
  Step search_step(std::size_t index, const Closest& seen) const {
    StepMotion motion(path_, index);
    Step step;
    Closest& closest = step.closest;
    closest = seen;
    LeastDistanceOptions how;
    how.gap = least_gap_;
    how.relative_gap = options_.tolerance;
    for (const BodyPair& pair : pairs_) {
      const MovingBodies moving(bodies_[pair.a], bodies_[pair.b], motion);
      if (!moving.is_within_numbers()) {
        closest.lower = -std::numeric_limits<double>::infinity();
        closest.is_settled = false;
        continue;
      }
      how.enough = closest.upper;
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
      keep(closest, pair, found.there, moving, motion, found.s);
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
