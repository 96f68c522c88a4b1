// SPDX-License-Identifier: MIT
#include "renderer/clearance/clearance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/pair_motion/least_distance.h"
#include "core/parallel/parallel.h"
#include "renderer/clearance/step_pair.h"

namespace minkray {
namespace {

class MovingBodies : public MovingPair {
 public:
  MovingBodies(const ClearanceBody& a, const ClearanceBody& b, StepMotion& motion)
      : a_(a), b_(b), motion_(motion), bound_(step_bound(a, b, motion)) {
    speed = bound_.speed;
    acceleration = bound_.acceleration;
    size = bound_.size;
    if ((a.mesh || b.mesh) && !a.plane && !b.plane) least = 0;
  }

  SignedDistance at(double s, double at_most) const override {
    SignedDistanceOptions options;
    options.at_most = at_most;
    return moment(s).distance(options);
  }
  double gap(const Vec3<double>& n, double s) const override { return moment(s).gap(n); }

  /// Converts a result at s to world space.
  SignedDistance in_world(const SignedDistance& found, double s) const {
    return moment(s).in_world(found);
  }

  /// If not, nothing can be proven about the step.
  bool is_within_numbers() const { return bound_.is_within_numbers; }

  /// No distance of the step is less, by the balls around the two alone.
  double lower_by_balls() const {
    if (a_.plane || b_.plane) return -std::numeric_limits<double>::infinity();
    const Between apart = moment(0.5).between;
    const double distance = length_of(apart.x), lower = distance - size - speed / 2 -
                                                        core_rounding * (distance + size + speed) -
                                                        apart.loss;
    // Beyond the numbers' range nothing is known.
    return std::isfinite(lower) ? lower : -std::numeric_limits<double>::infinity();
  }

 private:
  StepMoment moment(double s) const {
    return {a_, place_of(a_, motion_, s), b_, place_of(b_, motion_, s), bound_, motion_, s};
  }

  const ClearanceBody &a_, &b_;
  StepMotion& motion_;
  StepBound bound_;
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
