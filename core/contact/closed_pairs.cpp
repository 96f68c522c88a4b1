// SPDX-License-Identifier: MIT
#include "core/contact/closed_pairs.h"

#include <algorithm>
#include <array>

namespace minkray {
namespace {

CoreDistance exact(double distance, const Vec3<double>& axis, const Vec3<double>& a,
                   const Vec3<double>& c) {
  CoreDistance result;
  result.status = distance > 0 ? CoreStatus::separated : CoreStatus::overlapping;
  result.lower = result.upper = distance;
  result.axis = axis;
  result.a = a;
  result.c = c;
  return result;
}

/// It is stableNorm(), which scales, without that where squares are ordinary numbers.
double length_of(const Vec3<double>& c) {
  constexpr double smallest = 1e-280, largest = 1e280;
  const double squared = c.squaredNorm();
  return squared > smallest && squared < largest ? std::sqrt(squared) : c.stableNorm();
}

/// c's direction; where there is none, `otherwise`.
CoreDistance exact_between(const Vec3<double>& a, const Vec3<double>& c,
                           const Vec3<double>& otherwise) {
  const Vec3<double> direction = unit<double>(c);
  return exact(length_of(c), direction.isZero(0) ? otherwise : direction, a, c);
}

/// The parameter, from -1 to 1, of the point of the segment from -half to +half nearest to p.
double nearest_on_segment(const Vec3<double>& half, const Vec3<double>& p) {
  const double squared = half.squaredNorm();
  return squared > 0 ? std::clamp(p.dot(half) / squared, -1.0, 1.0) : 0;
}

/// A point p against a box; c goes from the box to the point, or inside of it to the nearest face.
CoreDistance point_and_box(const Vec3<double>& half, const Vec3<double>& p) {
  const Vec3<double> nearest = p.cwiseMax(-half).cwiseMin(half);
  if (nearest != p) return exact_between(nearest, p - nearest, Vec3<double>::UnitX());
  int face = 0;
  const Vec3<double> inside = half - p.cwiseAbs();
  inside.minCoeff(&face);
  const Vec3<double> axis = Vec3<double>::Unit(face) * (p[face] < 0 ? -1 : 1);
  Vec3<double> on_face = p;
  on_face[face] = half[face] * (p[face] < 0 ? -1 : 1);
  return exact(-inside[face], axis, on_face, p - on_face);
}

/// What is left of d between two unit vectors m and n: of a d that is a difference of neighbours,
/// rounding may lead out of there.
std::array<double, 2> between_directions(const double* m, const double* n, double d0, double d1) {
  const double area = m[0] * n[1] - m[1] * n[0];
  const double along_m = (d0 * n[1] - d1 * n[0]) / area, along_n = (m[0] * d1 - m[1] * d0) / area;
  if (!(along_m > 0)) return {n[0], n[1]};
  if (!(along_n > 0)) return {m[0], m[1]};
  const double length = std::hypot(d0, d1);
  return {d0 / length, d1 / length};
}

/// A point p against the hull of two disks around z: in the half plane of p and the axis, against
/// their ends and the line between their rims.
CoreDistance point_and_disks(const Vec3<double>& size, const Vec3<double>& p) {
  const double half = size.z(), below = half > 0 ? size.x() : std::max(size.x(), size.y()),
               above = half > 0 ? size.y() : below;
  const double rho = std::hypot(p.x(), p.y()), z = p.z();
  const auto in_space = [&](double across, double along) -> Vec3<double> {
    if (!(rho > 0)) return {across, 0, along};
    return {across * (p.x() / rho), across * (p.y() / rho), along};
  };
  const double slant = std::hypot(2 * half, below - above);
  // Outward normals: of the end below, of the side, of the end above.
  const double normal[3][2] = {
      {0, -1}, {slant > 0 ? 2 * half / slant : 1, slant > 0 ? (below - above) / slant : 0}, {0, 1}};
  const double on_face[3][2] = {{0, -half}, {below, -half}, {above, half}};
  double gap[3];
  int face = 0;
  for (int k = 0; k < 3; ++k) {
    gap[k] = normal[k][0] * (rho - on_face[k][0]) + normal[k][1] * (z - on_face[k][1]);
    if (gap[k] > gap[face]) face = k;
  }
  // Where along the side p stands, from the rim below: before 0 and after `slant` it is beyond one.
  const double along =
      slant > 0 ? (2 * half * (z + half) - (below - above) * (rho - below)) / slant : 0;
  const bool is_by_face = gap[face] <= 0 || (face == 0 && rho <= below) ||
                          (face == 2 && rho <= above) ||
                          (face == 1 && slant > 0 && along >= 0 && along <= slant);
  if (is_by_face) {
    const Vec3<double> axis = in_space(normal[face][0], normal[face][1]);
    const Vec3<double> c = gap[face] * axis;
    return exact(gap[face], axis, p - c, c);
  }
  const double to_below = std::hypot(rho - below, z + half),
               to_above = std::hypot(rho - above, z - half);
  const bool is_below = to_below < to_above || (to_below == to_above && z < 0);
  const int rim = is_below ? 0 : 2;
  const double at0 = is_below ? below : above, at1 = is_below ? -half : half;
  const double d0 = rho - at0, d1 = z - at1;
  const auto direction = between_directions(normal[rim], normal[1], d0, d1);
  const Vec3<double> axis = in_space(direction[0], direction[1]);
  return exact(std::hypot(d0, d1), axis, in_space(at0, at1), in_space(d0, d1));
}

}  // namespace

CoreDistance between_segments(const Vec3<double>& p, const Vec3<double>& q, const Vec3<double>& x) {
  if (p.isZero(0) && q.isZero(0))
    return exact_between(Vec3<double>::Zero(), x, Vec3<double>::UnitX());
  // The nearest points are within both, or one of them is an end.
  const Vec3<double> n = p.cross(q);
  const double squared = n.squaredNorm();
  Vec3<double> across = Vec3<double>::UnitX();
  if (squared > 0)
    across = n / std::sqrt(squared);
  else if (p.squaredNorm() > 0)
    across = p.unitOrthogonal();
  else if (q.squaredNorm() > 0)
    across = q.unitOrthogonal();
  if (squared > 0) {
    const double s = x.cross(q).dot(n) / squared, t = x.cross(p).dot(n) / squared;
    if (std::abs(s) <= 1 && std::abs(t) <= 1) {
      const double gap = x.dot(across);
      const Vec3<double> axis = gap < 0 ? Vec3<double>(-across) : across;
      return exact(std::abs(gap), axis, s * p, std::abs(gap) * axis);
    }
  }
  Vec3<double> a = Vec3<double>::Zero(), c = Vec3<double>::Zero();
  double best = std::numeric_limits<double>::infinity(), on_a = 0, on_b = 0;
  const auto try_points = [&](double s, double t) {
    const Vec3<double> between = x + t * q - s * p;
    const double length = between.squaredNorm();
    if (!(length < best)) return;
    best = length;
    a = s * p;
    c = between;
    on_a = s;
    on_b = t;
  };
  for (const double end : {-1.0, 1.0}) {
    try_points(nearest_on_segment(p, x + end * q), end);
    try_points(end, nearest_on_segment(q, end * p - x));
  }
  // No point of A is further along the axis, and none of B less far. Where c is as good as zero,
  // its direction is one of rounding: that is taken out, twice, since the first time leaves some.
  Vec3<double> axis = unit<double>(c);
  for (int i = 0; i < 2; ++i) {
    const double along_a = axis.dot(p), along_b = axis.dot(q);
    if (p.squaredNorm() > 0 && (std::abs(on_a) < 1 || on_a * along_a < 0))
      axis -= (along_a / p.squaredNorm()) * p;
    if (q.squaredNorm() > 0 && (std::abs(on_b) < 1 || on_b * along_b > 0))
      axis -= (axis.dot(q) / q.squaredNorm()) * q;
    axis = axis.squaredNorm() > 0.25 ? Vec3<double>(axis.normalized()) : across;
  }
  // Where they touch, a direction at right angles to both may be the better plane.
  constexpr double touching = 1e-20;
  if (c.squaredNorm() <= touching * (p.squaredNorm() + q.squaredNorm())) {
    const auto gap = [&](const Vec3<double>& m) {
      return m.dot(x) - std::abs(m.dot(p)) - std::abs(m.dot(q));
    };
    const Vec3<double> turned = across.dot(x) < 0 ? Vec3<double>(-across) : across;
    if (gap(turned) > gap(axis)) axis = turned;
  }
  return exact(length_of(c), axis, a, c);
}

bool closed_distance(const CorePair& pair, CoreDistance& found) {
  const ShapeCore &a = pair.a, &b = pair.b;
  // As the box or the disks see it: from there to the point.
  const auto of_solid = [](const ShapeCore& solid, const Vec3<double>& p) {
    return solid.kind == CoreKind::box ? point_and_box(solid.size, p)
                                       : point_and_disks(solid.size, p);
  };
  const auto is_solid = [](const ShapeCore& core) {
    return core.kind == CoreKind::box || core.kind == CoreKind::disks;
  };
  if (is_solid(a) && b.kind == CoreKind::point) {
    found = of_solid(a, pair.x);
    return true;
  }
  if (a.kind == CoreKind::point && is_solid(b)) {
    found = of_solid(b, pair.to_b(-pair.x));
    found.axis = pair.turn * -found.axis;
    found.c = pair.turn * -found.c;
    found.a.setZero();
    return true;
  }
  return false;
}

BoxOverlap box_overlap(const CorePair& pair, CoreDistance& found) {
  const Vec3<double>&a = pair.a.size, &b = pair.b.size, &x = pair.x;
  const Mat3<double>& R = pair.turn;
  const Mat3<double> Q = R.cwiseAbs();
  double best = -std::numeric_limits<double>::infinity();
  int best_i = -1, best_j = -1;  // a face of A, one of B, or an edge of each
  const auto try_axis = [&](double gap, int i, int j) {
    if (!(gap > best)) return;
    best = gap;
    best_i = i;
    best_j = j;
  };
  for (int i = 0; i < 3; ++i) try_axis(std::abs(x[i]) - a[i] - Q.row(i).dot(b), i, -1);
  for (int j = 0; j < 3; ++j) try_axis(std::abs(R.col(j).dot(x)) - b[j] - Q.col(j).dot(a), -1, j);
  if (best > 0) return BoxOverlap::none;
  // All products are with the axis itself, so that edges which are nearly parallel lose no digits.
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const double n1 = -R(i2, j), n2 = R(i1, j), squared = n1 * n1 + n2 * n2;
      if (!(squared > 0)) continue;
      const double along = std::abs(x[i1] * n1 + x[i2] * n2);
      const double reach = a[i1] * std::abs(n1) + a[i2] * std::abs(n2) +
                           b[j1] * std::abs(R(i1, j1) * n1 + R(i2, j1) * n2) +
                           b[j2] * std::abs(R(i1, j2) * n1 + R(i2, j2) * n2);
      // What is no better needs no root.
      const double gap = along - reach;
      if (gap <= 0 && best <= 0 && gap * gap >= best * best * squared) continue;
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
    // Once B has moved by -best n, two edges meet: of_a + s e and of_b - best n + t f.
    const Vec3<double> e = Vec3<double>::Unit(best_i), f = R.col(best_j);
    const Vec3<double> between = of_b - found.c - of_a;
    const double cosine = e.dot(f), squared = 1 - cosine * cosine;
    found.a = of_a + ((between.dot(e) - between.dot(f) * cosine) / squared) * e;
  }
  // Rounding aside these are points of both, unless an edge or a face lies in the plane.
  constexpr double outside = 1e-12;
  const double most = outside * pair.size();
  const Vec3<double> on_b = pair.to_b(found.a + found.c - x);
  const bool are_points =
      (found.a.cwiseAbs() - a).maxCoeff() <= most && (on_b.cwiseAbs() - b).maxCoeff() <= most;
  return are_points ? BoxOverlap::with_points : BoxOverlap::without_points;
}

}  // namespace minkray
