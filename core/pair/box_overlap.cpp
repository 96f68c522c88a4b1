// SPDX-License-Identifier: MIT
#include <algorithm>

#include "core/pair/closed_pairs.h"

namespace minkray {

BoxOverlap box_overlap(const CorePair& pair, CoreDistance& found) {
  const Vec3<double>&a = pair.a.size, &b = pair.b.size, &x = pair.x;
  const Mat3<double>& R = pair.turn;
  const Mat3<double> Q = R.cwiseAbs();
  double best = -std::numeric_limits<double>::infinity(), second = best;
  // An axis whose gap is worse by this distance stays worse if B moves in by half the distance.
  const double way = 2 * deeper_by(pair);
  int best_i = -1, best_j = -1;  // best axis: a face normal of A (i), of B (j), or the cross
                                 // product of two edges (i, j)
  const auto try_axis = [&](double gap, int i, int j) {
    if (!(gap > best)) {
      second = std::max(second, gap);
      return;
    }
    second = best;
    best = gap;
    best_i = i;
    best_j = j;
  };
  for (int i = 0; i < 3; ++i) try_axis(std::abs(x[i]) - a[i] - Q.row(i).dot(b), i, -1);
  for (int j = 0; j < 3; ++j) try_axis(std::abs(R.col(j).dot(x)) - b[j] - Q.col(j).dot(a), -1, j);
  if (best > 0) return BoxOverlap::none;
  // Uses products with the unnormalised axis, so that nearly parallel edges lose no digits.
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const double n1 = -R(i2, j), n2 = R(i1, j), squared = n1 * n1 + n2 * n2;
      if (!(squared > 0)) continue;
      const double along = std::abs(x[i1] * n1 + x[i2] * n2);
      const double reach = a[i1] * std::abs(n1) + a[i2] * std::abs(n2) +
                           b[j1] * std::abs(R(i1, j1) * n1 + R(i2, j1) * n2) +
                           b[j2] * std::abs(R(i1, j2) * n1 + R(i2, j2) * n2);
      // Skips the square root for an axis that is not better.
      const double gap = along - reach;
      const double worst = way - best;
      if (gap <= 0 && best <= 0 && gap * gap >= worst * worst * squared) continue;
      try_axis(gap / std::sqrt(squared), i, j);
    }
  if (best > 0) return BoxOverlap::none;
  Vec3<double> n = best_j < 0   ? Vec3<double>(Vec3<double>::Unit(best_i))
                   : best_i < 0 ? Vec3<double>(R.col(best_j))
                                : Vec3<double>(Vec3<double>::Unit(best_i).cross(R.col(best_j)));
  if (best_i >= 0 && best_j >= 0) n.normalize();
  if (n.dot(x) < 0) n = -n;
  found.status = CoreStatus::overlapping;
  found.lower = found.upper = best;
  found.has_one_direction = second < best - way;
  found.axis = n;
  const auto corner = [](const Vec3<double>& half, const Vec3<double>& d) -> Vec3<double> {
    return {std::copysign(half.x(), d.x()), std::copysign(half.y(), d.y()),
            std::copysign(half.z(), d.z())};
  };
  const Vec3<double> of_a = corner(a, n), of_b = x + R * corner(b, pair.to_b(-n));
  found.c = best * n;
  if (best_j < 0) {
    found.a = of_b - found.c;
    found.a[best_i] = of_a[best_i];
  } else if (best_i < 0) {
    found.a = of_a;
  } else {
    // If B moves out by -best n, two edges meet: of_a + s e, and of_b - best n + t f.
    const Vec3<double> e = Vec3<double>::Unit(best_i), f = R.col(best_j);
    const Vec3<double> between = of_b - found.c - of_a;
    const double cosine = e.dot(f), squared = 1 - cosine * cosine;
    found.a = of_a + ((between.dot(e) - between.dot(f) * cosine) / squared) * e;
  }
  // Up to rounding, a and a + c are points of A and B, unless an edge or a face lies in the contact
  // plane.
  constexpr double outside = 1e-12;
  const double most = outside * pair.size();
  const Vec3<double> on_b = pair.to_b(found.a + found.c - x);
  const bool are_points =
      (found.a.cwiseAbs() - a).maxCoeff() <= most && (on_b.cwiseAbs() - b).maxCoeff() <= most;
  return are_points ? BoxOverlap::with_points : BoxOverlap::without_points;
}

}  // namespace minkray
