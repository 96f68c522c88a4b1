// SPDX-License-Identifier: MIT
// Derivatives of signed distances, judged by central differences in long double of distances that
// share nothing with the engine (tests/oracle/long_distance.h). One-sided differences
// decide where a ridge is reported.
#pragma once

#include <string>
#include <vector>

#include "core/pair_derivative/pair_derivative.h"
#include "tests/core/pair_distance/aligned_bodies.h"
#include "tests/core/pair_distance/pair_judge.h"
#include "tests/oracle/long_distance.h"

namespace minkray::testing {

inline constexpr int kinds_of_derived_bodies = kinds_of_bodies + 6;

/// Those of random_shape(), and what is made of several shapes or known by its support only.
inline Shape derived_shape(int kind, double s, RandomShapes& random) {
  if (kind < kinds_of_bodies) return random_shape(kind, s, random);
  const auto part = [&](int of, double size) { return Nested(random_shape(of, size, random)); };
  const auto moved = [&](int of) {
    const Affine<double> pose{random.turn(), 0.5 * s * random.direction()};
    return Nested(Shape(Transform{part(of, 0.6 * s), pose}));
  };
  switch (kind - kinds_of_bodies) {
    case 0:
      return MinkowskiSum{{part(5, 0.6 * s), part(4, 0.6 * s)}};
    case 1:
      return MinkowskiSum{{moved(7), moved(8)}};
    case 2:
      return Rounded{s * random.in(0.05, 0.3), part(11, s)};
    case 3:
      return HullOf{{moved(3), moved(4), moved(0)}};
    case 4:
      return Superellipsoid{{s * random.in(0.2, 1), s * random.in(0.2, 1), s * random.in(0.2, 1)},
                            random.in(1.5, 4)};
    default:
      return CutCylinder{s * random.in(0.2, 0.6), {-s, s}, {0.5, 0.2}, {0.3, -0.4}};
  }
}

inline std::string_view name_of_derived(int kind) {
  constexpr std::string_view names[] = {"point",          "segment",           "triangle",
                                        "sphere",         "ellipsoid",         "box",
                                        "disk",           "cylinder",          "cone",
                                        "capsule",        "frustum",           "hull of 12",
                                        "hull of 64",     "rounded box",       "rounded cylinder",
                                        "tapered",        "sheared ellipsoid", "sum box+ell",
                                        "sum cyl+cone",   "rounded hull",      "hull of shapes",
                                        "superellipsoid", "cut cylinder"};
  return names[kind];
}

enum class Slope : unsigned char {
  smooth,  ///< one derivative
  ridge,   ///< one-sided differences that do not agree
  unsure,  ///< the oracle's own bounds are too far apart, or a kink is next to it
};

struct JudgedDerivative {
  bool is_known = false;  ///< the engine gave one
  bool is_flagged = false;
  Slope slope = Slope::unsure;
  double error = 0;       ///< the largest along a unit twist, relative to the derivative's length
  bool is_within = true;  ///< the bounds of the errors
  double bound = 0;       ///< the largest of them along a unit twist
  bool is_global = true;  ///< no direction with a lesser depth was found
  double value = 0;       ///< the distance in sizes
};

/// A unit twist: turns count in sizes.
struct UnitTwist {
  bool of_a;
  Vec3<double> velocity, turn;
};

class DerivativeJudge {
 public:
  DerivativeJudge(const Body& a, const Body& b, RandomShapes& random, bool is_thorough)
      : core_a_(without_radius(a.shape)),
        core_b_(without_radius(b.shape)),
        a_{&core_a_.shape, a.pose.cast<Long>()},
        b_{&core_b_.shape, b.pose.cast<Long>()},
        size_(size_of(a, b)),
        random_(random) {
    // Far from the origin long double has few digits, too.
    b_.pose.translation -= a_.pose.translation;
    a_.pose.translation.setZero();
    const SignedDistance found = signed_distance(a, b, for_derivatives());
    if (found.is_unknown() || !(size_ > 0)) return;
    const PairDerivative derivative =
        derivative_of(a.ready, a.pose, b.ready, b.pose, found, &bounds_);
    judged_.is_known = true;
    judged_.is_flagged = derivative.is_ridge;
    judged_.value = found.value / size_;
    normals_ = {found.normal.cast<Long>()};
    is_apart_ = found.value + core_a_.radius + core_b_.radius > touching * size_;
    if (!is_apart_ && (is_thorough || derivative.is_ridge)) find_other_depths();
    middle_ = value(a_, b_);
    if (!(middle_.unsure <= 1e-14L * size_)) return;
    judge(derivative);
  }

  const JudgedDerivative& judged() const { return judged_; }

 private:
  using Long = long double;
  static constexpr double touching = 1e-4;  ///< in sizes: nearer ones are moved out
  static constexpr Long agreed = 1e-7L;     ///< of differences, to be taken as the derivative

  struct Value {
    Long value = 0, unsure = std::numeric_limits<Long>::infinity();
  };

  Value value(const LongBody& a, const LongBody& b) const {
    if (is_apart_) {
      const LongDistance found = long_distance(a, b, normals_[0]);
      if (found.overlaps) return {};
      return {found.upper, found.upper - found.lower};
    }
    Value best{-std::numeric_limits<Long>::infinity(), 0};
    for (const Real3& normal : normals_) {
      const LongDepth depth = climb(a, b, normal, size_);
      best.value = std::max(best.value, depth.value);
      best.unsure = std::max(best.unsure, depth.unsure);
    }
    return best;
  }

  /// Other directions that separate by as little, as far as a handful of climbs finds them.
  void find_other_depths() {
    const Long near = 1e-5L * size_;
    std::vector<LongDepth> all = {climb(a_, b_, normals_[0], size_)};
    Long best = all[0].value;
    const auto add = [&](const Real3& from) {
      const LongDepth depth = climb(a_, b_, from, size_, 60);
      best = std::max(best, depth.value);
      all.push_back(depth);
    };
    for (int i = 0; i < 3; ++i)
      for (const Long sign : {-1.0L, 1.0L}) {
        add(sign * a_.pose.linear.col(i));
        add(sign * b_.pose.linear.col(i));
      }
    for (int i = 0; i < 8; ++i) add(random_.direction().cast<Long>());
    judged_.is_global = all[0].value >= best - 1e-9L * size_;
    for (std::size_t i = 1; i < all.size(); ++i) {
      bool is_new = all[i].value >= best - near;
      for (const Real3& normal : normals_)
        is_new = is_new && (normal - all[i].normal).norm() > 1e-4L;
      if (is_new) normals_.push_back(all[i].normal);
    }
  }

  UnitTwist random_twist(bool of_a) {
    const double angle = random_.in(0, 1.5707963);
    return {of_a, std::cos(angle) * random_.direction(),
            std::sin(angle) / size_ * random_.direction()};
  }

  Value moved(const UnitTwist& twist, Long step) const {
    const Real3 velocity = twist.velocity.cast<Long>(), turn = twist.turn.cast<Long>();
    return twist.of_a ? value(twisted(a_, velocity, turn, step), b_)
                      : value(a_, twisted(b_, velocity, turn, step));
  }

  struct Differences {
    Long central, kink, unsure;
  };
  Differences differences(const UnitTwist& twist, Long step) const {
    const Long rounding =
        64 * std::numeric_limits<Long>::epsilon() * (size_ + b_.pose.translation.norm());
    const Value up = moved(twist, step), down = moved(twist, -step);
    return {(up.value - down.value) / (2 * step),
            std::abs(up.value + down.value - 2 * middle_.value) / step,
            (up.unsure + down.unsure + middle_.unsure + rounding) / step};
  }

  /// The derivative along a twist: of central differences by ever shorter steps, those that agree
  /// best. A kink that stays when steps get shorter is a ridge.
  struct Truth {
    Slope slope = Slope::unsure;
    Long derivative = 0, unsure = 0;
  };
  Truth truth(const UnitTwist& twist) const {
    constexpr Long kinked = 1e-4L;
    Truth best;
    Long least = agreed;
    int kinks = 0, steps = 0;
    Differences longer = differences(twist, 1e-6L * size_);
    for (Long step = 1e-7L * size_; step >= 0.9e-11L * size_; step /= 10) {
      const Differences found = differences(twist, step);
      if (!(found.unsure <= kinked)) break;
      ++steps;
      kinks += found.kink > kinked && found.kink > longer.kink / 3 ? 1 : 0;
      const Long off = std::abs(found.central - longer.central) + found.unsure;
      if (off < least) {
        least = off;
        best = {Slope::smooth, found.central, off};
      }
      longer = found;
    }
    if (steps > 1 && kinks == steps) return {Slope::ridge};
    if (kinks > 0 && longer.kink > kinked) return {};
    return best;
  }

  /// Compares along some twists of each body.
  void judge(const PairDerivative& derivative) {
    const int twists = judged_.is_flagged ? 8 : 2;
    judged_.slope = Slope::smooth;
    for (int i = 0; i < twists; ++i) {
      const UnitTwist twist = random_twist(i % 2 == 0);
      const TwistDerivative& by = twist.of_a ? derivative.a : derivative.b;
      const Long message = by.by_velocity.dot(twist.velocity) + by.by_turn.dot(twist.turn);
      const Long length = std::hypot(by.by_velocity.norm(), by.by_turn.norm() / size_);
      const Differences first = differences(twist, 1e-7L * size_);
      const TwistError& bounds = twist.of_a ? bounds_.a : bounds_.b;
      const Long bound =
          bounds.by_velocity * twist.velocity.norm() + bounds.by_turn * twist.turn.norm();
      judged_.bound = std::max(judged_.bound, static_cast<double>(bound / length));
      Long error = std::abs(first.central - message) + first.unsure;
      if (judged_.is_flagged || !(error <= agreed * length) || !(error <= bound)) {
        const Truth found = truth(twist);
        if (found.slope != Slope::smooth) {
          judged_.slope = found.slope;
          return;
        }
        error = std::abs(found.derivative - message);
        judged_.is_within = judged_.is_within && error - 3 * found.unsure <= bound;
      }
      judged_.error = std::max(judged_.error, static_cast<double>(error / length));
    }
  }

  WithoutRadius core_a_, core_b_;
  LongBody a_, b_;
  double size_;
  RandomShapes& random_;
  JudgedDerivative judged_;
  PairDerivativeError bounds_;
  std::vector<Real3> normals_;
  bool is_apart_ = false;
  Value middle_;
};

/// The k-th of a family of pairs, as random_pair() makes them, of derived_shape()s.
inline RandomPair derived_pair(int i, int j, int k, RandomShapes& random) {
  const double scale = k % 6 == 5 ? std::pow(10, random.in(-3, 3)) : 1;
  const Vec3<double> origin =
      k % 5 == 4 ? 1e4 * scale * random.direction() : Vec3<double>(Vec3<double>::Zero());
  RandomPair pair{Body(derived_shape(i, scale, random), {random.turn(), origin}),
                  Body(derived_shape(j, scale, random), {random.turn(), origin})};
  Body& b = pair.b;
  const double size = size_of(pair.a, b) + scale;
  b.pose.translation += random.in(0, 1.3) * size * random.direction();
  if (k % 6 == 2) {
    const double left = std::pow(10, random.in(-6, -2));
    bring_near(pair.a, b, k % 4 < 2 ? left : -left, size);
  }
  return pair;
}

/// Upright bodies on a grid, where ridges are common.
inline RandomPair aligned_pair(int i, int j, RandomShapes& random) {
  return {Body(aligned_shape(i, random), {right_angle(random), grid_point(random)}),
          Body(aligned_shape(j, random), {right_angle(random), grid_point(random)})};
}

}  // namespace minkray::testing
