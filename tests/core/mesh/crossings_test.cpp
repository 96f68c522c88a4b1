// SPDX-License-Identifier: MIT
#include "core/mesh/crossings.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/mesh/exact_sign.h"
#include "core/mesh/perturbed_line.h"
#include "tests/oracle/quad.h"
#include "tests/support/meshes.h"
#include "tests/support/number_of_cases.h"
#include "tests/support/random.h"

namespace minkray {
namespace {

using testing::Surface;

/// A comb: teeth of whole numbers on a bar, so that edges and vertices are in line with many
/// others.
Surface comb(std::uint32_t teeth) {
  Surface comb;
  // The outline in x and z, counter-clockwise as seen from -y, and strips between it and the bar.
  std::vector<std::array<double, 2>> outline = {{0, 0}, {2.0 * teeth - 1, 0}};
  for (std::uint32_t k = teeth; k-- > 0;) {
    outline.push_back({2.0 * k + 1, 3});
    outline.push_back({2.0 * k, 3});
    if (k == 0) break;
    outline.push_back({2.0 * k, 1});
    outline.push_back({2.0 * k - 1, 1});
  }
  const auto n = static_cast<std::uint32_t>(outline.size());
  for (const double y : {0.0, 1.0})
    for (const auto& [x, z] : outline) comb.vertices.emplace_back(x, y, z);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    comb.triangles.push_back({next, i, i + n});
    comb.triangles.push_back({next, i + n, next + n});
  }
  // Both sides: ears of the outline, cut one by one.
  std::vector<std::uint32_t> left(n);
  for (std::uint32_t i = 0; i < n; ++i) left[i] = i;
  const auto turn = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto &p = outline[a], &q = outline[b], &r = outline[c];
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
  };
  while (left.size() >= 3) {
    std::size_t ear = 0;
    for (; ear < left.size(); ++ear) {
      const std::uint32_t a = left[ear], b = left[(ear + 1) % left.size()],
                          c = left[(ear + 2) % left.size()];
      if (!(turn(a, b, c) > 0)) continue;
      const auto is_in = [&](std::uint32_t p) {
        return p != a && p != b && p != c && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 &&
               turn(c, a, p) >= 0;
      };
      if (std::ranges::none_of(left, is_in)) break;
    }
    const std::uint32_t a = left[ear], b = left[(ear + 1) % left.size()],
                        c = left[(ear + 2) % left.size()];
    comb.triangles.push_back({a, b, c});
    comb.triangles.push_back({a + n, c + n, b + n});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>((ear + 1) % left.size()));
  }
  return comb;
}

/// Returns how often a closed mesh winds around a point: its solid angles over 4 pi (van Oosterom
/// and Strackee 1983), in long double; NaN for points close to the surface.
long double winding(const TriangleMesh& mesh, const Vec3<long double>& at) {
  long double sum = 0;
  for (std::uint32_t i = 0; i < mesh.size(); ++i) {
    std::array<Vec3<long double>, 3> v;
    std::array<long double, 3> size;
    for (std::size_t k = 0; k < 3; ++k) {
      v[k] = mesh.corner(i, k).cast<long double>() - at;
      size[k] = std::sqrt(v[k].squaredNorm());
    }
    const long double least = 1e-9L * size[0] * size[1] * size[2];
    const long double volume = v[0].dot(v[1].cross(v[2]));
    const long double share = size[0] * size[1] * size[2] + v[0].dot(v[1]) * size[2] +
                              v[1].dot(v[2]) * size[0] + v[2].dot(v[0]) * size[1];
    if (std::abs(volume) <= least && share <= least) return std::nanl("");
    sum += std::atan2(volume, share);
  }
  return sum / (2 * std::numbers::pi_v<long double>);
}

using testing::quad;
using testing::Quad;
using testing::QuadVec;

/// Finds where the ray's line passes the plane of a triangle, in quadruple precision, to
/// `rounding`.
struct TrueT {
  Quad t, rounding;
};
TrueT t_of(const TriangleMesh& mesh, std::uint32_t part, const Ray<double>& ray) {
  const QuadVec corner = quad(mesh.corner(part, 0)), a = corner - quad(ray.origin),
                u = quad(mesh.corner(part, 1)) - corner, v = quad(mesh.corner(part, 2)) - corner,
                n = u.cross(v);
  Quad size = 0;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const double of_n = double(u[i]) * double(v[j]), of_a = double(a[k]);
    size += std::abs(of_n * of_a) + std::abs(double(u[j]) * double(v[i]) * of_a);
  }
  const Quad fall = n.dot(quad(ray.direction));
  return {n.dot(a) / fall, Quad(0x1p-108) * size / testing::size_of(fall)};
}

struct Checked {
  int hits = 0, wound = 0, at_edges = 0;
};

/// Entries and leavings alternate, t and its bounds hold, and the winding numbers between two hits
/// agree with the hits.
void check(const TriangleMesh& mesh, const Ray<double>& ray, bool begins_outside,
           Checked& checked) {
  const std::vector<PartHit> hits = crossings(mesh, ray);
  if (begins_outside) {
    ASSERT_EQ(hits.size() % 2, 0u);
    ASSERT_TRUE(hits.empty() || !hits[0].is_back);
  }
  const std::vector<PartHit> all = all_parts(mesh, ray);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const PartHit& hit = hits[i];
    if (i > 0) {
      ASSERT_NE(hit.is_back, hits[i - 1].is_back);
      ASSERT_GE(hit.t, hits[i - 1].t);
    }
    ++checked.hits;
    checked.at_edges += hit.is_at_edge ? 1 : 0;
    ASSERT_TRUE(std::ranges::any_of(all, [&](const PartHit& one) { return one.part == hit.part; }));
    const auto [t, rounding] = t_of(mesh, hit.part, ray);
    ASSERT_LE(double(hit.t - t), hit.error + double(rounding));
    ASSERT_LE(double(t - hit.t), hit.error + double(rounding));
  }
  // Those that pass no edge are all there.
  for (const PartHit& one : all)
    ASSERT_TRUE(one.is_at_edge || std::ranges::any_of(hits, [&](const PartHit& hit) {
                  return hit.part == one.part;
                }));
  for (std::size_t i = 0; i <= hits.size(); ++i) {
    const double from = i == 0 ? 0 : hits[i - 1].t, to = i == hits.size() ? from + 1 : hits[i].t;
    if (!(to - from > 1e-6)) continue;
    const long double middle = 0.5L * (from + to);
    const long double found =
        winding(mesh, ray.origin.cast<long double>() + middle * ray.direction.cast<long double>());
    if (std::isnan(found)) continue;
    ASSERT_NEAR(double(found), std::round(double(found)), 1e-6);
    ++checked.wound;
    const bool is_inside = i == hits.size() ? false : hits[i].is_back;
    ASSERT_EQ(std::lround(found), is_inside ? 1 : 0) << i << " of " << hits.size();
  }
}

void check_aimed_rays(const Surface& surface, std::uint64_t seed, int rays) {
  const TriangleMesh mesh = surface.mesh();
  ASSERT_TRUE(mesh.is_closed());
  const Vec3<double> middle = mesh.bounds().centre(), half = mesh.bounds().half_extents();
  testing::Random random(seed);
  Checked checked;
  for (int i = 0; i < rays; ++i) {
    const auto corner = [&](std::uint32_t part, std::size_t k) { return mesh.corner(part, k); };
    const auto one = static_cast<std::uint32_t>(random.below(int(mesh.size())));
    const auto other = static_cast<std::uint32_t>(random.below(int(mesh.size())));
    const Vec3<double> a = corner(one, 0), b = corner(one, 1), c = corner(one, 2);
    Vec3<double> at = a, d;
    switch (i % 7) {
      case 0:  // through a vertex, along an axis
        d = Vec3<double>::Unit(random.below(3));
        break;
      case 1:  // through two vertices
        d = corner(other, 0) - a;
        break;
      case 2:  // along an edge
        d = b - a;
        break;
      case 3:  // within a triangle's plane, through a vertex
        d = (random.below(9) - 4.0) * (b - a) + (random.below(9) - 4.0) * (c - a);
        break;
      case 4:  // through the middles of two edges
        at = 0.5 * (a + b);
        d = 0.5 * (corner(other, 1) + corner(other, 2)) - at;
        break;
      case 5:  // through a vertex
        d = random.direction();
        break;
      default:  // anywhere
        at = middle + random.in_cube().cwiseProduct(half);
        d = random.direction();
    }
    if (d.isZero(0)) continue;
    // Whole steps back keep the numbers exact where they are whole.
    const double steps = std::ceil(4 * half.norm() / d.norm());
    const Ray<double> ray{at - steps * d, d};
    ASSERT_NO_FATAL_FAILURE(check(mesh, ray, true, checked)) << i << " of seed " << seed;
    const Ray<double> back{at + steps * d, -d};
    ASSERT_NO_FATAL_FAILURE(check(mesh, back, true, checked)) << i << " of seed " << seed;
    // From the surface itself.
    ASSERT_NO_FATAL_FAILURE(check(mesh, {at, d}, false, checked)) << i << " of seed " << seed;
  }
  EXPECT_GT(checked.hits, rays);
  EXPECT_GT(checked.wound, rays);
  EXPECT_GT(checked.at_edges, rays / 2);
}

TEST(Crossings, enter_and_leave_in_turn_at_edges_and_vertices) {
  const int rays = testing::number_of_cases(6000);
  check_aimed_rays(testing::block({1, 2, 3}), 1, rays);
  check_aimed_rays(comb(4), 2, rays);
  check_aimed_rays(testing::torus(16, 12), 3, rays / 4);
  check_aimed_rays(testing::bumpy_ball(12, 16), 4, rays / 4);
}

TEST(Crossings, an_end_only_cuts_the_list) {
  const TriangleMesh mesh = comb(5).mesh();
  testing::Random random(5);
  for (int i = 0; i < testing::number_of_cases(4000); ++i) {
    const Vec3<double> at =
        mesh.corner(static_cast<std::uint32_t>(random.below(int(mesh.size()))), 0);
    Ray<double> ray{at - 10 * Vec3<double>::UnitX(), Vec3<double>::UnitX()};
    if (i % 2 == 0) ray = {10 * random.direction(), {}};
    if (i % 2 == 0) ray.direction = at - ray.origin;
    const std::vector<PartHit> all = crossings(mesh, ray);
    ray.t_max = all.empty() || i % 3 == 0 ? random.uniform(0, 20)
                                          : all[std::size_t(random.below(int(all.size())))].t;
    const std::vector<PartHit> cut = crossings(mesh, ray);
    std::size_t within = 0;
    while (within < all.size() && all[within].t <= ray.t_max) ++within;
    ASSERT_EQ(cut.size(), within);
    for (std::size_t k = 0; k < cut.size(); ++k) ASSERT_EQ(cut[k].part, all[k].part);
  }
}

TEST(Crossings, of_repeated_triangles_count_once) {
  // The first triangle again, its corners turned, and then the rest as well.
  Surface block = testing::block({1, 1, 1});
  const Surface plain = block;
  block.triangles.push_back({plain.triangles[0][1], plain.triangles[0][2], plain.triangles[0][0]});
  testing::Random random(7);
  for (int round = 0; round < 2; ++round) {
    const TriangleMesh mesh = block.mesh();
    EXPECT_TRUE(mesh.is_closed());
    EXPECT_TRUE(is_within(mesh, {0.1, 0.2, 0.3}));
    EXPECT_FALSE(is_within(mesh, {0.1, 0.2, -1.3}));
    for (int i = 0; i < testing::number_of_cases(500); ++i) {
      Ray<double> ray{{random.uniform(-1, 1), random.uniform(-1, 1), -3}, {0, 0, 1}};
      if (i % 2 == 0) ray.origin.x() = ray.origin.y();  // through the diagonal
      const auto hits = crossings(mesh, ray);
      ASSERT_EQ(hits.size(), 2u);
      ASSERT_FALSE(hits[0].is_back);
      ASSERT_TRUE(hits[1].is_back);
    }
    block.triangles.insert(block.triangles.end(), plain.triangles.begin(), plain.triangles.end());
  }
}

TEST(Crossings, sheets_without_thickness_are_entered_and_left) {
  // Two triangles back to back, and two boxes that share a face.
  const Surface pillow{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 2, 1}, {0, 1, 2}}};
  for (const double up : {1.0, -1.0}) {
    const auto hits = crossings(pillow.mesh(), {{0.2, 0.2, -up}, {0, 0, up}});
    ASSERT_EQ(hits.size(), 2u);
    EXPECT_FALSE(hits[0].is_back);
    EXPECT_TRUE(hits[1].is_back);
    EXPECT_EQ(hits[0].t, 1);
    EXPECT_EQ(hits[1].t, 1);
  }
  Surface two = testing::block({1, 1, 1});
  const Surface other = testing::block({1, 1, 1});
  for (const Vec3<double>& v : other.vertices) two.vertices.push_back(v + Vec3<double>(2, 0, 0));
  for (Corners corners : other.triangles) {
    for (std::uint32_t& corner : corners) corner += 8;
    two.triangles.push_back(corners);
  }
  const TriangleMesh mesh = two.mesh();
  testing::Random random(6);
  Checked checked;
  for (int i = 0; i < testing::number_of_cases(2000); ++i) {
    const Vec3<double> at(1, 0.25 * (random.below(5) - 2), 0.25 * (random.below(5) - 2));
    Vec3<double> d(1, 0.5 * (random.below(5) - 2), 0.5 * (random.below(5) - 2));
    if (i % 2 == 0) d = -d;
    Ray<double> ray{at - 4 * d, d};
    if (i % 3 == 0) ray.origin = at - 0.25 * d;
    const auto hits = crossings(mesh, ray);
    ASSERT_EQ(hits.size() % 2, i % 3 == 0 ? 1u : 0u);
    for (std::size_t k = 1; k < hits.size(); ++k) ASSERT_NE(hits[k].is_back, hits[k - 1].is_back);
    if (i % 3 != 0) continue;
    // An end at the common face cuts the list between its two triangles, or behind both.
    ray.t_max = 0.25;
    const auto first = crossings(mesh, ray);
    ASSERT_LE(first.size(), hits.size());
    for (std::size_t k = 0; k < first.size(); ++k) ASSERT_EQ(first[k].part, hits[k].part);
  }
}

TEST(PerturbedLine, sides_are_those_of_a_line_nearby) {
  // Numbers up to 4 leave room for moves that are small enough, in quadruple precision.
  testing::Random random(7);
  const auto whole = [&] {
    return Vec3<double>(random.below(5) - 2, random.below(5) - 2, random.below(5) - 2);
  };
  int zero = 0;
  for (int i = 0; i < testing::number_of_cases(200000); ++i) {
    const Vec3<double> o = whole(), d = whole(), a = whole(), b = whole();
    if (d.isZero(0) || exact_side_of_edge(o, d, a, b) != 0) continue;
    const int side = moved_side_of_edge(o, d, a, b);
    ASSERT_EQ(side, -moved_side_of_edge(o, d, b, a));
    ASSERT_EQ(side == 0, a == b);
    ++zero;
    // The line through the edge itself, or parallel to it, needs the smallest moves only.
    const Vec3<double> e = b - a;
    const bool is_parallel = d.cross(e).isZero(0);
    const Quad m = Quad(0x1p-12), e1 = Quad(0x1p-36), e2 = e1 * e1, e3 = e1 * e2;
    const QuadVec from = quad(a) - quad(o) - QuadVec(e1, e2, e3),
                  along = is_parallel ? QuadVec(1, m, m * m) : quad(d);
    const Quad volume = along.dot(from.cross(quad(e)));
    ASSERT_EQ(side, volume > 0 ? 1 : volume < 0 ? -1 : 0) << i;
  }
  EXPECT_GT(zero, 1000);
}

}  // namespace
}  // namespace minkray
