// SPDX-License-Identifier: MIT
// The line's way over a polytope's triangles (Devillers, Pion and Teillaud, "Walking in a
// Triangulation", 2002), and between its planes.
#include <algorithm>
#include <cmath>

#include "core/exact/polytope.h"
#include "core/query/tolerances.h"

namespace minkray::exact {
namespace {

/// Up to so many planes are looked at without a walk.
constexpr std::size_t most_scanned = 8;

/// From a start that is near, walks are short. Those of more steps have lost their way by rounding.
constexpr int most_steps = 64;

/// A walk begins at a ball that stands for the polytope: a line that passes the ball by is taken to
/// come into it by so much, squared.
constexpr double least_depth = 1.0 / 64;

struct Point2 {
  double x, y;
};

double cross(const Point2& a, const Point2& b) {
  return a.x * b.y - a.y * b.x;
}

double size(const Point2& a) {
  return std::abs(a.x) + std::abs(a.y);
}

}  // namespace

/// Space seen along the line, which is the origin: sheared along it onto a plane of two axes.
/// Outward triangles that face the line are counter-clockwise.
struct Polytope::Projection {
  int x, y, z;
  double shear_x, shear_y;
  Point2 line;

  explicit Projection(const Line<double>& seen) {
    const Vec3<double>& d = seen.d;
    const double ax = std::abs(d.x()), ay = std::abs(d.y()), az = std::abs(d.z());
    z = ax > ay ? (ax > az ? 0 : 2) : (ay > az ? 1 : 2);
    x = (z + 1) % 3;
    y = (z + 2) % 3;
    if (d[z] > 0) std::swap(x, y);
    const double inv = 1 / d[z];
    shear_x = d[x] * inv;
    shear_y = d[y] * inv;
    line = {seen.s[x] - shear_x * seen.s[z], seen.s[y] - shear_y * seen.s[z]};
  }
  Point2 operator()(const Vec3<double>& p) const {
    return {p[x] - shear_x * p[z] - line.x, p[y] - shear_y * p[z] - line.y};
  }
};

Entry<double> Polytope::enter(const Line<double>& line) const {
  Entry<double> entry;
  if (planes_.size() <= most_scanned || !walk(line, entry)) scan(line, entry);
  return entry;
}

bool Polytope::settle_hit(std::size_t plane, const Line<double>& line, Entry<double>& entry) const {
  const Vec3<double> normal = planes_.normal(plane);
  const double slope = normal.dot(line.d);
  if (!(slope < -least_component)) return false;
  const double inv = -1 / slope;
  entry.hit = true;
  entry.t = -(planes_.offset(plane) - normal.dot(line.s)) * inv;
  entry.e = (line.E + planes_.depth(plane)) * inv;
  entry.normal = normal;
  return true;
}

bool Polytope::settle_miss(std::size_t entered, std::size_t left, const Line<double>& line,
                           Entry<double>& entry) const {
  const Vec3<double> in = planes_.normal(entered), out = planes_.normal(left);
  const double slope_in = in.dot(line.d), slope_out = out.dot(line.d);
  if (!(slope_in < 0) || !(slope_out >= 0)) return false;
  const double inv_in = 1 / std::max(-slope_in, least_component);
  const double inv_out = 1 / std::max(slope_out, least_component);
  const double first = -(planes_.offset(entered) - in.dot(line.s)) * inv_in - line.E * inv_in;
  const double last = (planes_.offset(left) - out.dot(line.s)) * inv_out + line.E * inv_out;
  if (!(first > last)) return false;
  entry.miss = true;
  entry.normal = between(in, out, line.d);
  return true;
}

/// One whose normal is near that of the ellipsoid of the same extents where the line enters it.
std::uint32_t Polytope::first_triangle(const Line<double>& line) const {
  const Vec3<double> d = line.d.cwiseProduct(by_extents_), s = line.s.cwiseProduct(by_extents_);
  const double inv = 1 / d.squaredNorm();
  const Vec3<double> x = s - d * (s.dot(d) * inv);
  const double half = std::sqrt(std::max(1 - x.squaredNorm(), least_depth) * inv);
  const Vec3<double> normal = (x - d * half).cwiseProduct(by_extents_);
  return facing_[static_cast<std::size_t>(directions_.cell_of(normal))];
}

/// Seen along the line, the triangles that face it are a triangulation: each is left by the edge
/// that the line is furthest beyond. Where that leads to one that faces away, the line passes by.
Polytope::WalkEnd Polytope::follow(const Line<double>& line) const {
  const Projection seen(line);
  std::uint32_t at = first_triangle(line);
  std::array<Point2, 3> p;
  // Twice the areas of the triangles of each edge and the line.
  std::array<double, 3> side;
  const auto look = [&] {
    for (std::size_t k = 0; k < 3; ++k) p[k] = seen(vertices_[triangles_[at].corner[k]]);
    for (std::size_t k = 0; k < 3; ++k) side[k] = cross(p[k], p[(k + 1) % 3]);
    return side[0] + side[1] + side[2] > 0;
  };
  if (!look()) {
    at = facing_[static_cast<std::size_t>(directions_.cell_of(Vec3<double>(-line.d)))];
    if (!look()) return {};
  }
  // The number in the triangle of what is the first corner here.
  std::uint32_t first = 0;
  for (int step = 0; step < most_steps; ++step) {
    const std::uint32_t k = side[1] < side[0]   ? (side[2] < side[1] ? 2 : 1)
                            : side[2] < side[0] ? 2
                                                : 0;
    if (!(side[k] < 0)) {
      const double beside = tolerance::polytope_beside * line.E;
      const double a = size(p[0]), b = size(p[1]), c = size(p[2]);
      const bool is_clear =
          side[0] > beside * (a + b) && side[1] > beside * (b + c) && side[2] > beside * (c + a);
      return {WalkEnd::in_triangle, at, 0, is_clear};
    }
    const std::uint32_t edge = (first + k) % 3, beyond = triangles_[at].beyond[edge];
    const Triangle& next = triangles_[beyond / 4];
    first = beyond % 4;
    const Point2 from = p[k], to = p[(k + 1) % 3],
                 last = seen(vertices_[next.corner[(first + 2) % 3]]);
    p = {to, from, last};
    side = {-side[k], cross(from, last), cross(last, to)};
    if (!(side[0] + side[1] + side[2] > 0)) return {WalkEnd::past_edge, at, edge, false};
    at = beyond / 4;
  }
  return {};
}

bool Polytope::walk(const Line<double>& line, Entry<double>& entry) const {
  const WalkEnd end = follow(line);
  const Triangle& triangle = triangles_[end.triangle];
  if (end.where == WalkEnd::in_triangle)
    return end.is_clear && settle_hit(triangle.plane, line, entry);
  const Triangle& beyond = triangles_[triangle.beyond[end.edge] / 4];
  return end.where == WalkEnd::past_edge && settle_miss(triangle.plane, beyond.plane, line, entry);
}

void Polytope::scan(const Line<double>& line, Entry<double>& entry) const {
  PlaneScan found;
  (has_avx2_ ? scan_planes_avx2 : scan_planes_sse2)(planes_, line, found);
  if (found.in_hi <= found.out_lo) {
    if (settle_hit(found.entered, line, entry)) entry.e = std::max(entry.e, found.in_hi - entry.t);
  } else {
    settle_miss(found.entered, found.left, line, entry);
  }
}

}  // namespace minkray::exact
