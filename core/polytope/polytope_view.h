// SPDX-License-Identifier: MIT
// Points of a polytope projected along a line.
#pragma once

#include "core/query/line.h"

namespace minkray::exact {

/// A point projected along the line. The line itself is projected to the origin.
template <class W>
struct Seen {
  W x, y;
};

template <class W>
W cross(const Seen<W>& a, const Seen<W>& b) {
  return a.x * b.y - a.y * b.x;
}

/// Projection along a line. Triangles that face the line's origin are counter-clockwise.
template <class W>
class View {
 public:
  /// Axes by Duff and others, "Building an Orthonormal Basis, Revisited", 2017.
  explicit View(const Line<W>& line) {
    using std::copysign;
    using std::sqrt;
    const W back = W(-1) / sqrt(line.dd);
    const W nx = line.d.x() * back, ny = line.d.y() * back, nz = line.d.z() * back;
    const W sign = copysign(W(1), nz), a = W(-1) / (sign + nz), b = nx * ny * a;
    x_ = {W(1) + sign * nx * nx * a, sign * b, -sign * nx};
    y_ = {b, sign + ny * ny * a, -ny};
    at_ = {x_.dot(line.s), y_.dot(line.s)};
  }
  Seen<W> operator()(const W& x, const W& y, const W& z) const {
    return {(x_.x() * x + x_.y() * y) + x_.z() * z - at_.x,
            (y_.x() * x + y_.y() * y) + y_.z() * z - at_.y};
  }

 private:
  Vec3<W> x_, y_;
  Seen<W> at_;
};

}  // namespace minkray::exact
