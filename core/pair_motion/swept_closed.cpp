// SPDX-License-Identifier: MIT
#include "core/pair_motion/swept_closed.h"

#include "core/pair/closed_pairs.h"

namespace minkray {
namespace {

/// Signed distance at a time, in the frame of the search.
template <class DistanceAt>
class ClosedSweep {
 public:
  ClosedSweep(const CorePair& pair, const Vec3<double>& velocity, double t_max, double near,
              const DistanceAt& distance_at)
      : velocity_(velocity), t_max_(t_max), near_(near), distance_at_(distance_at) {
    radius_of_a_ = pair.a.radius;
    radii_ = pair.a.radius + pair.b.radius;
    rounding_ = pair.rounding();
    speed_ = velocity.norm();
  }

  SweptTime run() {
    if (!(speed_ > 0)) return result_;
    const double least = std::max(near_as_asked * near_, rounding_);
    double t = 0;
    for (int step = 0; step < most_steps; ++step) {
      const CoreDistance found = distance_at_(t);
      const double gap = found.lower - radii_ - rounding_, approach = -found.axis.dot(velocity_);
      // Nothing is known of what begins in contact.
      if (step == 0 && !(gap > near_)) return result_;
      if (!(approach > 0)) {
        if (gap > near_) end(SweptStatus::miss, found.axis);
        return result_;
      }
      if (gap - (t_max_ - t) * approach > near_) {
        end(SweptStatus::miss, found.axis);
        return result_;
      }
      const double next = t + gap / approach;
      if (next > result_.t_lo) {
        result_.t_lo = next;
        result_.axis = found.axis;
      }
      if (!(gap > least)) return touch(std::max(t, next), approach);
      t = next;
    }
    return result_;
  }

 private:
  static constexpr int most_steps = 40;
  /// Nearer than this part of what is near enough the last step has found where they touch.
  static constexpr double near_as_asked = 1e-4;

  void end(SweptStatus status, const Vec3<double>& axis) {
    result_.status = status;
    result_.axis = unit<double>(axis);
  }

  /// At t they are next to nothing apart: a little later they overlap.
  SweptTime touch(double t, double approach) {
    const double later = t + (2 * rounding_ + near_as_asked * near_) / approach;
    const CoreDistance there = distance_at_(later);
    if (!(there.upper - radii_ <= 0)) return result_;
    result_.t_hi = later;
    if (!((later - result_.t_lo) * speed_ <= near_)) return result_;
    result_.a = there.a + radius_of_a_ * there.axis;
    end(SweptStatus::hit, result_.axis);
    return result_;
  }

  const Vec3<double>& velocity_;
  double t_max_, near_;
  const DistanceAt& distance_at_;
  double radius_of_a_, radii_, rounding_, speed_;
  SweptTime result_;
};

template <class DistanceAt>
SweptTime sweep(const CorePair& pair, const Vec3<double>& velocity, double t_max, double near,
                const DistanceAt& distance_at) {
  return ClosedSweep<DistanceAt>(pair, velocity, t_max, near, distance_at).run();
}

}  // namespace

bool has_swept_closed(const CorePair& pair) {
  return is_line(pair.b) || (pair.a.kind == CoreKind::point && is_solid(pair.b));
}

SweptTime swept_closed(const CorePair& pair, const Vec3<double>& velocity, double t_max,
                       double near) {
  if (is_line(pair.b)) {
    const Vec3<double> p(0, 0, pair.a.size.z()), q = pair.turn.col(2) * pair.b.size.z();
    return sweep(pair, velocity, t_max, near, [&](double t) {
      return between_segments(p, q, Vec3<double>(pair.x + t * velocity));
    });
  }
  // As the solid sees it, in whose frame the point moves the other way.
  const Vec3<double> x = pair.to_b(pair.x), v = pair.to_b(velocity);
  SweptTime found = sweep(pair, v, t_max, near, [&](double t) {
    CoreDistance at = between_solid_and_point(pair.b, Vec3<double>(-x - t * v));
    at.axis = -at.axis;
    at.c = -at.c;
    at.a.setZero();
    return at;
  });
  found.axis = pair.turn * found.axis;
  found.a = pair.turn * found.a;
  return found;
}

}  // namespace minkray
