// SPDX-License-Identifier: MIT
// Body of the nearest features. MINKRAY_NEAREST_FEATURES is the function's name; all other names
// here contain the instruction set (core/math/wide.h).
#include "core/math/wide.h"
#include "core/parts/nearest_features.h"

namespace minkray {
namespace {

/// Corners 0, 1, 2, 0 of a triangle, which fill registers of two or four lanes.
constexpr int in_lanes = 4;

template <class W>
struct CornerLanes {
  static constexpr int registers = in_lanes / LaneOf<W>::count;
  Vec3<W> at[registers];

  /// Loads corners, beginning with corner `first`.
  CornerLanes(const TriangleCorners& triangle, std::size_t first) {
    for (int r = 0; r < registers; ++r)
      at[r] = per_lane<W>([&](int i) -> const Vec3<double>& {
        return triangle[(first + static_cast<std::size_t>(r * LaneOf<W>::count + i)) % 3];
      });
  }
};

template <class W>
W dot_of(const Vec3<W>& a, const Vec3<W>& b) {
  return a[0] * b[0] + (a[1] * b[1] + a[2] * b[2]);
}

template <class W>
W within_0_and_1(const W& x) {
  return min(max(x, W(0)), W(1));
}

/// Least divisor: squared lengths are raised to this so that none is 0.
constexpr double least_square = std::numeric_limits<double>::min();

/// Updates `best` with each edge of `a` against all edges of `b`. Ties keep the first.
template <class W>
void take_edges(const TriangleCorners& a, const TriangleCorners& b, NearestPoints& best) {
  const CornerLanes<W> from(b, 0), to(b, 1);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3<double>&p = a[i], edge = a[(i + 1) % 3] - p;
    const Vec3<W> u = widen<W>(edge);
    const W along(std::max(edge.squaredNorm(), least_square));
    for (int r = 0; r < CornerLanes<W>::registers; ++r) {
      const Vec3<W> v = to.at[r] - from.at[r], between = widen<W>(p) - from.at[r];
      const W e = max(dot_of<W>(v, v), W(least_square)), f = dot_of<W>(v, between),
              c = dot_of<W>(u, between), b_ = dot_of<W>(u, v);
      // If edges are parallel, any s will do.
      constexpr double parallel = 1e-30;
      const W denominator = max(along * e - b_ * b_, max(along * e * W(parallel), W(least_square)));
      W s = within_0_and_1<W>((b_ * f - c * e) / denominator);
      const W t = within_0_and_1<W>((b_ * s + f) / e);
      s = within_0_and_1<W>((b_ * t - c) / along);
      Vec3<W> apart;
      for (int k = 0; k < 3; ++k) apart[k] = between[k] + s * u[k] - t * v[k];
      const W squared = dot_of<W>(apart, apart);
      for (int lane = 0; lane < LaneOf<W>::count; ++lane) {
        const std::size_t j = static_cast<std::size_t>(r * LaneOf<W>::count + lane);
        if (j >= 3 || !(squared.lane(lane) < best.squared)) continue;
        best.squared = squared.lane(lane);
        best.a = p + s.lane(lane) * edge;
        best.b = b[j] + t.lane(lane) * Vec3<double>(b[(j + 1) % 3] - b[j]);
      }
    }
  }
}

/// Updates `best` with the corners of `points` over the face of another triangle.
template <class W>
void take_corners(const TriangleCorners& points, const TriangleCorners& face, bool are_of_b,
                  NearestPoints& best) {
  const Vec3<double> n = (face[1] - face[0]).cross(face[2] - face[0]);
  const double squared = n.squaredNorm();
  if (!(squared > least_square)) return;
  const CornerLanes<W> corners(points, 0);
  for (int r = 0; r < CornerLanes<W>::registers; ++r) {
    W height(0), inside(1);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3<double> inwards = n.cross(face[(k + 1) % 3] - face[k]);
      const Vec3<W> from = corners.at[r] - widen<W>(face[k]);
      inside = min(inside, dot_of<W>(widen<W>(inwards), from));
      if (k == 0) height = dot_of<W>(widen<W>(n), from);
    }
    for (int lane = 0; lane < LaneOf<W>::count; ++lane) {
      const std::size_t j = static_cast<std::size_t>(r * LaneOf<W>::count + lane);
      if (j >= 3 || !(inside.lane(lane) >= 0)) continue;
      const double h = height.lane(lane), apart = h * h / squared;
      if (!(apart < best.squared)) continue;
      best.squared = apart;
      const Vec3<double> foot = points[j] - (h / squared) * n;
      best.a = are_of_b ? foot : points[j];
      best.b = are_of_b ? points[j] : foot;
    }
  }
}

}  // namespace

void MINKRAY_NEAREST_FEATURES(const TriangleCorners& a, const TriangleCorners& b,
                              NearestPoints& best) {
  constexpr std::size_t lanes = IsaHere::register_bytes / sizeof(double);
  using W = Wide<double, static_cast<int>(lanes), IsaHere>;
  best = {};
  take_edges<W>(a, b, best);
  take_corners<W>(b, a, true, best);
  take_corners<W>(a, b, false, best);
}

}  // namespace minkray
