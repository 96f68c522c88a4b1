// SPDX-License-Identifier: MIT
// Frames in which the ray runs along the z axis from +z to -z, and two-dimensional geometry of
// edges and triangles projected along the ray.
#pragma once

#include "core/math/vec.h"

namespace minkray {

/// An orthonormal frame whose third row is -r (Duff et al., "Building an Orthonormal Basis,
/// Revisited", 2017).
template <class W>
struct RayFrame {
  Vec3<W> x, y, z;

  explicit RayFrame(const Vec3<W>& r) : z(-r) {
    using std::copysign;
    const W sign = copysign(W(1), z.z());
    const W a = W(-1) / (sign + z.z());
    const W b = z.x() * z.y() * a;
    x = {W(1) + sign * z.x() * z.x() * a, sign * b, -sign * z.x()};
    y = {b, sign + z.y() * z.y() * a, -z.y()};
  }
  /// Converts a vector to this frame.
  Vec3<W> into(const Vec3<W>& v) const { return {x.dot(v), y.dot(v), z.dot(v)}; }
  /// Converts a vector from this frame.
  Vec3<W> out_of(const Vec3<W>& v) const { return x * v.x() + y * v.y() + z * v.z(); }
};

/// Cross product of the projections of two vectors along the ray. The vectors are in a RayFrame, as
/// are all points below; the ray runs through the origin.
template <class W>
W cross_2d(const Vec3<W>& a, const Vec3<W>& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Unit normal, on the side of +z, of the plane through three points; zero if the points are
/// collinear. Uses the shorter edges, since these have the least rounding.
template <class W>
Vec3<W> upper_normal(const Vec3<W>& a, const Vec3<W>& b, const Vec3<W>& c) {
  const Vec3<W> ab = b - a, ac = c - a, bc = c - b;
  const Vec3<W> shorter = select<W>(ab.squaredNorm() < bc.squaredNorm(), ab, bc);
  const Vec3<W> N = unit<W>(shorter.cross(ac));
  return select<W>(N.z() < W(0), Vec3<W>(-N), N);
}

/// True if the ray passes within `rounding` of the edge from a to b.
template <class W>
Mask<W> passes_edge(const Vec3<W>& a, const Vec3<W>& b, const W& rounding) {
  using std::max;
  using std::min;
  const W area = cross_2d(a, b), x = b.x() - a.x(), y = b.y() - a.y();
  const W near = rounding * rounding, length = x * x + y * y;
  const Mask<W> in_line = area * area <= near * length;
  if (!any(in_line)) return in_line;
  const W share = min(max(W(-(a.x() * x + a.y() * y) / length), W(0)), W(1));
  const W offset_x = a.x() + x * share, offset_y = a.y() + y * share;
  return in_line & (offset_x * offset_x + offset_y * offset_y <= near);
}

/// True if the ray passes between three points.
template <class W>
Mask<W> passes_between(const Vec3<W>& a, const Vec3<W>& b, const Vec3<W>& c) {
  const W of_a = cross_2d(b, c), of_b = cross_2d(c, a), of_c = cross_2d(a, b);
  return ((of_a >= W(0)) & (of_b >= W(0)) & (of_c >= W(0))) |
         ((of_a <= W(0)) & (of_b <= W(0)) & (of_c <= W(0)));
}

}  // namespace minkray
