// SPDX-License-Identifier: MIT
#include "core/parts/parts_distance.h"

#include <gtest/gtest.h>

#include "core/mesh/mapped.h"
#include "core/mesh/mesh_ray.h"
#include "core/parts/parts_contact.h"
#include "core/parts/parts_impact.h"
#include "core/parts/parts_reach.h"
#include "core/world/near_pairs.h"
#include "core/world/world_impact.h"
#include "tests/support/meshes.h"
#include "tests/support/number_of_cases.h"
#include "tests/support/random.h"

namespace minkray {
namespace {

using MeshPointer = std::shared_ptr<const TriangleMesh>;

Affine<double> pose_of_pair(testing::Random& random, double reach) {
  return {random.rotation(), reach * random.in_cube()};
}

ContactShape triangle(const TriangleMesh& mesh, std::uint32_t i) {
  return ContactShape(Shape(Triangle{{mesh.corner(i, 0), mesh.corner(i, 1), mesh.corner(i, 2)}}));
}

/// The least of all pairs of parts, each computed by itself; no depth.
SignedDistance least_of_all(const std::vector<ContactShape>& a, const Affine<double>& pose_a,
                            const std::vector<ContactShape>& b, const Affine<double>& pose_b) {
  SignedDistance least;
  for (const ContactShape& of_a : a)
    for (const ContactShape& of_b : b) {
      SignedDistanceOptions how;
      how.at_most = least.upper;
      const SignedDistance found = signed_distance(of_a, pose_a, of_b, pose_b, how);
      if (found.upper < least.upper) least = found;
    }
  return least;
}

std::vector<ContactShape> parts(const TriangleMesh& mesh) {
  std::vector<ContactShape> parts;
  for (std::uint32_t i = 0; i < mesh.size(); ++i) parts.push_back(triangle(mesh, i));
  return parts;
}

TEST(MeshPairs, have_the_least_distance_of_all_their_parts) {
  const MeshPointer ring = testing::torus(14, 9).shared(),
                    ball = testing::bumpy_ball(7, 9).shared();
  const std::vector<ContactShape> of_ring = parts(*ring), of_ball = parts(*ball);
  const std::vector<ContactShape> shapes = {
      ContactShape(Shape(Box{{0.2, 0.3, 0.1}})), ContactShape(Shape(Sphere{0.15})),
      ContactShape(Shape(Cone{0.2, 0.2})),
      ContactShape(Shape(Rounded{0.05, Shape(Box{{0.2, 0.2, 0.1}})}))};
  testing::Random random(1);
  int apart = 0, crossing = 0, within = 0;
  for (int i = 0; i < testing::number_of_cases(120); ++i) {
    const Affine<double> at_ring = pose_of_pair(random, 0.2), at_other = pose_of_pair(random, 1.7);
    const bool with_mesh = i % 4 == 3;
    const ContactShape& shape = shapes[static_cast<std::size_t>(i / 4) % shapes.size()];
    const PartsBody other = with_mesh ? PartsBody(*ball) : PartsBody(shape);
    const std::vector<ContactShape> of_other = with_mesh ? of_ball : std::vector{shape};
    PartPair pair;
    const SignedDistance found = signed_distance(*ring, at_ring, other, at_other, {}, &pair);
    const SignedDistance truth = least_of_all(of_ring, at_ring, of_other, at_other);
    ASSERT_NE(found.status, SignedStatus::undecided);
    // The other way round it is the same.
    const SignedDistance turned = signed_distance(other, at_other, *ring, at_ring);
    ASSERT_EQ(turned.status, found.status);
    if (truth.upper < 0) {
      ++crossing;
      ASSERT_EQ(found.status, SignedStatus::overlapping) << i;
      ASSERT_EQ(found.value, 0);
      ASSERT_NE(pair.a, no_part);
      ASSERT_EQ(pair.b != no_part, with_mesh);
      const SignedDistance of_pair = signed_distance(
          triangle(*ring, pair.a), at_ring, with_mesh ? triangle(*ball, pair.b) : shape, at_other);
      ASSERT_LT(of_pair.upper, 0);
      continue;
    }
    if (found.status == SignedStatus::overlapping) {
      // One within the other: the nearest point of a shape's surface is inside of the ring.
      ++within;
      const Vec3<double> point =
          at_ring.linear.transpose() * (at_other.translation - at_ring.translation);
      const double r = std::hypot(std::hypot(point.x(), point.y()) - 1, point.z());
      ASSERT_LT(r, 0.5);
      continue;
    }
    ++apart;
    ASSERT_LE(found.lower, truth.upper);
    ASSERT_GE(found.upper, truth.lower);
    ASSERT_LE(found.upper - found.lower, 1e-9);
    ASSERT_NEAR(turned.value, found.value, 1e-12);
    const double aside = std::sqrt(2 * found.value * (found.upper - found.lower));
    ASSERT_LE((found.point_b - found.point_a - found.value * found.normal).norm(), aside + 1e-12);
    SignedDistanceOptions near;
    near.at_most = found.value / 2;
    const SignedDistance beyond = signed_distance(*ring, at_ring, other, at_other, near);
    ASSERT_GE(beyond.lower, near.at_most);
    ASSERT_LE(beyond.lower, found.upper);
  }
  EXPECT_GT(apart, 30);
  EXPECT_GT(crossing, 10);
}

/// Boxes of floats are thicker than such meshes.
TEST(MeshPairs, of_the_least_sizes_have_bounds_that_hold) {
  const testing::Surface ring = testing::torus(14, 9), ball = testing::bumpy_ball(7, 9);
  testing::Random random(21);
  for (const int exponent : {-190, -210, -240})
    for (int i = 0; i < 20; ++i) {
      const auto shrunk = [&](testing::Surface surface) {
        for (Vec3<double>& v : surface.vertices) v *= std::ldexp(1.0, exponent);
        return surface.shared();
      };
      const Affine<double> pose{random.rotation(), 1.7 * random.in_cube()};
      Affine<double> small = pose;
      small.translation *= std::ldexp(1.0, exponent);
      const SignedDistance expected = signed_distance(*ring.shared(), {}, *ball.shared(), pose);
      const SignedDistance found = signed_distance(*shrunk(ring), {}, *shrunk(ball), small);
      const double scale = std::ldexp(1.0, -exponent);
      ASSERT_LE(found.lower * scale, expected.upper + 1e-12) << exponent << " " << i;
      ASSERT_GE(found.upper * scale, expected.lower - 1e-12) << exponent << " " << i;
    }
}

TEST(MeshPairs, what_is_within_a_closed_mesh_overlaps_it_and_in_a_hole_does_not) {
  const MeshPointer ring = testing::torus(40, 24).shared();
  const ContactShape ball{Shape(Sphere{0.1})};
  const auto at = [](double x) {
    Affine<double> pose;
    pose.translation.x() = x;
    return pose;
  };
  const SignedDistance in_hole = signed_distance(*ring, {}, ball, at(0));
  EXPECT_EQ(in_hole.status, SignedStatus::separated);
  EXPECT_NEAR(in_hole.value, 0.5, 0.02);
  EXPECT_EQ(signed_distance(*ring, {}, ball, at(1)).status, SignedStatus::overlapping);
  EXPECT_EQ(signed_distance(*ring, {}, ball, at(0.6)).status, SignedStatus::overlapping);
  // An open mesh holds nothing.
  testing::Surface open = testing::torus(40, 24);
  open.triangles.pop_back();
  EXPECT_EQ(signed_distance(*open.shared(), {}, ball, at(1)).status, SignedStatus::separated);
  EXPECT_EQ(contact_manifold(*ring, {}, ball, at(1)).count, 0);
  EXPECT_TRUE(derivative_of(*ring, {}, ball, at(1)).is_ridge);
  // A small ring within a large ball.
  const MeshPointer large = testing::bumpy_ball(20, 30).shared();
  const MeshPointer small =
      mapped(*ring, Affine<double>{0.1 * Mat3<double>::Identity(), Vec3<double>::Zero()});
  EXPECT_EQ(signed_distance(*large, {}, *small, {}).status, SignedStatus::overlapping);
  EXPECT_EQ(signed_distance(*small, {}, *large, {}).status, SignedStatus::overlapping);
}

TEST(MeshPairs, overlap_though_edges_lie_on_edges) {
  const MeshPointer cube = testing::block({1, 1, 1}).shared();
  const auto status = [&](const PartsBody& other, const Vec3<double>& at) {
    const Affine<double> pose{Mat3<double>::Identity(), at};
    const SignedDistance found = signed_distance(*cube, {}, other, pose);
    EXPECT_EQ(signed_distance(other, pose, *cube, {}).status, found.status);
    EXPECT_EQ(found.value, 0);
    return found.status;
  };
  for (const Vec3<double>& at :
       {Vec3<double>(0, 0, 0), Vec3<double>(0.5, 0, 0), Vec3<double>(1, 0, 0),
        Vec3<double>(1.5, 0, 0), Vec3<double>(0.5, 0.5, 0), Vec3<double>(1, 1, 1)})
    EXPECT_EQ(status(*cube, at), SignedStatus::overlapping) << at.transpose();
  for (const Vec3<double>& at :
       {Vec3<double>(2, 0, 0), Vec3<double>(2, 1, 0.5), Vec3<double>(2, 2, 2)})
    EXPECT_NE(status(*cube, at), SignedStatus::overlapping) << at.transpose();
  // Through the middle of a face, where its diagonal is; and in the face.
  const ContactShape into{Shape(Segment{{Vec3<double>(-1, 0, 0), Vec3<double>(1, 0, 0)}})};
  EXPECT_EQ(status(into, {1.5, 0, 0}), SignedStatus::overlapping);
  EXPECT_NE(status(into, {2, 0, 0}), SignedStatus::overlapping);
  const ContactShape along{Shape(Segment{{Vec3<double>(0, 0, 0), Vec3<double>(0, 0.5, 0)}})};
  EXPECT_NE(status(along, {1, 0, 0}), SignedStatus::overlapping);
}

/// Largest distance of the corners (+-x, +-y) from the nearest contact point of B.
double furthest_corner(const ContactManifold& contact, double x, double y) {
  double most = 0;
  for (const double sx : {-x, x})
    for (const double sy : {-y, y}) {
      double least = 1e9;
      for (int i = 0; i < contact.count; ++i)
        least = std::min(least, (contact.points[static_cast<std::size_t>(i)].point_b.head<2>() -
                                 Eigen::Vector2d(sx, sy))
                                    .norm());
      most = std::max(most, least);
    }
  return most;
}

/// A flat square of side 8 with cells x cells squares.
MeshPointer flat_grid(std::uint32_t cells) {
  testing::Surface grid;
  const std::uint32_t across = cells + 1;
  for (std::uint32_t i = 0; i < across; ++i)
    for (std::uint32_t j = 0; j < across; ++j)
      grid.vertices.emplace_back(8.0 * i / cells - 4, 8.0 * j / cells - 4, 0);
  testing::add_squares(grid, across, across, false);
  std::erase_if(grid.triangles, [across](const Corners& t) {  // those that join both ends of a row
    return std::ranges::max(t) - std::ranges::min(t) > across + 1 || t[0] % across == across - 1;
  });
  return grid.shared();
}

// More parts are near than are tried; the outermost are among those.
TEST(MeshPairs, of_fine_meshes_rest_on_their_corners) {
  const MeshPointer flat = flat_grid(128);
  const ContactShape box{Shape(Box{{1.5, 1.5, 0.5}})};
  Affine<double> aside, on_top;
  aside.translation = {-0.1, -0.05, 0};
  for (const double above : {0.001, -0.001}) {
    on_top.translation = {0, 0, 0.5 + above};
    const ContactManifold contact = contact_manifold(*flat, aside, box, on_top);
    ASSERT_EQ(contact.count, 4);
    constexpr double cell = 8.0 / 128;
    EXPECT_LT(furthest_corner(contact, 1.5, 1.5), cell);
  }
}

TEST(MeshPairs, rest_on_as_many_points_as_convex_bodies) {
  // A box of 3 x 3 on a flat grid of 8 x 8 cells, touching, above and in it.
  const MeshPointer flat = flat_grid(8);
  const ContactShape box{Shape(Box{{1.5, 1.5, 0.5}})};
  const auto at = [](double x, double y, double z) {
    Affine<double> pose;
    pose.translation = {x, y, z};
    return pose;
  };
  for (const double above : {0.0, 0.001, -0.001})
    for (const double aside : {0.0, 0.1}) {
      const ContactManifold contact =
          contact_manifold(*flat, at(-aside, -aside / 2, 0), box, at(0, 0, 0.5 + above));
      ASSERT_EQ(contact.count, 4) << above;
      EXPECT_NEAR(contact.normal.z(), 1, 1e-12);
      EXPECT_LT(furthest_corner(contact, 1.5, 1.5), 1e-9) << above << " " << aside;
      for (const ContactPoint& point : contact.points) {
        EXPECT_NEAR(point.distance, above, 1e-12);
        EXPECT_NEAR((point.point_b - point.point_a - point.distance * contact.normal).norm(), 0,
                    1e-12);
        EXPECT_NEAR(point.point_a.z(), 0, 1e-12);
      }
      const ContactManifold turned =
          contact_manifold(box, at(0, 0, 0.5 + above), *flat, at(-aside, -aside / 2, 0));
      EXPECT_EQ(turned.count, 4);
      EXPECT_NEAR(turned.normal.z(), -1, 1e-12);
    }
  // A cube of triangles on one, askew, and on a large box.
  const MeshPointer cube = testing::block({1, 1, 1}).shared();
  for (const double above : {0.0, 0.001}) {
    const ContactManifold contact =
        contact_manifold(*cube, at(0.3, 0.2, -2 - above), *cube, at(0, 0, 0));
    ASSERT_EQ(contact.count, 4);
    EXPECT_NEAR(contact.normal.z(), 1, 1e-12);
    Bounds<double> box_of_points;
    for (const ContactPoint& point : contact.points) box_of_points.extend(point.point_b);
    EXPECT_NEAR((box_of_points.lower - Vec3<double>(-0.7, -0.8, -1)).norm(), 0, 1e-9);
    EXPECT_NEAR((box_of_points.upper - Vec3<double>(1, 1, -1)).norm(), 0, 1e-9);
    const ContactShape ground{Shape(Box{{9, 9, 1}})};
    const ContactManifold on_ground =
        contact_manifold(ground, at(0, 0, -2 - above), *cube, at(0, 0, 0));
    ASSERT_EQ(on_ground.count, 4);
    EXPECT_LT(furthest_corner(on_ground, 1, 1), 1e-9);
  }
  // A ball rests on one point, a tilted box on an edge.
  const ContactShape ball{Shape(Sphere{0.5})};
  EXPECT_EQ(contact_manifold(*flat, {}, ball, at(0.3, 0.2, 0.5)).count, 1);
  Affine<double> tilted = at(0, 0, 0.001 + 0.5 * std::cos(0.3) + 1.5 * std::sin(0.3));
  tilted.linear = rotation_matrix<double>(0, std::sin(0.15), 0, std::cos(0.15));
  EXPECT_EQ(contact_manifold(*flat, {}, box, tilted).count, 2);
}

/// The difference of such poses is not a number; float lanes then took triangles that leaves do not
/// have, and the program ended.
TEST(MeshPairs, beyond_the_largest_numbers_are_not_decided) {
  const MeshPointer ball = testing::bumpy_ball(7, 9).shared();
  const ContactShape box{Shape(Box{{0.2, 0.2, 0.1}})};
  for (const double x : {1e155, 1e300, 1.7e308})
    for (const PartsBody& other : {PartsBody(*ball), PartsBody(box)}) {
      testing::Random random(5);
      const Affine<double> far{random.rotation(), {x, -x, x}},
          other_side{random.rotation(), {-x, x, x}};
      const SignedDistance found = signed_distance(*ball, far, other, other_side);
      EXPECT_NE(found.status, SignedStatus::overlapping) << x;
      EXPECT_TRUE(found.status != SignedStatus::separated || found.lower > x) << x;
      const Impact impact =
          first_impact(*ball, {far, {-x, 0, 0}}, other, {other_side, {x, 0, 0}}, 1);
      EXPECT_NE(impact.status, ImpactStatus::inside) << x;
    }
  EXPECT_FALSE(is_within(*ball, Vec3<double>::Constant(std::nan(""))));
}

/// A ball above a valley: projected on one slope's normal, the other slope's nearest points were
/// 1.3e-4 nearer than the nearest.
TEST(MeshPairs, have_no_contact_point_nearer_than_the_nearest) {
  const double slope = 0.008, radius = 0.25, height = 1.25, aside = 0.002;
  testing::Surface valley;
  for (const double x : {-2.0, 0.0, 2.0})
    for (const double y : {-2.0, 2.0}) valley.vertices.emplace_back(x, y, slope * std::abs(x));
  valley.triangles = {{0, 2, 3}, {0, 3, 1}, {2, 4, 5}, {2, 5, 3}};
  const MeshPointer mesh = valley.shared();
  const ContactShape ball{Shape(Sphere{radius})};
  Affine<double> above;
  above.translation = {aside, 0.1, height};
  const double gap = (height - slope * aside) / std::hypot(1, slope) - radius;
  const ContactManifold contact = contact_manifold(*mesh, {}, ball, above);
  ASSERT_GE(contact.count, 1);
  EXPECT_NEAR(contact.points[0].distance, gap, 1e-12);
  for (int i = 0; i < contact.count; ++i) {
    const ContactPoint& point = contact.points[static_cast<std::size_t>(i)];
    EXPECT_GE(point.distance, gap - 1e-12);
    EXPECT_NEAR((point.point_b - point.point_a - point.distance * contact.normal).norm(), 0, 1e-12);
  }
}

TEST(MeshPairs, first_touch_when_a_part_is_first_touched) {
  const MeshPointer ring = testing::torus(12, 8).shared();
  const std::vector<ContactShape> of_ring = parts(*ring);
  const ContactShape box{Shape(Box{{0.2, 0.3, 0.1}})};
  testing::Random random(3);
  int hits = 0, misses = 0;
  for (int i = 0; i < testing::number_of_cases(60); ++i) {
    RigidMotion of_mesh{pose_of_pair(random, 0.3)}, of_box{pose_of_pair(random, 1)};
    of_box.pose.translation = 3 * random.direction();
    of_box.velocity = 0.7 * random.in_cube() - of_box.pose.translation;
    if (i % 2 == 0) {
      of_box.angular_velocity = random.in_cube();
      of_mesh.angular_velocity = random.in_cube();
    }
    Impact truth;
    truth.status = ImpactStatus::miss;
    double first = 1;  ///< before this none is touched
    for (const ContactShape& part : of_ring) {
      const Impact found = first_impact(part, of_mesh, box, of_box, 1);
      ASSERT_NE(found.status, ImpactStatus::undecided);
      if (found.status == ImpactStatus::miss) continue;
      first = std::min(first, found.t_lo);
      if (found.t_hi < truth.t_hi) truth = found;
    }
    PartPair pair;
    const Impact found = first_impact(*ring, of_mesh, box, of_box, 1, {}, &pair);
    ASSERT_EQ(found.status, truth.status) << i;
    if (truth.status == ImpactStatus::miss) {
      ++misses;
      continue;
    }
    ++hits;
    ASSERT_LE(found.t_lo, truth.t_hi);
    // Bodies nearer than ImpactOptions::touching count as touching.
    constexpr double touching = 1e-10;
    ASSERT_GE(found.t_hi, first - touching);
    ASSERT_LE(found.t_hi - found.t_lo, 1e-8);
    const Impact of_pair = first_impact(triangle(*ring, pair.a), of_mesh, box, of_box, 1);
    ASSERT_LE(of_pair.t_lo, found.t_hi + touching);
  }
  EXPECT_GT(hits, 15);
  EXPECT_GT(misses, 3);
}

TEST(MeshPairs, of_many_bodies_are_those_of_each_two) {
  testing::Random random(4);
  const MeshPointer ring = testing::torus(20, 12).shared();
  std::vector<ContactBody> bodies;
  for (int i = 0; i < 30; ++i) {
    bodies.push_back({ContactShape(Shape(Box{{0.3, 0.2, 0.4}})), pose_of_pair(random, 3)});
    if (i % 2 == 0) bodies.back().mesh = ring;
  }
  const ContactWorld world(bodies);
  const double within = 0.5;
  std::size_t expected = 0;
  NearPairsOptions near;
  near.at_most = within;
  const std::vector<NearPair> pairs = near_pairs(world, near);
  for (std::size_t a = 0; a < bodies.size(); ++a)
    for (std::size_t b = a + 1; b < bodies.size(); ++b) {
      const SignedDistance own =
          signed_distance(bodies[a].parts(), bodies[a].pose, bodies[b].parts(), bodies[b].pose);
      expected += own.lower <= within ? 1 : 0;
    }
  EXPECT_EQ(pairs.size(), expected);
  EXPECT_GT(expected, 10u);
  const ContactBody at{ContactShape(Shape(Sphere{0.01})), {}};
  const std::vector<NearPair> nearest = nearest_bodies(at, world, 5);
  ASSERT_EQ(nearest.size(), 5u);
  std::vector<double> all;
  for (const ContactBody& body : bodies)
    all.push_back(signed_distance(at.parts(), at.pose, body.parts(), body.pose).value);
  std::ranges::sort(all);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(nearest[i].distance.value, all[i], 1e-9);
  // The body that moves through them.
  RigidMotion motion{at.pose};
  motion.pose.translation = {-6, 0.3, 0.2};
  motion.velocity = {12, 0, 0};
  const EarliestImpact met = first_impact(at.shape, motion, world, 1, ~0u, nothing_met(1));
  double first = 1;
  for (const ContactBody& body : bodies) {
    const Impact own = first_impact(at.parts(), motion, body.parts(), {body.pose}, 1);
    if (own.status != ImpactStatus::miss) first = std::min(first, own.t_hi);
  }
  EXPECT_NEAR(met.impact.t_hi, first, 1e-9);
}

TEST(MeshPairs, are_above_a_half_space_by_their_lowest_vertex) {
  const MeshPointer block = testing::block({1, 2, 3}).shared();
  const ContactShape box{Shape(Box{{1, 2, 3}})};
  testing::Random random(5);
  for (int i = 0; i < 100; ++i) {
    const Affine<double> pose = pose_of_pair(random, 4);
    const PlacedPlane plane = PlacedPlane::of(random.direction(), 0.3, {});
    const SignedDistance of_mesh = distance_to_half_space(plane, *block, pose),
                         of_box = distance_to_half_space(plane, box, pose);
    ASSERT_EQ(of_mesh.status, of_box.status);
    ASSERT_NEAR(of_mesh.value, of_box.value, 1e-14);
    ASSERT_LE(of_mesh.lower, of_box.upper);
    ASSERT_GE(of_mesh.upper, of_box.lower);
  }
}

TEST(MeshPairs, change_as_central_differences_say) {
  const MeshPointer ring = testing::torus(16, 10).shared();
  const ContactShape box{Shape(Box{{0.2, 0.3, 0.1}})};
  testing::Random random(6);
  int checked = 0;
  for (int i = 0; i < 60; ++i) {
    const Affine<double> at_ring = pose_of_pair(random, 0.3);
    Affine<double> at_box = pose_of_pair(random, 1);
    at_box.translation = 2 * random.direction();
    const PairDerivative derivative = derivative_of(*ring, at_ring, box, at_box);
    if (derivative.is_ridge) continue;
    const Vec3<double> way = random.direction();
    constexpr double step = 1e-5;
    const auto value = [&](double by) {
      Affine<double> moved = at_box;
      moved.translation += by * way;
      return signed_distance(*ring, at_ring, box, moved).value;
    };
    ASSERT_NEAR((value(step) - value(-step)) / (2 * step), derivative.b.by_velocity.dot(way), 1e-6);
    ++checked;
  }
  EXPECT_GT(checked, 20);
}

}  // namespace
}  // namespace minkray
