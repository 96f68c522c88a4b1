// SPDX-License-Identifier: MIT
#include "core/mesh/mesh_ray.h"

#include <algorithm>
#include <cmath>

#include "core/mesh/exact_sign.h"
#include "core/mesh/mesh_walk.h"
#include "core/mesh/repeats.h"

namespace minkray {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// An edge of the triangle relative to the ray: d . ((from - o) x (to - from)), its error bound,
/// and its true sign.
struct PassedEdge {
  double value, error;
  int side;
};

/// The differences round once; the products, their difference and the sum of three round six times
/// more. This makes seven halves of epsilon of all summands; six are allowed.
PassedEdge pass(const Vec3<double>& d, const Vec3<double>& from, const Vec3<double>& edge) {
  const double x1 = from.y() * edge.z(), x2 = from.z() * edge.y();
  const double y1 = from.z() * edge.x(), y2 = from.x() * edge.z();
  const double z1 = from.x() * edge.y(), z2 = from.y() * edge.x();
  const double value = d.x() * (x1 - x2) + d.y() * (y1 - y2) + d.z() * (z1 - z2);
  const double size = std::abs(d.x()) * (std::abs(x1) + std::abs(x2)) +
                      std::abs(d.y()) * (std::abs(y1) + std::abs(y2)) +
                      std::abs(d.z()) * (std::abs(z1) + std::abs(z2));
  const double error = 6 * epsilon * size;
  return {value, error, value > error ? 1 : value < -error ? -1 : 0};
}

int widest_axis(const Vec3<double>& d) {
  int axis = 0;
  d.cwiseAbs().maxCoeff(&axis);
  return axis;
}

}  // namespace

PartHit cast_at_triangle(const Vec3<double>& a, const Vec3<double>& b, const Vec3<double>& c,
                         const Ray<double>& ray) {
  const Vec3<double>&o = ray.origin, &d = ray.direction;
  const Vec3<double> from_a = a - o, from_b = b - o, from_c = c - o;
  PassedEdge ab = pass(d, from_a, b - a), bc = pass(d, from_b, c - b), ca = pass(d, from_c, a - c);
  const auto is_outside = [&] {
    const int least = std::min({ab.side, bc.side, ca.side});
    return least < 0 && std::max({ab.side, bc.side, ca.side}) > 0;
  };
  if (is_outside()) return {};
  if (ab.side == 0) ab.side = exact_side_of_edge(o, d, a, b);
  if (bc.side == 0) bc.side = exact_side_of_edge(o, d, b, c);
  if (ca.side == 0) ca.side = exact_side_of_edge(o, d, c, a);
  const int sides = ab.side + bc.side + ca.side;
  if (is_outside() || sides == 0) return {};

  // t is linear on the triangle: the corners' positions along the axis that the ray follows most,
  // weighted by the opposite edges over their sum.
  const int axis = widest_axis(d);
  const double to_t = 1 / d[axis];
  const double ta = from_a[axis] * to_t, tb = from_b[axis] * to_t, tc = from_c[axis] * to_t;
  const double first = std::min({ta, tb, tc}), last = std::max({ta, tb, tc});
  const double most = std::max(std::abs(first), std::abs(last));
  const double to_b = tb - ta, to_c = tc - ta;
  const double whole = ab.value + bc.value + ca.value;
  const double beyond_a = (ca.value * to_b + ab.value * to_c) / whole;
  const double whole_error = ab.error + bc.error + ca.error;
  const double whole_at_least = std::abs(whole) - whole_error;
  PartHit hit;
  hit.is_back = sides > 0;
  hit.is_at_edge = ab.side == 0 || bc.side == 0 || ca.side == 0;
  // No point of the triangle has a t outside of [first, last]. Three roundings make each of these;
  // all further ones are 23 at most.
  const double range = last - first + 4 * epsilon * most;
  hit.error = range;
  if (whole_at_least > 0) {
    const double of_weights =
        ca.error * std::abs(to_b) + ab.error * std::abs(to_c) + whole_error * std::abs(beyond_a);
    hit.error = std::min(range, 1.001 * of_weights / whole_at_least + 14 * epsilon * most);
  }
  hit.t = std::isfinite(beyond_a) ? std::clamp(ta + beyond_a, first, last) : first;
  if (hit.t < -hit.error) return {};
  if (!(hit.t > hit.error)) {
    // Rounding must not decide if the plane is in front of the ray's origin, or at it.
    const int above = exact_side_of_plane(a, b, c, o);
    if ((above > 0) == (sides > 0) && above != 0) return {};
    hit.t = above == 0 ? 0 : std::max(hit.t, 0.0);
    if (above == 0) hit.error = 0;
  }
  hit.part = 0;
  return hit;
}

PartHit cast_at_part(const TriangleMesh& mesh, std::uint32_t triangle, const Ray<double>& ray) {
  PartHit hit = cast_at_triangle(mesh.corner(triangle, 0), mesh.corner(triangle, 1),
                                 mesh.corner(triangle, 2), ray);
  if (hit.found()) hit.part = triangle;
  return hit;
}

bool yields_to_or_is_wide(const TriangleMesh& mesh, const Ray<double>& ray, const PartHit& closest,
                          const PartHit& hit) {
  SlabRay slabs(ray);
  // Tests the box of a triangle as walks do.
  const auto is_reached = [&](std::uint32_t triangle) {
    Bounds<double> box;
    for (std::size_t k = 0; k < 3; ++k) box.extend(mesh.corner(triangle, k));
    Bvh alone;
    alone.nodes.resize(1);
    alone.nodes[0].set(0, rounded_outwards(box), BvhNode::leaf);
    for (int child = 1; child < bvh_width; ++child) alone.nodes[0].set(child, {}, BvhNode::none);
    bool is_met = false;
    traverse(alone, slabs, [&](std::uint32_t) { return is_met = true; });
    return is_met;
  };
  const float whole = slabs.numbers.t_max;
  if (is_wide(hit)) {
    if (closest.found())
      slabs.numbers.t_max = std::min(whole, slabs.limit(closest.t + closest.error));
    if (!is_reached(hit.part)) return false;
  }
  if (is_wide(closest)) {
    slabs.numbers.t_max = std::min(whole, slabs.limit(hit.t + hit.error));
    if (!is_reached(closest.part)) return true;
  }
  return closest.yields_to(hit);
}

PartHit closest_part(const TriangleMesh& mesh, const Ray<double>& ray, double t_min,
                     PartCounts& counts) {
  if (has_lanes(mesh) && suits_lanes(ray))
    return closest_part_avx2(view_of(mesh), ray, t_min, counts);
  PartHit closest;
  walk_triangles(mesh, ray, counts, [&](std::uint32_t triangle, SlabRay& slabs) {
    const PartHit hit = cast_at_part(mesh, triangle, ray);
    if (!hit.found() || !(hit.t >= t_min) || !(hit.t <= ray.t_max)) return false;
    if (!takes_place(mesh, ray, closest, hit)) return false;
    closest = hit;
    slabs.numbers.t_max = std::min(slabs.numbers.t_max, slabs.limit(hit.t + hit.error));
    return false;
  });
  return closest;
}

bool meets_part(const TriangleMesh& mesh, const Ray<double>& ray, double t_min,
                PartCounts& counts) {
  if (has_lanes(mesh) && suits_lanes(ray))
    return meets_part_avx2(view_of(mesh), ray, t_min, counts);
  bool is_met = false;
  walk_triangles(mesh, ray, counts, [&](std::uint32_t triangle, SlabRay&) {
    const PartHit hit = cast_at_part(mesh, triangle, ray);
    is_met = hit.found() && hit.t >= t_min && hit.t <= ray.t_max;
    return is_met;
  });
  return is_met;
}

std::vector<PartHit> all_parts(const TriangleMesh& mesh, const Ray<double>& ray) {
  std::vector<PartHit> hits;
  PartCounts counts;
  visit_hits(mesh, ray, counts, [&](const PartHit& hit) {
    if (hit.t <= ray.t_max) hits.push_back(hit);
  });
  std::ranges::sort(hits, [](const PartHit& a, const PartHit& b) { return b.yields_to(a); });
  return hits;
}

bool is_within(const TriangleMesh& mesh, const Vec3<double>& point) {
  if (!mesh.is_closed() || !point.allFinite()) return false;
  // Limit of tries for a direction whose ray passes through no edge; nearly all directions qualify.
  constexpr int most_tries = 64;
  for (int i = 1; i <= most_tries; ++i) {
    const Vec3<double> direction(std::sin(1.3 * i), std::cos(0.7 * i), std::sin(2.9 * i + 0.4));
    std::vector<PartHit> hits = all_parts(mesh, {point, direction});
    erase_repeats(mesh, hits);
    if (std::ranges::any_of(hits, &PartHit::is_at_edge)) continue;
    const double at_surface = 1e-12 * (mesh.reach() + point.norm());
    if (!hits.empty() && hits[0].t <= at_surface) return false;
    int turns = 0;
    for (const PartHit& hit : hits) turns += hit.is_back ? 1 : -1;
    return turns != 0;
  }
  return false;
}

}  // namespace minkray
