// SPDX-License-Identifier: MIT
#include "core/mesh/mesh_ray.h"

#include <gtest/gtest.h>

#include "tests/support/meshes.h"
#include "tests/support/number_of_cases.h"
#include "tests/support/random.h"

namespace minkray {
namespace {

using testing::Surface;

TEST(MeshRay, at_whole_numbers_t_is_off_by_its_error_at_most) {
  testing::Random random(1);
  const auto whole = [&](int most) {
    return Vec3<double>(random.below(2 * most) - most, random.below(2 * most) - most,
                        random.below(2 * most) - most);
  };
  int hits = 0, wide = 0;
  for (int i = 0; i < testing::number_of_cases(200000); ++i) {
    const int most = i % 3 == 0 ? 4 : 20000;
    const Vec3<double> a = whole(most), b = whole(most);
    // Every fourth one is a sliver.
    const Vec3<double> c = i % 4 == 0 ? Vec3<double>(b + whole(2)) : whole(most);
    const Ray<double> ray{whole(most), whole(most)};
    if (ray.direction.isZero(0)) continue;
    const PartHit hit = cast_at_triangle(a, b, c, ray);
    // Products of whole numbers below 2^63 have all digits in long double.
    const auto exact = [](const Vec3<double>& v) {
      return Vec3<long double>(v.cast<long double>());
    };
    const Vec3<long double> o = exact(ray.origin), d = exact(ray.direction);
    const Vec3<long double> n = (exact(b) - exact(a)).cross(exact(c) - exact(a));
    const auto side = [&](const Vec3<double>& from, const Vec3<double>& to) {
      return d.dot((exact(from) - o).cross(exact(to) - exact(from)));
    };
    const long double ab = side(a, b), bc = side(b, c), ca = side(c, a), fall = d.dot(n);
    const bool goes_through =
        fall != 0 && ((ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0));
    const long double t = n.dot(exact(a) - o) / fall;
    if (!goes_through || t < 0) {
      ASSERT_FALSE(hit.found() && hit.t > hit.error) << i;
      continue;
    }
    ++hits;
    ASSERT_TRUE(hit.found() || t <= 1e-12L) << i;
    if (!hit.found()) continue;
    ASSERT_LE(std::abs(hit.t - t), (long double)(hit.error)) << i;
    ASSERT_EQ(hit.is_back, fall > 0);
    wide += hit.error > 1e-9 * (1 + hit.t) ? 1 : 0;
  }
  EXPECT_GT(hits, 5000);
  EXPECT_LT(wide, hits / 100);
}

TEST(MeshRay, finds_what_each_triangle_by_itself_finds) {
  const TriangleMesh mesh = testing::bumpy_ball(30, 40).mesh();
  testing::Random random(2);
  for (int i = 0; i < 2000; ++i) {
    Ray<double> ray{2 * random.direction(), random.direction()};
    if (i % 2 == 0) ray.direction = 1.1 * random.direction() - ray.origin;
    if (i % 5 == 0) ray.t_max = random.uniform(0, 3);
    std::vector<PartHit> hits;
    for (std::uint32_t k = 0; k < mesh.size(); ++k) {
      PartHit hit = cast_at_triangle(mesh.corner(k, 0), mesh.corner(k, 1), mesh.corner(k, 2), ray);
      if (!hit.found() || !(hit.t <= ray.t_max)) continue;
      hit.part = k;
      hits.push_back(hit);
    }
    std::sort(hits.begin(), hits.end(),
              [](const PartHit& a, const PartHit& b) { return b.yields_to(a); });
    PartCounts counts;
    const PartHit closest = closest_part(mesh, ray, 0, counts);
    ASSERT_EQ(closest.found(), !hits.empty());
    ASSERT_EQ(meets_part(mesh, ray, 0, counts), !hits.empty());
    const std::vector<PartHit> all = all_parts(mesh, ray);
    ASSERT_EQ(all.size(), hits.size());
    if (hits.empty()) continue;
    ASSERT_EQ(closest.part, hits[0].part);
    ASSERT_EQ(closest.t, hits[0].t);
    for (std::size_t k = 0; k < all.size(); ++k) ASSERT_EQ(all[k].part, hits[k].part);
  }
}

/// Number of rays from within a closed mesh, at its vertices, edges, and along its edges, that get
/// out.
int leaks(const Surface& surface, int rays,
          const std::function<Vec3<double>(testing::Random&)>& in) {
  const TriangleMesh mesh = surface.mesh();
  testing::Random random(3);
  int leaks = 0;
  for (int i = 0; i < rays; ++i) {
    const auto triangle = static_cast<std::uint32_t>(random.below(int(mesh.size())));
    const Vec3<double>&a = mesh.corner(triangle, 0), &b = mesh.corner(triangle, 1);
    const Vec3<double> at = i % 2 == 0 ? a : Vec3<double>(a + random.uniform() * (b - a));
    const Vec3<double> origin = in(random);
    PartCounts counts;
    leaks += closest_part(mesh, {origin, at - origin}, 0, counts).found() ? 0 : 1;
  }
  return leaks;
}

TEST(MeshRay, none_slips_through_a_closed_mesh) {
  const int rays = testing::number_of_cases(50000);
  const auto near_middle = [](testing::Random& random) {
    return Vec3<double>(0.1 * random.in_cube());
  };
  EXPECT_EQ(leaks(testing::bumpy_ball(60, 80), rays, near_middle), 0);
  EXPECT_EQ(leaks(testing::block({1, 2, 3}), rays, near_middle), 0);
  EXPECT_EQ(leaks(testing::torus(60, 40), rays,
                  [](testing::Random& random) {
                    const double u = random.uniform(0, 6.28);
                    return Vec3<double>(std::cos(u), std::sin(u), 0);
                  }),
            0);
  // Along axes, through vertices and along edges: the middle is in line with all of them.
  EXPECT_EQ(leaks(testing::block({1, 1, 1}), rays,
                  [](testing::Random&) { return Vec3<double>(0, 0, 0); }),
            0);
}

TEST(MeshRay, does_not_meet_what_has_no_area_or_lies_along_it) {
  const Vec3<double> a(0, 0, 0), b(1, 1, 0), c(2, 2, 0);
  EXPECT_FALSE(cast_at_triangle(a, b, c, {{1, 1, 1}, {0, 0, -1}}).found());
  EXPECT_FALSE(cast_at_triangle(a, a, a, {{0, 0, 1}, {0, 0, -1}}).found());
  EXPECT_FALSE(cast_at_triangle(a, {1, 0, 0}, {0, 1, 0}, {{-1, 0.2, 0}, {1, 0, 0}}).found());
  EXPECT_TRUE(cast_at_triangle(a, {1, 0, 0}, {0, 1, 0}, {{0, 0, 1}, {0, 0, -1}}).found());
}

}  // namespace
}  // namespace minkray
