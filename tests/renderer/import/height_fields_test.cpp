// SPDX-License-Identifier: MIT
// Terrains and planes of robots' files; MJCF's are compared with MuJoCo's rays.
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

#include "renderer/clearance/bodies.h"
#include "renderer/film/render.h"
#include "renderer/io/png.h"
#include "tests/oracle/mujoco_model.h"
#include "tests/renderer/import/imports.h"
#include "tests/support/messages.h"
#include "tests/support/random.h"

namespace minkray {
namespace {

class HeightFields : public ::testing::Test {
 protected:
  HeightFields() {
    testing::Random random(8);
    std::vector<std::uint8_t> rgb;
    for (int i = 0; i < 5 * 4; ++i)
      rgb.insert(rgb.end(), 3, static_cast<std::uint8_t>(random.uniform(0, 255)));
    const std::vector<unsigned char> png = png_of(5, 4, rgb);
    std::ofstream(folder_ / "hills.png", std::ios::binary)
        .write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
    std::string bytes;
    const auto add = [&](const auto& number) {
      bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
    };
    // MuJoCo 2.2.2 takes the heights of walls along y from other rows unless the grid is square.
    add(std::int32_t{5});
    add(std::int32_t{5});
    for (int i = 0; i < 25; ++i) add(static_cast<float>(random.uniform(-3, 5)));
    std::ofstream(folder_ / "hills.bin", std::ios::binary) << bytes;
  }

  TemporaryFolder folder_;
};

const std::string world = R"(<worldbody>
    <geom type="hfield" hfield="h" pos="0.3 -0.2 0.1" euler="10 20 30"/>
    <geom type="plane" size="2 3 0.1" pos="0 0 -1.5" euler="5 0 0"/>
    <geom type="plane" size="0 2 0.1" pos="0 0 -4"/>
    <geom size="0.4" pos="0 0 1.5"/><geom size="0.6" pos="0 0 1.5" rgba="1 0 0 0"/>
  </worldbody>)";

#ifdef MINKRAY_MUJOCO

TEST_F(HeightFields, rays_meet_what_mujocos_rays_meet) {
  const std::string assets[] = {R"(file="hills.bin" size="2 1.5 0.7 0.3")",
                                R"(nrow="3" ncol="4" size="2 1.5 0.7 0.3")"};
  testing::Random random(4);
  for (const std::string& asset : assets) {
    const std::string file = folder_ / "m.xml";
    std::ofstream(file) << "<mujoco><asset><hfield name=\"h\" " + asset + "/></asset>" + world +
                               "</mujoco>";
    std::string why;
    const auto theirs = testing::MujocoModel::load(file, why);
    ASSERT_TRUE(theirs) << why;
    ImportOptions options;
    options.geometry = GeometryChoice::all;
    const Scene scene = import_scene(file, options).scene;
    const World ours = make_world(scene);
    int hits = 0, differ = 0;
    for (int i = 0; i < 5000; ++i) {
      const Vec3<double> from = 6 * random.direction(), to = 2 * random.direction();
      const Ray<double> ray{from, unit<double>(to - from)};
      int geom = -1;
      const double t = theirs->ray(ray, geom);
      QueryCounts counts;
      const WorldHit hit = ours.closest_hit(ray, counts);
      const double our_t = hit.found() ? hit.cast.t() : std::numeric_limits<double>::infinity();
      hits += hit.found() ? 1 : 0;
      // Heights are floats there; a ray may pass the edge of one just so.
      if (!(our_t == t || std::abs(our_t - t) < 1e-5)) ++differ;
    }
    EXPECT_GT(hits, 1500);
    EXPECT_LE(differ, 5) << asset;
  }
}

#endif

TEST_F(HeightFields, of_mjcf_are_pictures_files_or_numbers) {
  const auto mesh_of_asset = [&](const std::string& asset) {
    const std::string file = folder_.write(
        "m.xml", "<mujoco><asset><hfield name=\"h\" " + asset + "/></asset>" + world + "</mujoco>");
    return import_scene(file).scene.objects.at(0).mesh;
  };
  const auto numbers =
      mesh_of_asset(R"(nrow="2" ncol="3" size="1 2 3 0.5" elevation="0 0 10  5 0 0")");
  ASSERT_TRUE(numbers);
  EXPECT_TRUE(numbers->is_closed());
  // Rows are written from the top down: the last one has the least y.
  EXPECT_EQ(numbers->vertices()[0], Vec3<double>(-1, -2, 1.5));
  EXPECT_EQ(numbers->vertices()[5], Vec3<double>(1, 2, 3));
  EXPECT_EQ(numbers->bounds().lower.z(), -0.5);
  const auto picture = mesh_of_asset(R"(file="hills.png" size="1 1 2 0.1")");
  EXPECT_EQ(picture->bounds().upper.z(), 2);
  EXPECT_EQ(mesh_of_asset(R"(file="hills.bin" size="1 1 2 0.1")")->vertices().size(),
            25u + 16u + 1u);
  const auto message = [&](const std::string& asset) {
    return complaint(folder_.write("w.xml", "<mujoco><asset><hfield name=\"h\" " + asset +
                                                "/></asset>" + world + "</mujoco>"));
  };
  expect_messages(message,
                  {{R"(file="gone.png" size="1 1 2 0.1")", "gone.png"},
                   {R"(nrow="2" ncol="3" size="1 1 0 0.1")", "four numbers > 0"},
                   {R"(nrow="2" ncol="3")", "size: missing"},
                   {R"(nrow="2" ncol="2" size="1 1 1 1" elevation="1 2 3")", "elevation"}});
  folder_.write("short.bin", std::string("\x02\0\0\0\x02\0\0\0abc", 11));
  EXPECT_TRUE(has(message(R"(file="short.bin" size="1 1 1 1")"), "a float for each of 2 x 2"));
}

TEST_F(HeightFields, geoms_are_met_by_rays_by_the_alpha_of_their_material_if_they_have_one) {
  const std::string file = folder_.write("a.xml", mjcf(R"(
      <geom name="own" size="1" rgba="1 0 0 0"/>
      <geom name="material" size="1" material="clear"/>
      <geom name="own opaque" size="1" material="clear" rgba="1 0 0 1"/>
      <geom name="own clear" size="1" material="opaque" rgba="1 0 0 0"/>
      <geom name="plain" size="1"/>)",
                                                       R"(<asset>
      <material name="clear" rgba="1 1 1 0"/><material name="opaque" rgba="1 1 1 1"/></asset>)"));
  ImportOptions options;
  options.geometry = GeometryChoice::all;
  const Scene scene = import_scene(file, options).scene;
  ASSERT_EQ(scene.objects.size(), 5u);
  const bool is_met[] = {false, false, false, true, true};  // as mj_ray of MuJoCo
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_EQ(scene.objects[i].visible_to != 0, is_met[i]) << scene.objects[i].name;
}

TEST_F(HeightFields, of_sdf_are_pictures) {
  const std::string file = folder_.write(
      "m.sdf", R"(<sdf version="1.7"><model name="m"><static>true</static><link name="l">
      <collision name="c"><geometry><heightmap><uri>hills.png</uri><size>10 8 3</size>
      <pos>1 2 0.5</pos></heightmap></geometry></collision></link></model></sdf>)");
  const Scene scene = import_scene(file).scene;
  ASSERT_EQ(scene.objects.size(), 1u);
  const Bounds<double> box = PosedMesh(0, scene.objects[0].mesh, scene.objects[0].pose).bounds();
  EXPECT_NEAR((box.lower.head<2>() - Eigen::Vector2d(-4, -2)).norm(), 0, 1e-12);
  EXPECT_NEAR((box.upper.head<2>() - Eigen::Vector2d(6, 6)).norm(), 0, 1e-12);
  EXPECT_NEAR(box.upper.z(), 3.5, 1e-12);  // the lightest pixel, which is not white
  EXPECT_GT(box.lower.z(), 0.5 - 1e-12);
}

TEST_F(HeightFields, planes_of_a_size_are_rectangles_for_rays_and_half_spaces_for_contact) {
  const std::string file = folder_.write(
      "p.xml", mjcf(R"(<geom type="plane" size="2 3 0.1"/><geom size="0.1" pos="9 9 1"/>)"));
  const Imported imported = import_scene(file);
  ASSERT_TRUE(imported.scene.objects[0].mesh);
  EXPECT_FALSE(imported.scene.objects[0].half_space);
  const World rays = make_world(imported.scene);
  const auto met = [&](const Vec3<double>& from, const Vec3<double>& way) {
    QueryCounts counts;
    return rays.closest_hit(Ray<double>{from, way}, counts).found();
  };
  EXPECT_TRUE(met({1.9, 2.9, 1}, {0, 0, -1}));
  EXPECT_FALSE(met({2.1, 0, 1}, {0, 0, -1}));
  EXPECT_FALSE(met({1, 1, -1}, {0, 0, 1}));
  const std::vector<ClearanceBody> bodies = bodies_of(*imported.model, GeometryChoice::all);
  EXPECT_TRUE(bodies[0].plane);
  // The camera frames the ball, not the plane.
  EXPECT_LT((imported.scene.camera.position - Vec3<double>(9, 9, 1)).norm(), 3);
  const std::string endless = folder_.write("e.xml", mjcf(R"(<geom type="plane" size="0 0 1"/>)"));
  EXPECT_TRUE(import_scene(endless).scene.objects[0].half_space);
}

}  // namespace
}  // namespace minkray
