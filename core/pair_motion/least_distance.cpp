// SPDX-License-Identifier: MIT
#include "core/pair_motion/least_distance.h"

#include <algorithm>
#include <array>
#include <vector>

namespace minkray {
namespace {

struct Sample {
  double s = 0;
  SignedDistance distance;
};

struct Interval {
  Sample first, last;
  double lower = 0;
};

bool is_later(const Interval& a, const Interval& b) {
  return a.lower > b.lower;
}

class Search {
 public:
  Search(const MovingPair& pair, const LeastDistanceOptions& options)
      : pair_(pair), options_(options) {}

  LeastDistance run() {
    const Sample first = sample(0), last = sample(1);
    add(first, last);
    while (!intervals_.empty() && result_.distances < options_.max_distances) {
      const double least = intervals_.front().lower;
      if (is_near_enough(least)) break;
      std::pop_heap(intervals_.begin(), intervals_.end(), is_later);
      const Interval whole = intervals_.back();
      intervals_.pop_back();
      const double s = whole.first.s + (whole.last.s - whole.first.s) / 2;
      if (!(s > whole.first.s && s < whole.last.s)) {
        kept_ = std::min(kept_, whole.lower);  // s has no more digits
        continue;
      }
      const Sample middle = sample(s);
      add(whole.first, middle);
      add(middle, whole.last);
    }
    result_.lower = std::min(kept_, result_.upper);
    if (!intervals_.empty()) result_.lower = std::min(result_.lower, intervals_.front().lower);
    result_.is_settled = is_near_enough(result_.lower);
    return result_;
  }

 private:
  bool is_near_enough(double lower) const {
    const double best = std::min(result_.upper, options_.enough);
    return lower >= best - std::max(options_.gap, options_.relative_gap * std::abs(best));
  }

  Sample sample(double s) {
    ++result_.distances;
    const double at_most = std::min(result_.upper, options_.enough);
    const Sample found{s, pair_.at(s, at_most)};
    if (found.distance.upper < result_.upper) {
      result_.upper = found.distance.upper;
      result_.s = s;
      result_.there = found.distance;
    }
    return found;
  }

  void add(const Sample& first, const Sample& last) {
    const double length = last.s - first.s;
    Interval interval{first, last, 0};
    interval.lower = (first.distance.lower + last.distance.lower - pair_.speed * length) / 2;
    const double bend = pair_.acceleration * length * length / 8;
    const std::array<Vec3<double>, 3> normals = {
        first.distance.normal, last.distance.normal,
        unit<double>(first.distance.normal + last.distance.normal)};
    for (const Vec3<double>& n : normals) {
      if (n.isZero(0)) continue;
      const double at_first = pair_.gap(n, first.s);
      if (at_first - bend <= interval.lower) continue;
      interval.lower = std::max(interval.lower, std::min(at_first, pair_.gap(n, last.s)) - bend);
    }
    interval.lower = std::max(interval.lower, pair_.least);
    intervals_.push_back(interval);
    std::push_heap(intervals_.begin(), intervals_.end(), is_later);
  }

  const MovingPair& pair_;
  const LeastDistanceOptions& options_;
  LeastDistance result_;
  double kept_ = std::numeric_limits<double>::infinity();
  std::vector<Interval> intervals_;
};

}  // namespace

LeastDistance least_distance(const MovingPair& pair, const LeastDistanceOptions& options) {
  return Search(pair, options).run();
}

double gap_along(const ContactShape& a, const Affine<double>& pose_a, const ContactShape& b,
                 const Affine<double>& pose_b, const Vec3<double>& n) {
  return gap_along(a, pose_a.linear, b, pose_b.linear, between_middles(a, pose_a, b, pose_b), n);
}

double gap_along(const ContactShape& a, const Mat3<double>& linear_a, const ContactShape& b,
                 const Mat3<double>& linear_b, const Between& between, const Vec3<double>& n) {
  const Mat3<double> turn_a = turn_in_world(a, linear_a);
  const CorePair pair = pair_of(a, turn_a, b, turn_in_world(b, linear_b), between);
  const Vec3<double> d = turn_a.transpose() * n;
  return d.dot(nearest_along(pair, d).c) - pair.radii() - pair.rounding();
}

}  // namespace minkray
