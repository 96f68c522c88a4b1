// SPDX-License-Identifier: MIT
#include "core/pair_motion/swept_closed.h"

#include <algorithm>
#include <cmath>

#include "core/pair/closed_pairs.h"

namespace minkray {
namespace {

/// Searches by the signed distance at given times. A separating plane at any time proves a lower
/// bound of the time of contact, so steps may overshoot. `guess` proposes the time at which the
/// features touch that are nearest at a given time.
template <class DistanceAt, class Guess>
class ClosedSweep {
 public:
  ClosedSweep(const CorePair& pair, const Vec3<double>& velocity, double t_max, double near,
              const DistanceAt& distance_at, const Guess& guess)
      : velocity_(velocity), t_max_(t_max), near_(near), distance_at_(distance_at), guess_(guess) {
    radius_of_a_ = pair.a.radius;
    radii_ = pair.a.radius + pair.b.radius;
    rounding_ = pair.rounding();
    speed_ = velocity.norm();
    passed_ = (pair.x.norm() + pair.size() + radii_ + near_ + rounding_) / speed_;
    latest_ = std::min(t_max, passed_);
  }

  SweptTime run() {
    if (!(speed_ > 0)) return result_;
    const double least = std::max(near_as_asked * near_, rounding_);
    double t = 0;
    int guesses = 0;
    for (int step = 0; step < most_steps; ++step) {
      const bool is_guess = t > result_.t_lo;
      const CoreDistance found = distance_at_(t);
      const double gap = found.lower - radii_ - rounding_, approach = -found.axis.dot(velocity_);
      // Contacts at the start are not decided here.
      if (step == 0 && !(gap > near_)) return result_;
      if (!(approach > 0)) {
        if (is_guess) {
          t = result_.t_lo;
          guesses = most_guesses;
          continue;
        }
        if (gap > near_) end(SweptStatus::miss, found.axis);
        return result_;
      }
      if (gap - (t_max_ - t) * approach > near_) {
        end(SweptStatus::miss, found.axis);
        return result_;
      }
      const double next = t + gap / approach;
      if (next > passed_) {
        end(SweptStatus::miss, found.axis);
        return result_;
      }
      if (next > result_.t_lo) {
        result_.t_lo = next;
        result_.axis = found.axis;
      }
      if (!(gap > least) && (!is_guess || gap >= -least)) return touch(std::max(t, next), approach);
      const double at = t;
      t = result_.t_lo;
      if (gap > 0 && guesses < most_guesses) {
        ++guesses;
        const double later = guess_(found, at, radii_);
        if (later > t && later <= latest_) t = later;
      }
    }
    return result_;
  }

 private:
  static constexpr int most_steps = 40, most_guesses = 4;
  /// The search ends with a contact if the gap is below this fraction of `near`.
  static constexpr double near_as_asked = 1e-4;

  void end(SweptStatus status, const Vec3<double>& axis) {
    result_.status = status;
    result_.axis = unit<double>(axis);
  }

  /// Called if the gap at t is tiny. Proves that the cores overlap slightly later.
  SweptTime touch(double t, double approach) {
    const double later = t + (2 * rounding_ + near_as_asked * near_) / approach;
    const CoreDistance there = distance_at_(later);
    if (!(there.upper - radii_ <= 0)) return result_;
    result_.t_hi = later;
    if (!have_met(later - result_.t_lo, speed_, near_, rounding_,
                  [&] { return -result_.axis.dot(velocity_); }))
      return result_;
    result_.a = there.a + radius_of_a_ * there.axis;
    end(SweptStatus::hit, result_.axis);
    return result_;
  }

  const Vec3<double>& velocity_;
  double t_max_, near_;
  const DistanceAt& distance_at_;
  const Guess& guess_;
  double radius_of_a_, radii_, rounding_, speed_;
  double passed_;  ///< after this time, the middles are too far apart for a contact
  double latest_;  ///< the smaller of passed_ and t_max_
  SweptTime result_;
};

template <class DistanceAt, class Guess>
SweptTime sweep(const CorePair& pair, const Vec3<double>& velocity, double t_max, double near,
                const DistanceAt& distance_at, const Guess& guess) {
  return ClosedSweep<DistanceAt, Guess>(pair, velocity, t_max, near, distance_at, guess).run();
}

/// Returns the time at which the nearest features of two segments (p on A, q on B) are `radii`
/// apart. The feature of a segment is an end, or the line if the nearest point is not an end. NaN
/// if the features never come this close, or move in parallel.
double contact_of_features(const Vec3<double>& p, const Vec3<double>& q, const Vec3<double>& x,
                           const Vec3<double>& velocity, const CoreDistance& found, double at,
                           double radii) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double within = 1 - 1e-9;  // points further from the middle count as an end
  const double pp = p.squaredNorm(), qq = q.squaredNorm();
  const Vec3<double> on_b = found.c + found.a - x;
  const bool is_within_a = found.a.squaredNorm() < within * pp,
             is_within_b = on_b.squaredNorm() < within * qq;
  if (is_within_a && is_within_b) return nan;
  Vec3<double> c = found.c, v = velocity;
  const auto leave_out = [&](const Vec3<double>& along, double squared) {
    c -= (c.dot(along) / squared) * along;
    v -= (v.dot(along) / squared) * along;
  };
  if (is_within_a) leave_out(p, pp);
  if (is_within_b) leave_out(q, qq);
  const double vv = v.squaredNorm(), cv = -c.dot(v), beyond = c.squaredNorm() - radii * radii;
  return at + beyond / (cv + std::sqrt(cv * cv - vv * beyond));
}

}  // namespace

bool has_swept_closed(const CorePair& pair) {
  return is_line(pair.b) || (pair.a.kind == CoreKind::point && is_solid(pair.b));
}

SweptTime swept_closed(const CorePair& pair, const Vec3<double>& velocity, double t_max,
                       double near) {
  if (is_line(pair.b)) {
    const Vec3<double> p(0, 0, pair.a.size.z()), q = pair.turn.col(2) * pair.b.size.z();
    return sweep(
        pair, velocity, t_max, near,
        [&](double t) { return between_segments(p, q, Vec3<double>(pair.x + t * velocity)); },
        [&](const CoreDistance& found, double at, double radii) {
          return contact_of_features(p, q, pair.x + at * velocity, velocity, found, at, radii);
        });
  }
  // In the solid's frame, the point moves in the opposite direction.
  const Vec3<double> x = pair.to_b(pair.x), v = pair.to_b(velocity);
  const auto distance_at = [&](double t) {
    CoreDistance at = between_solid_and_point(pair.b, Vec3<double>(-x - t * v));
    at.axis = -at.axis;
    at.c = -at.c;
    at.a.setZero();
    return at;
  };
  const auto no_guess = [](const CoreDistance&, double, double) {
    return std::numeric_limits<double>::quiet_NaN();
  };
  SweptTime found = sweep(pair, v, t_max, near, distance_at, no_guess);
  found.axis = pair.turn * found.axis;
  found.a = pair.turn * found.a;
  return found;
}

}  // namespace minkray
