// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>

#include "core/pair/closed_answer.h"
#include "core/pair/closed_pairs.h"

namespace minkray {
namespace {

/// Returns the signed distance of a box and a point p. c is the vector to p from the box's nearest
/// point or, if p is inside, from the nearest face.
CoreDistance point_and_box(const Vec3<double>& half, const Vec3<double>& p, double deeper) {
  const Vec3<double> nearest = p.cwiseMax(-half).cwiseMin(half);
  if (nearest != p) return closed_between(nearest, p - nearest, Vec3<double>::UnitX());
  int face = 0;
  const Vec3<double> inside = half - p.cwiseAbs();
  const double depth = inside.minCoeff(&face);
  const Vec3<double> axis = Vec3<double>::Unit(face) * (p[face] < 0 ? -1 : 1);
  Vec3<double> on_face = p;
  on_face[face] = half[face] * (p[face] < 0 ? -1 : 1);
  CoreDistance found = closed_answer(-depth, axis, on_face, p - on_face);
  const double others = std::min(inside[(face + 1) % 3], inside[(face + 2) % 3]);
  found.has_one_direction = depth + 2 * deeper < others && deeper < std::abs(p[face]);
  return found;
}

/// Returns the signed distance of a cylinder or disk and a point p, from p's distances beyond the
/// side and beyond the nearer end (negative inside).
CoreDistance point_and_cylinder(double radius, double half, const Vec3<double>& p, double deeper) {
  const double rho = length_of(p.x(), p.y()), side = p.z() < 0 ? -1 : 1;
  const double beyond_side = rho - radius, beyond_end = side * p.z() - half;
  const double outward_x = rho > 0 ? p.x() / rho : 1, outward_y = rho > 0 ? p.y() / rho : 0;
  if (beyond_side > 0 && beyond_end > 0) {
    const double length = length_of(beyond_side, beyond_end), across = beyond_side / length;
    return closed_answer(length,
                         {across * outward_x, across * outward_y, side * (beyond_end / length)},
                         {radius * outward_x, radius * outward_y, side * half},
                         {beyond_side * outward_x, beyond_side * outward_y, side * beyond_end});
  }
  const bool is_by_end = beyond_end >= beyond_side;
  const Vec3<double> axis =
      is_by_end ? Vec3<double>(0, 0, side) : Vec3<double>(outward_x, outward_y, 0);
  const double gap = is_by_end ? beyond_end : beyond_side;
  const Vec3<double> c = gap * axis;
  CoreDistance found = closed_answer(gap, axis, p - c, c);
  found.has_one_direction = gap < 0 && std::abs(beyond_end - beyond_side) > 2 * deeper &&
                            (is_by_end ? std::abs(p.z()) : rho) > deeper;
  return found;
}

/// Returns the direction of d, limited to the angle between the unit vectors m and n. If d is the
/// difference of two close points, rounding may turn d out of this angle.
std::array<double, 2> between_directions(const double* m, const double* n, double d0, double d1) {
  const double area = m[0] * n[1] - m[1] * n[0];
  const double along_m = (d0 * n[1] - d1 * n[0]) / area, along_n = (m[0] * d1 - m[1] * d0) / area;
  if (!(along_m > 0)) return {n[0], n[1]};
  if (!(along_n > 0)) return {m[0], m[1]};
  const double length = length_of(d0, d1);
  return {d0 / length, d1 / length};
}

/// Returns the signed distance of the hull of two disks around z and a point p. Works in the half
/// plane that contains p and is bounded by the axis, in which the hull has three edges: two ends
/// and the side between the rims.
CoreDistance point_and_disks(const Vec3<double>& size, const Vec3<double>& p, double deeper) {
  const double half = size.z(), below = size.x(), above = size.y();
  const double rho = length_of(p.x(), p.y()), z = p.z();
  const auto in_space = [&](double across, double along) -> Vec3<double> {
    if (!(rho > 0)) return {across, 0, along};
    return {across * (p.x() / rho), across * (p.y() / rho), along};
  };
  const double slant = length_of(2 * half, below - above);
  // Outward normals of the lower end, the side and the upper end.
  const double normal[3][2] = {
      {0, -1}, {slant > 0 ? 2 * half / slant : 1, slant > 0 ? (below - above) / slant : 0}, {0, 1}};
  const double on_face[3][2] = {{0, -half}, {below, -half}, {above, half}};
  double gap[3];
  int face = 0;
  for (int k = 0; k < 3; ++k) {
    gap[k] = normal[k][0] * (rho - on_face[k][0]) + normal[k][1] * (z - on_face[k][1]);
    if (gap[k] > gap[face]) face = k;
  }
  // Position of p along the side: 0 at the lower rim, `slant` at the upper rim.
  const double along =
      slant > 0 ? (2 * half * (z + half) - (below - above) * (rho - below)) / slant : 0;
  const bool is_by_face = gap[face] <= 0 || (face == 0 && rho <= below) ||
                          (face == 2 && rho <= above) ||
                          (face == 1 && slant > 0 && along >= 0 && along <= slant);
  if (is_by_face) {
    const Vec3<double> axis = in_space(normal[face][0], normal[face][1]);
    const Vec3<double> c = gap[face] * axis;
    CoreDistance found = closed_answer(gap[face], axis, p - c, c);
    const double others = std::max(gap[(face + 1) % 3], gap[(face + 2) % 3]);
    found.has_one_direction =
        gap[face] < 0 && others + 2 * deeper < gap[face] && (face != 1 || deeper < rho);
    return found;
  }
  // Chooses the nearer rim without comparing distances, which are rounded to equal numbers if p is
  // far away.
  const bool is_below = face == 0 || (face == 1 && along < 0);
  const int rim = is_below ? 0 : 2;
  const double at0 = is_below ? below : above, at1 = is_below ? -half : half;
  const double d0 = rho - at0, d1 = z - at1;
  const auto direction = between_directions(normal[rim], normal[1], d0, d1);
  const Vec3<double> axis = in_space(direction[0], direction[1]);
  return closed_answer(length_of(d0, d1), axis, in_space(at0, at1), in_space(d0, d1));
}

}  // namespace

CoreDistance between_solid_and_point(const ShapeCore& solid, const Vec3<double>& p, double deeper) {
  const Vec3<double>& size = solid.size;
  if (solid.kind == CoreKind::box) return point_and_box(size, p, deeper);
  // Two disks without a height between them are one disk, the larger of the two.
  if (size.x() == size.y() || !(size.z() > 0))
    return point_and_cylinder(std::max(size.x(), size.y()), size.z(), p, deeper);
  return point_and_disks(size, p, deeper);
}

}  // namespace minkray
