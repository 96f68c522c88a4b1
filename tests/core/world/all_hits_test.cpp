// SPDX-License-Identifier: MIT
// Compares all hits of rays with closed forms of each instance in quadruple precision.
#include <gtest/gtest.h>

#include <sstream>

#include "core/world/world.h"
#include "tests/oracle/quad.h"
#include "tests/support/meshes.h"
#include "tests/support/number_of_cases.h"
#include "tests/support/random.h"
#include "tests/support/shifted.h"

namespace minkray {
namespace {

using testing::quad;
using testing::Quad;
using testing::QuadVec;
using testing::root;

/// A body at a place: a sphere, a box, a half-space below z = place.z, or a mesh.
struct Body {
  enum Kind { ball, block, ground, mesh } kind;
  Vec3<double> place = Vec3<double>::Zero();
  double size = 1;
};

struct TrueHit {
  Quad t;
  std::uint32_t instance;
  bool leaves;
};

struct Scenery {
  testing::Surface surface = testing::torus(12, 10);
  std::vector<Body> bodies;

  World world() const {
    Instances instances;
    const auto shared = surface.shared();
    for (const Body& body : bodies) {
      const Affine<double> at{shifted_by(body.place)};
      if (body.kind == Body::ball)
        instances.add(Shape{Sphere{body.size}}, at);
      else if (body.kind == Body::block)
        instances.add(Shape{Box{{body.size, 2 * body.size, 0.5 * body.size}}}, at);
      else if (body.kind == Body::ground)
        instances.add(HalfSpaceBody<double>{Vec3<double>::UnitZ(), body.place.z()});
      else
        instances.add(shared, at);
    }
    return World(std::move(instances));
  }
};

/// Adds the ends of a line's part within a body, from `in` to `out`.
void add(std::vector<TrueHit>& to, const Ray<double>& ray, std::uint32_t instance, Quad in,
         Quad out) {
  const Quad end = ray.t_max;
  if (in > out || out < 0 || in > end) return;
  if (in > 0) to.push_back({in, instance, false});
  if (out <= end && out < Quad(std::numeric_limits<double>::infinity()))
    to.push_back({out, instance, true});
}

void add_true_hits(const Scenery& scenery, std::uint32_t instance, const Ray<double>& ray,
                   std::vector<TrueHit>& to) {
  const Body& body = scenery.bodies[instance];
  const QuadVec o = quad(ray.origin) - quad(body.place), d = quad(ray.direction);
  const Quad never = std::numeric_limits<double>::infinity();
  if (body.kind == Body::ball) {
    const Quad a = d.squaredNorm(), b = o.dot(d), c = o.squaredNorm() - Quad(body.size) * body.size;
    const Quad inner = b * b - a * c;
    if (inner <= 0) return;
    add(to, ray, instance, (-b - root(inner)) / a, (-b + root(inner)) / a);
  } else if (body.kind == Body::block) {
    const Quad half[3] = {body.size, 2 * body.size, 0.5 * body.size};
    Quad in = -never, out = never;
    for (int k = 0; k < 3; ++k) {
      if (d[k] == 0) {
        if (o[k] > half[k] || o[k] < -half[k]) return;
        continue;
      }
      const Quad one = (-half[k] - o[k]) / d[k], other = (half[k] - o[k]) / d[k];
      in = std::max(in, std::min(one, other));
      out = std::min(out, std::max(one, other));
    }
    add(to, ray, instance, in, out);
  } else if (body.kind == Body::ground) {
    if (d[2] == 0) return;
    const Quad t = -o[2] / d[2];
    add(to, ray, instance, d[2] < 0 ? t : -never, d[2] < 0 ? never : t);
  } else {
    for (const Corners& corners : scenery.surface.triangles) {
      QuadVec p[3];
      for (std::size_t i = 0; i < 3; ++i) p[i] = quad(scenery.surface.vertices[corners[i]]) - o;
      const auto volume = [](const QuadVec& u, const QuadVec& v, const QuadVec& w) {
        return u.dot(v.cross(w));
      };
      const Quad ab = volume(d, p[0], p[1]), bc = volume(d, p[1], p[2]), ca = volume(d, p[2], p[0]);
      if (!((ab > 0 && bc > 0 && ca > 0) || (ab < 0 && bc < 0 && ca < 0))) continue;
      const Quad t = volume(p[0], p[1], p[2]) / (ab + bc + ca);
      if (t >= 0 && t <= Quad(ray.t_max)) to.push_back({t, instance, ab > 0});
    }
  }
}

Scenery random_scenery(testing::Random& random, int bodies) {
  Scenery scenery;
  // Places on a grid, so that differences to them are exact; some bodies are there several times.
  const auto place = [&] {
    return Vec3<double>(0.125 * random.below(33) - 2, 0.125 * random.below(33) - 2,
                        0.125 * random.below(33) - 2);
  };
  scenery.bodies.push_back({Body::ground, {0, 0, -1.5}});
  while (int(scenery.bodies.size()) < bodies) {
    const Body::Kind kinds[] = {Body::ball, Body::block, Body::ball, Body::block, Body::mesh};
    const Body body{kinds[random.below(5)], place(), 0.25 + 0.25 * random.below(3)};
    for (int k = random.below(6) == 0 ? 4 : 1; k > 0; --k) scenery.bodies.push_back(body);
  }
  return scenery;
}

TEST(AllHits, are_those_of_closed_forms) {
  testing::Random random(1);
  int hits = 0, leavings = 0, of_meshes = 0, ends = 0;
  for (int round = 0; round < 20; ++round) {
    const Scenery scenery = random_scenery(random, 25);
    const World world = scenery.world();
    for (int i = 0; i < testing::number_of_cases(300); ++i) {
      Ray<double> ray{4 * random.in_cube(), random.direction()};
      if (i % 2 == 0) ray.direction = 2 * random.in_cube() - ray.origin;
      if (i % 3 == 0) ray.t_max = random.uniform(0, 4);
      if (i % 5 == 0) ray.origin = 1.5 * random.in_cube();
      std::vector<TrueHit> expected;
      for (std::uint32_t k = 0; k < scenery.bodies.size(); ++k)
        add_true_hits(scenery, k, ray, expected);
      std::ranges::sort(expected, [](const TrueHit& a, const TrueHit& b) {
        return a.t < b.t || (a.t == b.t && a.instance < b.instance);
      });
      std::vector<WorldCrossing> found;
      QueryCounts counts;
      world.all_hits({ray}, found, counts);
      ASSERT_EQ(counts.exhausted, 0u);
      const auto both = [&] {
        std::ostringstream text;
        text.precision(17);
        for (const TrueHit& one : expected)
          text << double(one.t) << " of " << one.instance << (one.leaves ? " out, " : " in, ");
        text << "found ";
        for (const WorldCrossing& one : found)
          text << one.t << " of " << one.instance << (one.leaves ? " out, " : " in, ");
        return text.str();
      };
      ASSERT_EQ(found.size(), expected.size()) << both();
      for (std::size_t k = 1; k < found.size(); ++k)
        ASSERT_TRUE(found[k - 1].t < found[k].t ||
                    (found[k - 1].t == found[k].t && found[k - 1].instance <= found[k].instance));
      // Faces in one plane have one true t, so the order of instances may differ there.
      const auto by_instance = [](const auto& a, const auto& b) { return a.instance < b.instance; };
      std::stable_sort(expected.begin(), expected.end(), by_instance);
      std::stable_sort(found.begin(), found.end(), by_instance);
      for (std::size_t k = 0; k < found.size(); ++k) {
        ASSERT_EQ(found[k].instance, expected[k].instance) << both();
        ASSERT_EQ(found[k].leaves, expected[k].leaves);
        ASSERT_LE(Quad(found[k].t_lo), expected[k].t) << round << ' ' << i << ' ' << k;
        ASSERT_GE(Quad(found[k].t_hi), expected[k].t) << round << ' ' << i << ' ' << k;
        ASSERT_LE(found[k].t_hi - found[k].t_lo, 1e-9 * (1 + found[k].t));
        ASSERT_EQ(found[k].normal.dot(ray.direction) > 0, found[k].leaves);
        ASSERT_LE((found[k].point - ray.at(found[k].t)).norm(), 1e-14 * (1 + found[k].t));
        leavings += found[k].leaves ? 1 : 0;
        of_meshes += found[k].part != no_part ? 1 : 0;
      }
      hits += int(found.size());
      ends += std::isfinite(ray.t_max) && !found.empty() ? 1 : 0;
    }
  }
  EXPECT_GT(hits, 10000);
  EXPECT_GT(leavings, 4000);
  EXPECT_GT(of_meshes, 1000);
  EXPECT_GT(ends, 200);
}

TEST(AllHits, the_first_entry_is_the_closest_hit_from_outside) {
  testing::Random random(2);
  const Scenery scenery = random_scenery(random, 40);
  const World world = scenery.world();
  for (int i = 0; i < testing::number_of_cases(4000); ++i) {
    Vec3<double> from = 9 * random.direction();
    from.z() = std::abs(from.z());
    const Ray<double> ray{from, 3 * random.in_cube() - from};
    std::vector<WorldCrossing> all;
    QueryCounts counts;
    world.all_hits({ray}, all, counts);
    const WorldHit first = world.closest_hit(ray, counts);
    ASSERT_EQ(first.found(), !all.empty());
    if (all.empty()) continue;
    ASSERT_EQ(all[0].instance, first.instance);
    ASSERT_EQ(all[0].part, first.part);
    ASSERT_EQ(all[0].t, first.cast.t());
    // Without that instance the others stay.
    std::vector<WorldCrossing> others;
    world.all_hits({ray, first.instance}, others, counts);
    std::erase_if(all, [&](const WorldCrossing& one) { return one.instance == first.instance; });
    ASSERT_EQ(others.size(), all.size());
    for (std::size_t k = 0; k < all.size(); ++k) ASSERT_EQ(others[k].t, all[k].t);
  }
}

TEST(AllHits, ray_kinds_and_movements_are_those_of_closest_hits) {
  Instances instances;
  instances.add(Shape{Sphere{1}});
  instances.add(testing::block({1, 1, 1}).shared(), shifted_by(4, 0, 0));
  instances.add(Shape{Box{{1, 1, 1}}}, shifted_by(8, 0, 0));
  instances.show_to(0, 1);
  instances.show_to(1, 2);
  World world(std::move(instances));
  const Ray<double> ray{{-5, 0.25, 0.125}, {1, 0, 0}};
  const auto count = [&](RayKinds kinds, double time) {
    std::vector<WorldCrossing> found;
    QueryCounts counts;
    world.all_hits({ray, no_instance, time, kinds}, found, counts);
    return found.size();
  };
  EXPECT_EQ(count(1, 0), 4u);
  EXPECT_EQ(count(2, 0), 4u);
  EXPECT_EQ(count(3, 0), 6u);
  world.pose_all([](std::size_t i) { return shifted_by(4.0 * double(i), 0, 0); },
                 [](std::size_t) {
                   return Movement<double>{{0, 4, 0}};
                 });
  EXPECT_EQ(count(3, 0), 6u);
  EXPECT_EQ(count(3, 1), 0u);
  std::vector<WorldCrossing> found;
  QueryCounts counts;
  world.all_hits({{{-5, 4.25, 0.125}, {1, 0, 0}}, no_instance, 1}, found, counts);
  ASSERT_EQ(found.size(), 6u);
  EXPECT_EQ(found[2].t, 8);
  EXPECT_EQ(found[2].normal, Vec3<double>(-1, 0, 0));
  EXPECT_EQ(found[3].t, 10);
  EXPECT_EQ(found[3].normal, Vec3<double>(1, 0, 0));
}

/// The exits of a mesh, by brute force: the last triangle that the ray hits.
TEST(LastExit, is_the_last_of_all_triangles) {
  testing::Random random(3);
  const Scenery scenery;
  const auto shared = scenery.surface.shared();
  const TriangleMesh& mesh = *shared;
  int exits = 0, inside = 0;
  for (int i = 0; i < testing::number_of_cases(5000); ++i) {
    const PosedMesh posed(0, shared, shifted_by(0.5, 0, 0.25));
    Ray<double> ray{2 * random.in_cube(), random.direction()};
    if (i % 3 == 0) ray.t_max = random.uniform(0, 3);
    Scenery one;
    one.bodies = {{Body::mesh, posed.pose.translation}};
    std::vector<TrueHit> all;
    Ray<double> endless = ray;
    endless.t_max = std::numeric_limits<double>::infinity();
    add_true_hits(one, 0, endless, all);
    std::ranges::sort(all, {}, &TrueHit::t);
    std::size_t within = 0;
    while (within < all.size() && all[within].t <= Quad(ray.t_max)) ++within;
    const PartCast exit = cast_last_exit(posed, ray, 0);
    if (within < all.size() && all[within].leaves) {
      ASSERT_EQ(exit.cast.status, Status::inside) << i;
      ++inside;
    } else if (within == 0) {
      ASSERT_EQ(exit.cast.status, Status::miss) << i;
    } else {
      ++exits;
      ASSERT_EQ(exit.cast.status, Status::hit) << i;
      const Quad t = all[within - 1].t, base = exit.cast.t_base;
      ASSERT_LE(base + Quad(exit.cast.offset_lo), t) << i;
      ASSERT_GE(base + Quad(exit.cast.offset_hi), t) << i;
      ASSERT_GT(exit.cast.normal.dot(ray.direction), 0);
      ASSERT_LT(exit.part, mesh.size());
    }
  }
  EXPECT_GT(exits, 500);
  EXPECT_GT(inside, 40);
}

}  // namespace
}  // namespace minkray
