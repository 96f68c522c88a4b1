// SPDX-License-Identifier: MIT
// The point of a hull of points nearest to the origin in long double, by P. Wolfe, "Finding the
// Nearest Point in a Polytope", Mathematical Programming 11, 1976: a method that shares nothing
// with GJK but the answer.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <vector>

namespace minkray::oracle {

using Real = long double;
template <int Dim>
using Column = Eigen::Matrix<Real, Dim, 1>;

template <int Dim>
Column<Dim> nearest_to_origin(const std::vector<Column<Dim>>& points, int most_turns = 10000) {
  using Dynamic = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
  constexpr Real epsilon = 1e-17L;  // a few units in the last place of long double
  Real scale = 0;
  std::vector<std::size_t> S = {0};
  for (std::size_t i = 0; i < points.size(); ++i) {
    scale = std::max(scale, points[i].squaredNorm());
    if (points[i].squaredNorm() < points[S[0]].squaredNorm()) S[0] = i;
  }
  Dynamic weights = Dynamic::Ones(1);
  const auto combination = [&] {
    Column<Dim> x = Column<Dim>::Zero();
    for (std::size_t i = 0; i < S.size(); ++i)
      x += weights(static_cast<Eigen::Index>(i)) * points[S[i]];
    return x;
  };
  for (int major = 0; major < most_turns; ++major) {
    const Column<Dim> x = combination();
    std::size_t best = 0;
    for (std::size_t i = 1; i < points.size(); ++i)
      if (x.dot(points[i]) < x.dot(points[best])) best = i;
    if (x.squaredNorm() - x.dot(points[best]) <= 8 * epsilon * scale) return x;
    if (std::find(S.begin(), S.end(), best) != S.end()) return x;
    S.push_back(best);
    weights.conservativeResize(static_cast<Eigen::Index>(S.size()));
    weights(weights.size() - 1) = 0;
    for (;;) {
      // The nearest point of the affine hull of S.
      const auto n = static_cast<Eigen::Index>(S.size());
      Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic> system(n + 1, n + 1);
      system.setOnes();
      system(0, 0) = 0;
      for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j)
          system(i + 1, j + 1) =
              points[S[static_cast<std::size_t>(i)]].dot(points[S[static_cast<std::size_t>(j)]]);
      Dynamic right = Dynamic::Zero(n + 1);
      right(0) = 1;
      const Dynamic alpha = system.fullPivLu().solve(right).tail(n);
      if (alpha.minCoeff() > epsilon) {
        weights = alpha;
        break;
      }
      Real theta = 1;
      for (Eigen::Index i = 0; i < n; ++i)
        if (alpha(i) <= epsilon && weights(i) > alpha(i))
          theta = std::min(theta, weights(i) / (weights(i) - alpha(i)));
      weights = theta * alpha + (1 - theta) * weights;
      // At least the smallest leaves.
      Eigen::Index smallest = 0;
      weights.minCoeff(&smallest);
      std::vector<std::size_t> kept;
      std::vector<Real> kept_weights;
      for (Eigen::Index i = 0; i < n; ++i) {
        if (i == smallest || weights(i) <= epsilon) continue;
        kept.push_back(S[static_cast<std::size_t>(i)]);
        kept_weights.push_back(weights(i));
      }
      S = kept;
      weights = Eigen::Map<Dynamic>(kept_weights.data(), static_cast<Eigen::Index>(S.size()));
      weights /= weights.sum();
      if (S.size() == 1) break;
    }
  }
  return combination();
}

}  // namespace minkray::oracle
