// SPDX-License-Identifier: MIT
#include "core/parts/triangle_pair.h"

#include "core/math/instruction_set.h"
#include "core/parts/nearest_features.h"

namespace minkray {
namespace {

void nearest_features(const TriangleCorners& a, const TriangleCorners& b, NearestPoints& best) {
  (has_avx2() ? nearest_features_avx2 : nearest_features_sse2)(a, b, best);
}

/// Squares of lengths above this are normal numbers, so the normal has unit length to its last
/// digits.
constexpr double ordinary = 0x1p-500;

/// Six times the volume of a tetrahedron.
double volume(const Vec3<double>& a, const Vec3<double>& b, const Vec3<double>& c,
              const Vec3<double>& d) {
  return (b - a).cross(c - a).dot(d - a);
}

/// Signs of volumes that hold even if corners move by `loss`; 0 if the sign might change.
class SureSide {
 public:
  SureSide(const TriangleCorners& a, const TriangleCorners& b, double loss) {
    double length = 0;  // largest coordinate difference, from a to b or within b
    for (const Vec3<double>& p : a)
      for (const Vec3<double>& q : {a[0], b[0], b[1], b[2]})
        length = std::max(length, (q - p).cwiseAbs().maxCoeff());
    for (const Vec3<double>& p : b) length = std::max(length, (p - b[0]).cwiseAbs().maxCoeff());
    // A volume has three factors: vectors of at most 2 sqrt(3) such lengths, each off by two
    // losses. The loss also makes up for the roundings of the products.
    const double far = 4 * length;
    least_ = 3 * 2 * loss * (far + 2 * loss) * (far + 2 * loss);
  }
  int of(const Vec3<double>& a, const Vec3<double>& b, const Vec3<double>& c,
         const Vec3<double>& d) const {
    const double v = volume(a, b, c, d);
    return v > least_ ? 1 : v < -least_ ? -1 : 0;
  }

 private:
  double least_;
};

/// True if an edge of `a` passes through `b`.
bool edge_passes(const TriangleCorners& a, const TriangleCorners& b, const SureSide& side,
                 Vec3<double>& common) {
  int sides[3];
  for (std::size_t i = 0; i < 3; ++i) sides[i] = side.of(b[0], b[1], b[2], a[i]);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (sides[i] * sides[j] >= 0) continue;
    const Vec3<double>&p = a[i], &q = a[j];
    const int of_first = side.of(p, q, b[0], b[1]);
    if (of_first == 0 || side.of(p, q, b[1], b[2]) != of_first ||
        side.of(p, q, b[2], b[0]) != of_first)
      continue;
    const double before = volume(b[0], b[1], b[2], p), behind = volume(b[0], b[1], b[2], q);
    common = p + before / (before - behind) * (q - p);
    return true;
  }
  return false;
}

}  // namespace

double gap_along(const TriangleCorners& a, const TriangleCorners& b, const Vec3<double>& n) {
  // Relative to a corner, so that numbers have the triangles' magnitude.
  const Vec3<double>& from = a[0];
  const auto height = [&](const Vec3<double>& p) { return n.dot(p - from); };
  return std::min({height(b[0]), height(b[1]), height(b[2])}) -
         std::max({0.0, height(a[1]), height(a[2])});
}

TriangleGap triangle_gap(const TriangleCorners& a, const TriangleCorners& b) {
  NearestPoints nearest;
  nearest_features(a, b, nearest);
  TriangleGap gap;
  gap.point_a = nearest.a;
  gap.point_b = nearest.b;
  const Vec3<double> apart = nearest.b - nearest.a;
  const double length = apart.norm();
  if (!(length > ordinary)) return gap;
  gap.upper = length;
  gap.normal = apart / length;
  gap.lower = gap_along(a, b, gap.normal);
  return gap;
}

bool surely_cross(const TriangleCorners& a, const TriangleCorners& b, double loss,
                  Vec3<double>& common) {
  const SureSide side(a, b, loss);
  return edge_passes(a, b, side, common) || edge_passes(b, a, side, common);
}

}  // namespace minkray
