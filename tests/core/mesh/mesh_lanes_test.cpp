// SPDX-License-Identifier: MIT
// Walks in which float lanes sort out triangles find, bit for bit, what double finds in a plain
// walk.
#include <gtest/gtest.h>

#include "core/mesh/mesh_rays.h"
#include "tests/support/meshes.h"
#include "tests/support/number_of_cases.h"
#include "tests/support/random.h"

namespace minkray {
namespace {

using testing::Surface;

/// A hierarchy with a triangle in each leaf; each triangle is cast at in double.
class PlainWalk {
 public:
  explicit PlainWalk(const TriangleMesh& mesh) : mesh_(mesh) {
    FirstTouchVector<Bounds<float>> boxes;
    for (std::uint32_t i = 0; i < mesh.size(); ++i) {
      Bounds<double> box;
      for (std::size_t k = 0; k < 3; ++k) box.extend(mesh.corner(i, k));
      boxes.push_back(rounded_outwards(box));
    }
    bvh_ = build_bvh(std::move(boxes));
  }

  PartHit closest(const PartRay& of) const {
    PartHit closest;
    SlabRay slabs(of.ray);
    traverse(bvh_, slabs, [&](std::uint32_t i) {
      PartHit hit =
          cast_at_triangle(mesh_.corner(i, 0), mesh_.corner(i, 1), mesh_.corner(i, 2), of.ray);
      if (!hit.found() || !(hit.t >= of.t_min) || !(hit.t <= of.ray.t_max)) return false;
      hit.part = i;
      if (!closest.yields_to(hit)) return false;
      closest = hit;
      slabs.numbers.t_max = std::min(slabs.numbers.t_max, slabs.limit(hit.t + hit.error));
      return false;
    });
    return closest;
  }

 private:
  const TriangleMesh& mesh_;
  Bvh bvh_;
};

/// Rays through edges and corners, along edges, in planes, along axes, from far away, from the
/// surface, of all lengths, and limited.
PartRay aimed_ray(const TriangleMesh& mesh, testing::Random& random, int kind) {
  const double size = mesh.bounds().half_extents().maxCoeff();
  const Vec3<double> middle = mesh.bounds().centre();
  const auto triangle = static_cast<std::uint32_t>(random.below(int(mesh.size())));
  const Vec3<double>&a = mesh.corner(triangle, 0), &b = mesh.corner(triangle, 1),
        &c = mesh.corner(triangle, 2);
  const Vec3<double> at_edge = a + random.uniform() * (b - a);
  const Vec3<double> around = middle + 3 * size * random.direction();
  const int axis = random.below(3);
  Ray<double> ray{around, Vec3<double>(at_edge - around)};
  switch (kind % 13) {
    case 0:
      break;
    case 1:
      ray.direction = a - around;
      break;
    case 2:
      ray = {a - std::ceil(random.uniform(0, 100)) * (b - a), b - a};
      break;
    case 3: {
      const Vec3<double> within = (b - a).cross(c - a).cross(b - a);
      if (within.norm() > 0) ray.direction = size * within.normalized();
      ray.origin = at_edge - 4 * ray.direction;
      break;
    }
    case 4:
      ray.direction.setZero();
      ray.direction[axis] = random.below(2) == 0 ? size : -size;
      ray.origin = a - 8 * ray.direction;
      break;
    case 5:
      ray.origin = middle + 1e6 * size * random.direction();
      break;
    case 6:
      ray.direction[axis] = 0;
      ray.origin = at_edge - 3 * ray.direction;
      break;
    case 7:
      ray = {a, size * random.direction()};
      break;
    case 8:
      ray = {at_edge, b - c};
      break;
    case 9:
      ray.direction = 0.4 * a + 0.3 * b + 0.3 * c - around;
      ray.t_max = random.uniform(0, 2);
      break;
    case 10:
      ray.origin = middle + 0.1 * size * random.in_cube();
      break;
    case 11:
      ray.direction *= std::ldexp(1.0, random.below(160) - 80);
      break;
    default:
      ray.direction[axis] *= 1e-12;
      break;
  }
  if (kind % 13 == 5 || kind % 13 == 10) ray.direction = at_edge - ray.origin;
  return {ray, kind % 5 == 0 ? random.uniform(0, 1) : 0};
}

/// Number of results of single rays, and of many at a time, that differ from the plain walk's.
int other_answers(const TriangleMesh& mesh, std::span<const PartRay> rays, int& hits) {
  const PlainWalk plain(mesh);
  PartCounts counts;
  std::vector<PartHit> many(rays.size());
  std::vector<std::uint8_t> met(rays.size());
  closest_parts(mesh, rays, many, counts);
  meet_parts(mesh, rays, met, counts);
  int others = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const PartHit expected = plain.closest(rays[i]);
    const auto is_same = [&](const PartHit& hit) {
      return hit.part == expected.part && hit.t == expected.t && hit.error == expected.error &&
             hit.is_back == expected.is_back && hit.is_at_edge == expected.is_at_edge;
    };
    hits += expected.found() ? 1 : 0;
    others += is_same(many[i]) ? 0 : 1;
    others += is_same(closest_part(mesh, rays[i].ray, rays[i].t_min, counts)) ? 0 : 1;
    others += (met[i] != 0) == expected.found() ? 0 : 1;
    others += meets_part(mesh, rays[i].ray, rays[i].t_min, counts) == expected.found() ? 0 : 1;
  }
  return others;
}

TriangleMesh scaled(Surface surface, double scale, const Vec3<double>& shift) {
  for (Vec3<double>& vertex : surface.vertices) vertex = scale * vertex + shift;
  return surface.mesh();
}

void expect_same_answers(const TriangleMesh& mesh, int count) {
  testing::Random random(11);
  std::vector<PartRay> rays;
  for (int i = 0; i < count; ++i) rays.push_back(aimed_ray(mesh, random, i));
  int hits = 0;
  EXPECT_EQ(other_answers(mesh, rays, hits), 0);
  EXPECT_GT(hits, count / 2);
}

TEST(MeshLanes, find_what_double_finds_of_aimed_rays) {
  const int count = testing::number_of_cases(40000);
  expect_same_answers(testing::bumpy_ball(60, 80).mesh(), count);
  expect_same_answers(testing::torus(100, 60).mesh(), count);
  expect_same_answers(testing::block({1, 2, 3}).mesh(), count);
}

TEST(MeshLanes, find_what_double_finds_at_any_scale_and_place) {
  const int count = testing::number_of_cases(10000);
  for (const double scale : {1e-17, 1e-5, 1e6, 1e17})
    expect_same_answers(scaled(testing::bumpy_ball(30, 40), scale, {0, 0, 0}), count);
  expect_same_answers(scaled(testing::torus(60, 40), 1, {1e6, -3e5, 1e3}), count);
  // Sizes at which lanes are not used at all.
  for (const double scale : {1e-60, 1e60})
    expect_same_answers(scaled(testing::bumpy_ball(6, 8), scale, {0, 0, 0}), count / 10);
}

TEST(MeshLanes, find_what_double_finds_of_rays_from_one_point) {
  const TriangleMesh mesh = testing::bumpy_ball(80, 100).mesh();
  testing::Random random(12);
  std::vector<PartRay> rays;
  for (int i = 0; i < testing::number_of_cases(1500); ++i) {
    // Half of them go through edges and corners of triangles that follow each other.
    const Vec3<double> from = (i % 3 == 0 ? 0.1 : i % 3 == 1 ? 3 : 1e5) * random.direction();
    const auto first = static_cast<std::uint32_t>(random.below(int(mesh.size()) - 32));
    const Vec3<double> sideways = 0.1 * random.direction(), up = 0.1 * random.direction();
    for (std::uint32_t k = 0; k < 32; ++k) {
      const std::uint32_t triangle = first + k / 2;
      const Vec3<double>&a = mesh.corner(triangle, k % 3), &b = mesh.corner(triangle, (k + 1) % 3);
      Vec3<double> at = k % 2 == 0 ? a : Vec3<double>(a + random.uniform() * (b - a));
      if (i % 2 == 0) at = mesh.corner(first, 0) + (k % 8 / 8.0) * sideways + (k / 8 / 4.0) * up;
      PartRay ray{{from, at - from}};
      if (k % 7 == 0) ray.ray.t_max = 0.99;
      if (k % 11 == 0) ray.t_min = 0.3;
      if (i % 4 < 2) {  // lengths differ within a group
        const double length = std::pow(10.0, random.uniform(-3, 3));
        ray.ray.direction *= length;
        ray.ray.t_max /= length;
        ray.t_min /= length;
      }
      rays.push_back(ray);
    }
  }
  rays.resize(rays.size() - 5);  // the last group has fewer rays
  int hits = 0;
  EXPECT_EQ(other_answers(mesh, rays, hits), 0);
  EXPECT_GT(hits, int(rays.size()) / 2);
}

TEST(MeshLanes, leaves_are_nearly_full_and_hold_their_triangles) {
  const TriangleMesh mesh = testing::torus(150, 100).mesh();
  std::vector<int> seen(mesh.size());
  for (const MeshLeaf& leaf : mesh.leaves())
    for (std::size_t i = 0; i < std::size_t(leaf.size()); ++i) {
      ++seen[leaf.triangles[i]];
      for (std::size_t k = 0; k < 3; ++k)
        for (int axis = 0; axis < 3; ++axis) {
          const double units =
              (mesh.corner(leaf.triangles[i], k)[axis] - double(leaf.origin[axis])) *
              double(leaf.scale());
          ASSERT_LE(std::abs(units - leaf.corners[k][std::size_t(axis)][i]), 0.5 + 1e-9);
        }
    }
  EXPECT_TRUE(std::ranges::all_of(seen, [](int times) { return times == 1; }));
  EXPECT_GT(double(mesh.size()) / double(mesh.leaves().size()), 7.5);
  EXPECT_LT(double(mesh.bytes()) / double(mesh.size()), 64);
}

}  // namespace
}  // namespace minkray
