// SPDX-License-Identifier: MIT
// Meshes through the public headers.
#include <gtest/gtest.h>
#include <minkray/minkray.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "tests/renderer/library/errors.h"

namespace {

namespace mk = minkray;

/// A box without its lid: five sides of two triangles.
mk::Shape open_box() {
  const std::vector<mk::Vec3> vertices = {{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {1, 1, 0},
                                          {-1, -1, 1}, {1, -1, 1}, {-1, 1, 1}, {1, 1, 1}};
  const std::vector<std::array<std::uint32_t, 3>> triangles = {
      {0, 2, 3}, {0, 3, 1}, {0, 1, 5}, {0, 5, 4}, {2, 6, 7},
      {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mk::mesh(vertices, triangles);
}

TEST(LibraryMesh, is_met_as_it_is) {
  const mk::Shape box = open_box();
  EXPECT_STREQ(box.kind(), "mesh");
  const mk::MeshInfo info = mk::mesh_info(box);
  EXPECT_EQ(info.triangles, 10u);
  EXPECT_EQ(info.open_edges, 4u);
  EXPECT_EQ(box.bounds().upper.z, 1);
  // Into the open box, onto its floor, where its hull would have been met at the lid.
  const mk::Hit floor = mk::cast(box, {{0.3, 0.2, 5}, {0, 0, -1}});
  ASSERT_EQ(floor.status, mk::hit);
  EXPECT_EQ(floor.t, 5);
  EXPECT_EQ(floor.normal.z, 1);
  EXPECT_LT(floor.part, 2);
  EXPECT_GE(floor.part, 0);
  EXPECT_LE(floor.t_lo, 5);
  EXPECT_GE(floor.t_hi, 5);
  EXPECT_EQ(mk::cast(box, {{0.3, 0.2, -5}, {0, 0, 1}}).normal.z, -1);  // from below
  const mk::Hit raised = mk::cast(box, {{0.3, 0.2, 5}, {0, 0, -1}}, mk::translation({0, 0, 2}));
  EXPECT_EQ(raised.t, 3);
  EXPECT_EQ(mk::cast(mk::sphere(1), {{0, 0, 5}, {0, 0, -1}}).part, -1);
}

TEST(LibraryMesh, stands_in_scenes_whose_rays_are_proven) {
  mk::Scene scene;
  const std::uint32_t first = scene.add(open_box(), {}, "box");
  scene.add(mk::sphere(0.25), mk::translation({0, 0, 0.5}), "ball");
  const std::uint32_t far = scene.add(open_box(), mk::translation({6, 0, 0}), "other");
  scene.commit();
  std::vector<mk::Ray> rays;
  for (int i = 0; i < 400; ++i)
    rays.push_back({{-9, 0.01 * i - 2, 3}, {1, 0.001 * (i % 7), -0.3 - 0.001 * (i % 11)}});
  std::vector<mk::Hit> hits(rays.size());
  scene.cast(rays, hits);
  int proven = 0, of_mesh = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_EQ(scene.cast(rays[i]).t, hits[i].t);
    EXPECT_EQ(scene.cast(rays[i]).part, hits[i].part);
    EXPECT_EQ(scene.occluded(rays[i]), hits[i].found() ? mk::hit : mk::miss);
    of_mesh += hits[i].part >= 0 ? 1 : 0;
    const mk::Proof proof = scene.prove(rays[i], hits[i]);
    proven += proof.holds ? 1 : 0;
    mk::Hit lie = hits[i];
    if (!lie.found()) continue;
    lie.t_base += 1e-3;
    EXPECT_FALSE(scene.prove(rays[i], lie).holds);
  }
  EXPECT_EQ(proven, 400);
  EXPECT_GT(of_mesh, 100);
  scene.set_pose(far, mk::translation({0, 0, -3}));
  scene.commit();
  EXPECT_EQ(scene.cast({{0.9, 0, 9}, {0, 0, -1}}).object, first);
  scene.remove(first);
  scene.commit();
  EXPECT_EQ(scene.cast({{0.9, 0, 9}, {0, 0, -1}}).object, far);
  EXPECT_EQ(scene.cast({{0.9, 0, 9}, {0, 0, -1}}).t, 12);
}

TEST(LibraryMesh, tells_programs_no_more_than_their_structs_have_room_for) {
  mk::Scene scene;
  scene.add(open_box());
  scene.commit();
  const double origin[3] = {0.3, 0.2, 5}, direction[3] = {0, 0, -1};
  minkray_ray_arrays rays = {};
  rays.size = sizeof rays;
  rays.origins = origin;
  rays.directions = direction;
  double t = 0;
  std::int32_t part = 77;
  minkray_hit_arrays hits = {};
  hits.t = &t;
  hits.parts = &part;
  hits.size = offsetof(minkray_hit_arrays, parts);  // as it was before there were meshes
  ASSERT_EQ(minkray_scene_cast_arrays(scene.handle(), &rays, 1, &hits, nullptr), MINKRAY_OK);
  EXPECT_EQ(t, 5);
  EXPECT_EQ(part, 77);
  hits.size = sizeof hits;
  ASSERT_EQ(minkray_scene_cast_arrays(scene.handle(), &rays, 1, &hits, nullptr), MINKRAY_OK);
  EXPECT_LT(part, 2);
  minkray_file_options options = {};
  options.meshes = "neither";
  options.size = offsetof(minkray_file_options, meshes);
  const auto message = [&] {
    minkray_scene_add_file(scene.handle(), "none.urdf", &options, nullptr);
    return std::string(minkray_last_error());
  };
  EXPECT_FALSE(has(message(), "options.meshes"));
  options.size = sizeof options;
  EXPECT_TRUE(has(message(), "options.meshes: must be \"hull\" or \"exact\" (got \"neither\")"));
}

TEST(LibraryMesh, has_distances_to_its_surface) {
  const mk::Shape box = open_box(), ball = mk::sphere(0.25);
  // Within the open box, where the hull would be overlapped.
  const mk::Distance inside = mk::signed_distance(box, {}, ball, mk::translation({0.5, 0, 0.6}));
  EXPECT_EQ(inside.status, mk::separated);
  EXPECT_NEAR(inside.value, 0.25, 1e-12);
  EXPECT_LE(inside.lower, inside.value);
  EXPECT_NEAR(inside.point_a.x, 1, 1e-12);
  const mk::Distance crossing = mk::signed_distance(ball, mk::translation({1, 0, 0.6}), box, {});
  EXPECT_EQ(crossing.status, mk::overlapping);
  EXPECT_EQ(crossing.value, 0);
  // A pose that scales is part of the mesh.
  mk::Pose twice;
  for (int i = 0; i < 3; ++i) twice.rows[i][i] = 2;
  EXPECT_NEAR(mk::signed_distance(box, twice, ball, mk::translation({1.5, 0, 1})).value, 0.25,
              1e-12);
  mk::Twist down;
  down.velocity = {0, 0, -1};
  const mk::Impact lands =
      mk::time_of_impact(ball, mk::translation({0, 0, 3}), down, box, {}, {}, 9);
  EXPECT_EQ(lands.status, mk::impact);
  EXPECT_NEAR(lands.t_hi, 2.75, 1e-9);

  mk::Scene scene;
  scene.add(box, {}, "box");
  scene.add(ball, mk::translation({0.5, 0, 0.6}), "ball");
  scene.add(box, mk::translation({5, 0, 0}), "other");
  scene.add_half_space({0, 0, 1}, -0.5, "floor");
  scene.commit();
  const mk::ScenePairs pairs = scene.distances(0.3);
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_NEAR(pairs[0].distance.value, 0.25, 1e-12);
  EXPECT_EQ(scene.distances(0.6).size(), 3u);  // and both boxes above the floor
  const mk::ScenePairs near = scene.nearest(std::vector<mk::Vec3>{{3, 0, 0.5}}, 2);
  ASSERT_EQ(near.size(), 2u);
  EXPECT_NEAR(near[0].distance.value, 1, 1e-12);
  EXPECT_EQ(near[0].object_b, 2u);
  EXPECT_NEAR(scene.distance_to(ball, mk::translation({0, 0, 1.5})).distance.value, 0.4, 0.2);
  EXPECT_GE(scene.manifold(0, 1).count, 1);
}

TEST(LibraryMesh, in_batches_with_shapes_as_alone) {
  const mk::Shape box = open_box(), ball = mk::sphere(0.25), rod = mk::cylinder(0.2, 0.9);
  const std::vector<mk::Shape> a = {box, ball, box, ball, rod, box},
                               b = {rod, rod, box, box, ball, ball};
  std::vector<mk::Pose> at_a, at_b;
  for (int i = 0; i < 6; ++i) {
    at_a.push_back(mk::pose({0.1 * i, 0, 0}, mk::Quaternion{1, 0.2 * i, 0, 0.1}));
    at_b.push_back(mk::pose({2, 0.3 * i, 1}, mk::Quaternion{1, 0, 0.3 * i, 0.2}));
  }
  mk::PairOptions options;
  options.how.threads = 1;
  std::vector<mk::Distance> distances(a.size());
  mk::signed_distances({a, at_a, {}}, {b, at_b, {}}, distances, options);
  std::vector<mk::Impact> impacts(a.size());
  const mk::Twist left{{-1, 0, 0}, {0, 0.2, 0}};
  const double t_max = 5;
  mk::times_of_impact({a, at_a, {}}, {b, at_b, {&left, 1}}, {&t_max, 1}, impacts, options);
  std::vector<mk::Manifold> manifolds(a.size());
  mk::manifolds({a, at_a, {}}, {b, at_b, {}}, manifolds, options);
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double alone = mk::signed_distance(a[i], at_a[i], b[i], at_b[i]).value;
    EXPECT_EQ(distances[i].value, alone) << i;
    EXPECT_NEAR(manifolds[i].value, alone, 1e-9) << i;
    EXPECT_EQ(impacts[i].t_hi,
              mk::time_of_impact(a[i], at_a[i], {}, b[i], at_b[i], left, t_max).t_hi)
        << i;
  }
}

TEST(LibraryMesh, touches_along_a_plane_without_a_search_for_each_triangle) {
  const std::vector<double> heights(81 * 81, 0.0);
  const double bottom = -1;
  const mk::Shape ground = mk::height_field(heights, 81, 81, 2, 2, &bottom);
  const mk::Distance rests =
      mk::signed_distance(ground, {}, mk::box({0.9, 0.9, 0.5}), mk::translation({0.01, 0.02, 0.5}));
  EXPECT_EQ(rests.status, mk::touching);
  EXPECT_LT(rests.upper, 1e-12);
  EXPECT_LT(rests.supports, 1000);  // about 10,000 triangles are below the box
}

TEST(LibraryMesh, is_refused_where_a_shape_must_be_convex_and_wrong_ones_are) {
  const mk::Shape box = open_box();
  EXPECT_TRUE(has(error_of([&] { mk::rounded(box, 0.1); }), "must be convex (got a mesh)"));
  EXPECT_TRUE(has(error_of([&] { box.support({1, 0, 0}); }), "must be convex"));
  EXPECT_TRUE(has(error_of([&] { mk::mesh_info(mk::sphere(1)); }), "must be a mesh"));
  const std::vector<mk::Vec3> few = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_TRUE(has(error_of([&] {
                    mk::mesh(few, {0, 1, 3});
                  }),
                  "triangles[0]: must be numbers of vertices, less than 3 (got 3)"));
  EXPECT_TRUE(has(error_of([&] { mk::mesh(few, {0, 1}); }), "must be three numbers each"));
  const std::vector<mk::Vec3> wrong = {{0, 0, 0}, {1, std::nan(""), 0}, {0, 1, 0}};
  EXPECT_TRUE(has(error_of([&] { mk::mesh(wrong, {0, 1, 2}); }), "vertices[1]: must be finite"));
}

}  // namespace
