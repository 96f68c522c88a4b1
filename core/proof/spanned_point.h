// SPDX-License-Identifier: MIT
// The convex combination of up to four support points that is nearest to a point x: a simplex of
// the GJK algorithms, in long double. Also stores the directions in which the support points were
// found.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "core/gjk/simplex.h"
#include "core/proof/certificate.h"

namespace minkray {

class SpannedPoint {
 public:
  explicit SpannedPoint(const Vec3<long double>& x) { simplex_.begin(x); }

  /// Replaces x.
  void move(const Vec3<long double>& x) {
    simplex_.move(x);
    squared_ = std::numeric_limits<long double>::infinity();
  }
  /// Adds p, the support point along n. Returns false if this does not bring the spanned point
  /// nearer to x.
  bool add(const Vec3<long double>& p, const Vec3<double>& n) {
    if (simplex_.full() || simplex_.holds(p)) return false;
    directions_[static_cast<std::size_t>(simplex_.add(p))] = n;
    const auto closest = simplex_.closest();
    if (!(closest.v.squaredNorm() < squared_)) {
      simplex_.keep(closest_.kept);
      return false;
    }
    closest_ = closest;
    squared_ = closest.v.squaredNorm();
    simplex_.keep(closest.kept);
    return true;
  }
  bool full() const { return simplex_.full(); }
  /// Vector from the spanned point to x.
  const Vec3<long double>& v() const { return closest_.v; }

  /// Distance of x from the combination of the corners with the computed weights. Usually |v|. For
  /// a tetrahedron that contains x, v is zero, and the distance is the rounding error of the
  /// weights.
  double off() const {
    Vec3<long double> sum = Vec3<long double>::Zero();
    long double weights = 0;
    for (int i = 0; i < 4; ++i) {
      if (!(closest_.kept & (1u << i))) continue;
      const long double weight = closest_.weights[static_cast<std::size_t>(i)];
      sum += weight * simplex_.y(i);
      weights += weight;
    }
    return static_cast<double>((sum / weights).norm());
  }

  /// For a tetrahedron that contains x: computes the corners' weights by elimination, since for
  /// slivers the ratios of volumes have too few digits.
  void balance() {
    if (!full()) return;
    Mat3<long double> edges;
    for (int i = 0; i < 3; ++i) edges.col(i) = simplex_.y(i + 1) - simplex_.y(0);
    const Vec3<long double> weights = edges.fullPivLu().solve(-simplex_.y(0));
    const long double first = 1 - weights.sum();
    if (!weights.allFinite() || !(std::min(first, weights.minCoeff()) >= 0)) return;
    closest_.weights = {first, weights[0], weights[1], weights[2]};
  }

  void write_to(Certificate& certificate) const {
    certificate.spanning = {};
    for (std::size_t i = 0; i < directions_.size(); ++i)
      if (closest_.kept & (1u << i))
        certificate.spanning[i] = {directions_[i],
                                   static_cast<double>(std::max(closest_.weights[i], 0.0L))};
  }

 private:
  Simplex<long double, 3> simplex_;
  ClosestPoint<long double, 3> closest_;
  std::array<Vec3<double>, 4> directions_;
  long double squared_ = std::numeric_limits<long double>::infinity();
};

}  // namespace minkray
