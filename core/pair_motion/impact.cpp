// SPDX-License-Identifier: MIT
#include "core/pair_motion/impact.h"

#include <algorithm>
#include <cmath>

#include "core/pair_motion/straight_impact.h"
#include "core/pair_motion/turning_body.h"

namespace minkray {
namespace {

/// Rounding of a body's pose, relative to its size and its pivot's displacement.
constexpr double rounding = 32 * std::numeric_limits<double>::epsilon();

/// Least time after which bodies that part are checked again, as a fraction of the requested time,
/// or of the time in which they turn by a radian.
constexpr double first_step = 1e-30;

/// Number of distance queries that may run out of support points before the search ends. For bodies
/// of infinite size all queries do, and each takes as long as a thousand others.
constexpr int most_exhausted = 10;

class Advance {
 public:
  Advance(const ContactShape& a, const RigidMotion& motion_a, const ContactShape& b,
          const RigidMotion& motion_b, double t_max, PairMemory* memory,
          const ImpactOptions& options)
      : a_(a),
        b_(b),
        of_a_(motion_a),
        of_b_(motion_b),
        turning_a_(a, motion_a),
        turning_b_(b, motion_b),
        velocity_(motion_b.velocity - motion_a.velocity),
        t_max_(t_max),
        memory_(memory),
        options_(options) {
    size_ = a.ball_radius() + b.ball_radius();
    touching_ = options.touching * size_;
  }

  /// Called after a miss: a plane with this normal separates the bodies until the end.
  Impact run_missed(const Vec3<double>& normal) {
    bring_near();
    return miss(t_max_, normal);
  }

  Impact run() {
    bring_near();
    // Every step starts from the final state of the previous step.
    PairMemory of_steps;
    if (!memory_) memory_ = &of_steps;
    SignedDistance now = at(0);
    if (gave_up(now)) return give_up(0, now);
    // Overlap or contact at the start ends the search unless the bodies part.
    if (now.upper < 0 || (now.value <= touching_ && approach(now, 0) <= parting()))
      return finish(ImpactStatus::inside, 0, 0, now);
    double t = 0;
    if (now.value <= touching_) {
      t = leave(now);
      if (t < 0) return finish(ImpactStatus::hit, 0, -t, now);
      if (!may_go_on()) return give_up(0, now);
      now = at(t);
      if (gave_up(now)) return give_up(0, now);
    }
    double t_end = t_max_;
    while (may_go_on() && !gave_up(now)) {
      if (now.value <= touching_) return meet(t, t_end, now);
      double next = proven_until(t, t_end, now);
      if (result_.steps > steps_of_fixed_planes)
        next = std::max(next, proven_by_turning_plane(t, t_end, now));
      if (next >= t_end) return miss(t_end, now.normal);
      if (!(next > t)) break;  // the time has no more digits
      t = next;
      now = at(t);
    }
    return give_up(t, now);
  }

 private:
  bool may_go_on() const {
    return result_.steps < options_.max_steps && exhausted_ < most_exhausted;
  }

  /// Number of steps after which planes may turn.
  static constexpr int steps_of_fixed_planes = 50;

  /// True if the distance query found no upper bound, or one too large for a contact. The lower
  /// bound alone does not prove a contact.
  bool gave_up(const SignedDistance& now) const {
    return now.is_unknown() || (now.value <= touching_ && now.upper > 2 * touching_);
  }

  /// Ends undecided, with no contact up to t.
  Impact give_up(double t, const SignedDistance& now) {
    return finish(ImpactStatus::undecided, t, std::numeric_limits<double>::infinity(), now);
  }

  /// Makes all positions relative to A, so that no number is larger than the bodies' sizes,
  /// distance and displacements.
  void bring_near() {
    const PlacedMiddle of_a = turning_a_.seen_from(), of_b = turning_b_.seen_from();
    start_ = {(of_b.at - of_a.at).rounded(), of_a.loss + of_b.loss};
    constexpr double of_arms = 8 * std::numeric_limits<double>::epsilon();
    start_.loss += of_arms * (turning_a_.arm_length() + turning_b_.arm_length());
    speed_ = length_of(velocity_) + turning_a_.speed() * turning_a_.reach() +
             turning_b_.speed() * turning_b_.reach();
  }

  /// Displacement of the bodies by the rounding of times and angles.
  double loss_at(double t) const {
    return start_.loss + 2 * std::numeric_limits<double>::epsilon() * t * speed_;
  }

  SignedDistance at(double t) {
    SignedDistanceOptions how;
    how.tolerance = std::min(1e-9, options_.touching);
    const SignedDistance there = at(t, how);
    exhausted_ += there.is_exhausted ? 1 : 0;
    return there;
  }

  /// Returns a distance whose upper bound is at most 0 only if the bodies overlap. Tries GJK alone
  /// first; if that is undecided, runs a more expensive search.
  SignedDistance overlap_at(double t) {
    SignedDistanceOptions how;
    how.only_sign = true;
    how.max_supports = 0;
    const SignedDistance there = at(t, how);
    if (there.upper <= 0 || !(there.upper <= touching_)) return there;
    constexpr int some_supports = 2000;
    how.max_supports = some_supports;
    return at(t, how);
  }

  SignedDistance at(double t, const SignedDistanceOptions& how) {
    ++result_.steps;
    const Affine<double> at_a = turning_a_.at(t), at_b = turning_b_.at(t);
    const Between between{start_.x + t * velocity_ + at_b.translation - at_a.translation,
                          loss_at(t)};
    return signed_distance(a_, at_a.linear, b_, at_b.linear, between, how, memory_);
  }

  /// Speed at which the nearest points separate; negative if they approach.
  double approach(const SignedDistance& now, double t) const {
    const Vec3<double> arm_a = turning_a_.at(t).translation,
                       arm_b = start_.x + t * velocity_ - arm_a;
    return now.normal.dot(velocity_ + turning_b_.velocity_of(now.point_b - arm_b) -
                          turning_a_.velocity_of(now.point_a + arm_a));
  }
  /// Speed below which bodies count as at rest.
  double parting() const { return options_.touching * speed_; }

  /// For bodies that touch at time 0 and part: returns a time at which they are apart, or minus a
  /// time at which they overlap. Turning bodies may come back. So the first check is at the
  /// earliest time at which the bodies may be apart, and then the time is doubled.
  double leave(const SignedDistance& now) {
    const double turning = std::max(turning_a_.speed(), turning_b_.speed()), apart = 4 * touching_;
    const double at_this_speed = apart / approach(now, 0);
    const double first = turning > 0 ? apart / speed_ : at_this_speed;
    // For two points, `apart` is 0, so the first time needs a lower limit.
    double t = std::max(first, first_step * std::min(t_max_, 1 / turning));
    while (t < t_max_ && may_go_on()) {
      const SignedDistance then = at(t);
      // Until the bodies can be apart, a slight overlap belongs to the contact at time 0.
      if (then.upper < (t < at_this_speed ? -touching_ : 0)) return -t;
      if (then.lower > 2 * touching_) return t;
      t *= 2;
    }
    return t_max_;
  }

  /// Gap of a fixed plane at a time, and both support functions along its normal.
  struct Gap {
    double gap, h_a, h_b;
  };
  Gap gap(double t, const Vec3<double>& n) const {
    const double h_a = turning_a_.support(turning_a_.at(t), n),
                 h_b = turning_b_.support(turning_b_.at(t), -n);
    return {n.dot(start_.x + t * velocity_) - h_a - h_b, h_a, h_b};
  }

  /// Proves that there is no contact from t to the returned time. That time is later than t unless
  /// rounding prevents it.
  double proven_until(double t, double t_end, const SignedDistance& now) {
    constexpr double largest_turn = 1;  // radians in one step
    const Vec3<double> n = now.normal;
    const Gap first = gap(t, n);
    double step = t_end - t;
    if (speed_ > 0) step = std::min(step, 16 * (now.value + size_) / speed_);
    const double turning = std::max(turning_a_.speed(), turning_b_.speed());
    if (turning > 0) step = std::min(step, largest_turn / turning);
    const bool is_last = step == t_end - t;
    const double of_sizes = rounding * (size_ + start_.x.norm() + t * speed_);
    const auto bulge = [](double angle, double at_first, double at_last) {
      return (1 / std::cos(angle / 2) - 1) * std::max({at_first, at_last, 0.0});
    };
    for (int i = 0; i < 60; ++i) {
      const Gap last = gap(t + step, n);
      const double allowed = of_sizes + loss_at(t + step);
      const double worst = last.gap - bulge(turning_a_.speed() * step, first.h_a, last.h_a) -
                           bulge(turning_b_.speed() * step, first.h_b, last.h_b) - allowed;
      if (worst > 0 && worst >= last.gap - first.gap) return i == 0 && is_last ? t_end : t + step;
      // Shortens the step to slightly before the zero of the line through the two gaps.
      const double down = first.gap - worst;
      step *= std::clamp(down > 0 ? 0.9999 * (first.gap - allowed) / down : 0.5, 0.0, 0.9);
      if (!(t + step > t)) break;
    }
    return t;
  }

  /// Same as proven_until() by a plane whose normal turns as that of the distance does. Where the
  /// edges of turning bodies pass each other slowly, a fixed plane soon cuts an edge: the steps are
  /// then a small part of the time to the contact. In the frame of a body, the normal moves on a
  /// curve p(t) with |p''| <= (its turning + the plane's)^2, and the support function changes by at
  /// most reach |p - q|. Between two times, the gap is therefore at least its interpolation minus
  /// bend step^2 / 8.
  double proven_by_turning_plane(double t, double t_end, const SignedDistance& now) {
    const double turning = std::max(turning_a_.speed(), turning_b_.speed());
    if (!(turning > 0)) return t;
    const double ahead = std::min(std::sqrt(std::max(now.value, 0.0) / size_) / turning, t_end - t);
    if (!(t + ahead > t)) return t;
    const SignedDistance then = at(t + ahead);
    if (then.is_unknown()) return t;
    const Vec3<double>&n = now.normal, across = then.normal - n.dot(then.normal) * n;
    const double sine = length_of(across);
    if (!(sine > 0 && sine < 0.5)) return t;
    const double plane_speed = std::asin(sine) / ahead;
    // Removes what rounding left of n.
    const Vec3<double> aside = (across / sine - n.dot(across / sine) * n).normalized();
    const auto square = [](double x) { return x * x; };
    const double first = gap(t, n).gap;
    const double way =
                     turning_a_.reach() + turning_b_.reach() + length_of(start_.x + t * velocity_),
                 rate = turning + plane_speed;
    double step = std::min({t_end - t, 1 / rate, 2 * std::sqrt(std::max(first, 0.0) / way) / rate});
    const bool is_last = step == t_end - t;
    for (int i = 0; i < 60 && t + step > t; ++i) {
      const double angle = plane_speed * step, end = t + step;
      const Vec3<double> turned = std::cos(angle) * n + std::sin(angle) * aside;
      const double furthest =
          std::max(length_of(start_.x + t * velocity_), length_of(start_.x + end * velocity_));
      const double bend = square(plane_speed) * furthest + 2 * plane_speed * length_of(velocity_) +
                          turning_a_.reach() * square(turning_a_.speed() + plane_speed) +
                          turning_b_.reach() * square(turning_b_.speed() + plane_speed);
      const double allowed =
          rounding * (size_ + furthest + start_.x.norm() + end * speed_) + loss_at(end);
      const double last = gap(end, turned).gap, least = bend * step * step / 8 + allowed;
      if (std::min(first, last) > least) return i == 0 && is_last ? t_end : end;
      const double down = first - last + least;
      step *= std::clamp(down > 0 ? 0.9999 * (first - allowed) / down : 0.5, 0.0, 0.9);
    }
    return t;
  }

  Impact miss(double t_end, const Vec3<double>& normal) {
    if (options_.points_of_misses) {
      const SignedDistance there = at(t_end);
      if (!there.is_unknown()) return finish(ImpactStatus::miss, t_end, t_end, there);
    }
    result_.normal = normal;
    result_.status = ImpactStatus::miss;
    result_.t_lo = result_.t_hi = t_end;
    return result_;
  }

  /// Called if the bodies touch at t up to rounding. Finds a time at which they certainly touch.
  Impact meet(double t, double t_end, const SignedDistance& now) {
    double t_hi = t;
    if (now.upper > 0) {
      // If the bodies approach, tries later times until they overlap. Otherwise they just touch.
      const double speed = -approach(now, t);
      constexpr double deep = 0.5;
      double later = std::max((2 * now.upper + deep * touching_) / std::max(speed, 1e-6 * speed_),
                              t * rounding);
      for (int i = 0; i < 40 && t + later <= t_end; ++i, later *= 2) {
        const SignedDistance then = overlap_at(t + later);
        if (then.upper <= 0) {
          t_hi = t + later;
          break;
        }
        if (then.value > 4 * touching_) break;
      }
    }
    return finish(ImpactStatus::hit, t, t_hi, now);
  }

  /// `now` is the distance at t_lo.
  Impact finish(ImpactStatus status, double t_lo, double t_hi, const SignedDistance& now) {
    result_.status = status;
    result_.t_lo = t_lo;
    result_.t_hi = t_hi;
    result_.normal = now.normal;
    if (now.is_unknown()) return result_;
    const Vec3<double> middle = middle_in_world(a_, of_a_.at(t_lo));
    result_.point_a = middle + now.point_a;
    result_.point_b = middle + now.point_b;
    result_.distance = now.value;
    return result_;
  }

  const ContactShape &a_, &b_;
  const RigidMotion &of_a_, &of_b_;
  Turning turning_a_, turning_b_;
  Vec3<double> velocity_;  ///< of B relative to A
  Between start_;          ///< from A's reference point to B's, at time 0
  double t_max_;
  PairMemory* memory_;
  const ImpactOptions& options_;
  double size_ = 0, speed_ = 0, touching_ = 0;
  int exhausted_ = 0;  ///< number of exhausted distance queries
  Impact result_;
};

Impact find_impact(const ContactShape& a, const RigidMotion& motion_a, const ContactShape& b,
                   const RigidMotion& motion_b, double t_max, PairMemory* memory,
                   const ImpactOptions& options) {
  Impact swept;
  const bool is_turning = motion_a.angular_velocity != Vec3<double>::Zero() ||
                          motion_b.angular_velocity != Vec3<double>::Zero();
  const SweptStatus status =
      is_turning ? SweptStatus::open
                 : straight_impact(a, motion_a, b, motion_b, t_max, options, memory, swept);
  if (status == SweptStatus::hit) return swept;
  Advance advance(a, motion_a, b, motion_b, t_max, memory, options);
  return status == SweptStatus::miss ? advance.run_missed(swept.normal) : advance.run();
}

}  // namespace

Affine<double> RigidMotion::at(double time) const {
  Affine<double> moved = pose;
  moved.translation += time * velocity;
  const double speed = length_of(angular_velocity);
  if (speed > 0)
    moved.linear =
        Eigen::AngleAxis<double>(time * speed, angular_velocity / speed).toRotationMatrix() *
        pose.linear;
  return moved;
}

Impact first_impact(const ContactShape& a, const RigidMotion& motion_a, const ContactShape& b,
                    const RigidMotion& motion_b, double t_max, const ImpactOptions& options) {
  return find_impact(a, motion_a, b, motion_b, t_max, nullptr, options);
}

Impact first_impact(const ContactShape& a, const RigidMotion& motion_a, const ContactShape& b,
                    const RigidMotion& motion_b, double t_max, PairMemory& memory,
                    const ImpactOptions& options) {
  return find_impact(a, motion_a, b, motion_b, t_max, &memory, options);
}

}  // namespace minkray
