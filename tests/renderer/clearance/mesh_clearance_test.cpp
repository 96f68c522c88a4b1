// SPDX-License-Identifier: MIT
// Clearances of meshes: a block as a box shape and as triangles is the same body, and a ring has a
// hole.
#include <gtest/gtest.h>

#include <fstream>

#include "renderer/clearance/clearance.h"
#include "renderer/clearance/clearance_derivative.h"
#include "renderer/verify/referee.h"
#include "tests/renderer/clearance/arm.h"
#include "tests/support/meshes.h"
#include "tests/support/random.h"

namespace minkray {
namespace {

using testing::RandomPath;

Shape box(const Vec3<double>& half) {
  return Box{half};
}

/// The arm with a block in its hand and blocks around it, as shapes or as meshes.
struct Blocks {
  Model model = testing::arm_model();
  Scene around;

  Blocks(bool are_meshes, std::mt19937 engine) {
    const Vec3<double> in_hand(0.1, 0.05, 0.15);
    ModelGeom& hand = model.geoms[3];
    const auto become = [&](auto& body, const Vec3<double>& half) {
      body.shape = box(half);
      if (!are_meshes) return;
      body.shape = {};
      body.mesh = testing::block(half).shared();
    };
    become(hand, in_hand);
    hand.pose.linear = rotation_matrix(0.3, 0.2, 0.1, 1.0);
    std::uniform_real_distribution<double> at(-2, 2), size(0.1, 0.4), part(-1, 1);
    for (int i = 0; i < 3; ++i) {
      Object object;
      object.name = "block";
      const Vec3<double> half(size(engine), size(engine), size(engine));
      if (are_meshes)
        object.mesh = testing::block(half).shared();
      else
        object.shape = box(half);
      object.pose = {rotation_matrix(part(engine), part(engine), part(engine), part(engine)),
                     {at(engine), at(engine), at(engine)}};
      object.pose.linear *= 0.7;  // scaling becomes part of the mesh
      around.objects.push_back(object);
    }
    Object plane;
    plane.name = "ground";
    plane.half_space = HalfSpaceBody<double>{{0, 0, 1}, -2.5};
    around.objects.push_back(plane);
  }

  std::vector<ClearanceBody> bodies() const {
    std::vector<ClearanceBody> all = bodies_of(model, GeometryChoice::collision);
    for (const ClearanceBody& body : bodies_of(around)) all.push_back(body);
    return all;
  }
};

TEST(MeshClearance, is_that_of_the_same_shape_where_nothing_overlaps) {
  std::mt19937 engine(5);
  int clear = 0, colliding = 0;
  for (int k = 0; k < 40; ++k) {
    const RandomPath random(engine);
    const Blocks shapes(false, engine), meshes(true, engine);
    engine();
    const std::vector<ClearanceBody> a = shapes.bodies(), b = meshes.bodies();
    const std::vector<BodyPair> pairs = pairs_of(a, shapes.model, {}, true);
    const JointPath path(shapes.model, random.rows);
    const Clearance of_shapes = clearance_of(path, a, pairs, {}),
                    of_meshes = clearance_of(path, b, pairs, {});
    ASSERT_TRUE(of_meshes.closest.is_settled) << k;
    const double upper = of_shapes.closest.upper, lower = of_shapes.closest.lower;
    if (lower > 0) {
      // Both intervals hold the least distance.
      ASSERT_LE(of_meshes.closest.lower, upper) << k;
      ASSERT_GE(of_meshes.closest.upper, lower) << k;
      ASSERT_LE(of_meshes.closest.upper - of_meshes.closest.lower, 0.0101 * upper + 1e-6) << k;
      ++clear;
    } else if (upper < -1e-6 && !b[of_shapes.closest.a].plane && !b[of_shapes.closest.b].plane) {
      ASSERT_LE(of_meshes.closest.upper, 1e-9) << k;
      ++colliding;
    }
  }
  EXPECT_GT(clear, 8);
  EXPECT_GT(colliding, 5);
}

TEST(MeshClearance, derivatives_are_those_of_the_same_shape) {
  std::mt19937 engine(9);
  int compared = 0;
  for (int k = 0; k < 40; ++k) {
    RandomPath random(engine);
    random.rows.resize(1);
    const Blocks shapes(false, engine), meshes(true, engine);
    engine();
    const std::vector<ClearanceBody> a = shapes.bodies(), b = meshes.bodies();
    const std::vector<BodyPair> pairs = pairs_of(a, shapes.model, {}, true);
    const JointPath path(shapes.model, random.rows);
    const Clearance of_shapes = clearance_of(path, a, pairs, {}),
                    of_meshes = clearance_of(path, b, pairs, {});
    if (!(of_shapes.closest.lower > 0)) continue;
    ASSERT_NEAR(of_meshes.closest.upper, of_shapes.closest.upper, 1e-9) << k;
    const JointWidths joints = {{"shoulder", 1}, {"elbow", 1}, {"wrist", 1}};
    const ClearanceDerivative expected = derivative_of(of_shapes.closest, path, a, pairs, joints),
                              found = derivative_of(of_meshes.closest, path, b, pairs, joints);
    if (expected.is_ridge || found.is_ridge) continue;
    ++compared;
    for (std::size_t i = 0; i < 3; ++i)
      ASSERT_NEAR(found.by_joints[i], expected.by_joints[i], 1e-6) << k;
  }
  EXPECT_GT(compared, 5);
}

/// A ring of radius 1 about z with a tube of 0.4: the arm is in its hole.
Scene ring_around() {
  Object ring;
  ring.name = "ring";
  ring.mesh = testing::torus(48, 24).shared();
  Scene around;
  around.objects = {ring};
  return around;
}

TEST(MeshClearance, a_rod_goes_through_a_ring_whose_hull_it_crosses) {
  const Model model = testing::arm_model();
  const Scene around = ring_around();
  const Object& ring = around.objects[0];
  std::vector<ClearanceBody> bodies = bodies_of(model, GeometryChoice::collision);
  bodies.push_back(bodies_of(around)[0]);
  const JointPath path(model, {{0, {{"shoulder", {0.0}}}}, {1, {{"shoulder", {0.2}}}}});
  const auto least = [&](const std::vector<ClearanceBody>& all) {
    return clearance_of(path, all, pairs_of(all, model, {}, false), {}).closest;
  };
  const Closest found = least(bodies);
  EXPECT_GT(found.lower, 0.1);
  EXPECT_TRUE(found.is_settled);
  bodies.back() = bodies_of(around)[0];
  bodies.back().mesh = nullptr;
  bodies.back().shape = ContactShape(
      Shape(Hull{PointCloud({ring.mesh->vertices().begin(), ring.mesh->vertices().end()})}));
  bodies.back().middle = placed_middle(bodies.back().shape, {});
  EXPECT_LT(least(bodies).upper, 0);
}

/// No plane is between the arm and the ring around it; the arm's speed proves that they stay
/// apart.
TEST(MeshClearance, verdicts_see_what_no_plane_separates) {
  const Model model = testing::arm_model();
  const Scene around = ring_around();
  std::vector<ClearanceBody> bodies = bodies_of(model, GeometryChoice::collision);
  bodies.push_back(bodies_of(around)[0]);
  std::vector<RefereePair> pairs;
  for (const BodyPair& pair : pairs_of(bodies, model, {}, false))
    pairs.push_back({pair.a, pair.b, 0});
  RefereeOptions options;
  options.keep_planes = true;
  const auto verdict = [&](double last) {
    const JointPath path(model, {{0, {{"shoulder", {0.0}}}}, {1, {{"shoulder", {last}}}}});
    const MotionVerdict found = verdict_of(path, bodies, pairs, options);
    const Closest least = [&] {
      std::vector<BodyPair> plain;
      for (const RefereePair& pair : pairs) plain.push_back({pair.a, pair.b});
      return clearance_of(path, bodies, plain, {}).closest;
    }();
    if (found.status == MotionStatus::free) {
      EXPECT_LE(found.least.lower, least.upper);
      EXPECT_GE(found.least.upper, least.lower);
      EXPECT_GT(found.least.lower, 0.98 * least.lower - 1e-6);
    }
    return found;
  };
  const MotionVerdict free = verdict(0.2);
  EXPECT_EQ(free.status, MotionStatus::free);
  EXPECT_FALSE(free.without_planes.empty());
  const MotionVerdict collides = verdict(1.5);
  ASSERT_EQ(collides.status, MotionStatus::collides);
  // One of each link that reaches the ring.
  ASSERT_EQ(collides.stretches.size(), 2u);
  EXPECT_GT(collides.stretches[0].begin, 0.2);
  EXPECT_GT(collides.stretches[0].time, collides.stretches[0].begin);
}

/// In MJCF a mesh touches as its hull, and a ring of another format as it is.
TEST(MeshClearance, meshes_of_mjcf_touch_as_hulls) {
  const TemporaryFolder folder;
  const testing::Surface torus = testing::torus(24, 12);
  std::ofstream obj(folder / "ring.obj");
  for (const Vec3<double>& v : torus.vertices)
    obj << "v " << v.x() << " " << v.y() << " " << v.z() << "\n";
  for (const Corners& t : torus.triangles)
    obj << "f " << t[0] + 1 << " " << t[1] + 1 << " " << t[2] + 1 << "\n";
  obj.close();
  const std::string text = R"(<mujoco><asset><mesh name="ring" file="ring.obj"/></asset><worldbody>
    <geom type="mesh" mesh="ring"/></worldbody></mujoco>)";
  std::ofstream(folder / "ring.xml") << text;
  ImportOptions options;
  for (const MeshChoice choice : {MeshChoice::of_format, MeshChoice::exact, MeshChoice::hull}) {
    options.meshes = choice;
    const Imported imported = import_scene(folder / "ring.xml", options);
    const std::vector<ClearanceBody> bodies = bodies_of(*imported.model, GeometryChoice::all);
    ASSERT_EQ(bodies.size(), 1u);
    EXPECT_EQ(bodies[0].mesh != nullptr, choice == MeshChoice::exact);
    EXPECT_EQ(imported.scene.objects[0].mesh != nullptr, choice != MeshChoice::hull);
  }
}

}  // namespace
}  // namespace minkray
