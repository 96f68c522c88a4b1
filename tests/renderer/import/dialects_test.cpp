// SPDX-License-Identifier: MIT
// Additions of vendors and newer versions to robots' formats, and mistakes in public files that
// must not cost all of them: each kind by several instances.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/renderer/import/imports.h"
#include "tests/support/messages.h"
#include "tests/support/random.h"

namespace minkray {
namespace {

std::string urdf_shape(const std::string& shape) {
  return "<robot name=\"r\"><link name=\"a\"><visual><geometry>" + shape +
         "</geometry></visual></link></robot>";
}

std::string sdf_shape(const std::string& shape) {
  return "<sdf version=\"1.9\"><model name=\"m\"><link name=\"l\"><visual name=\"v\"><geometry>" +
         shape + "</geometry></visual></link></model></sdf>";
}

/// True if a point of the world is within one of the geoms, which are all hulls.
bool is_inside(const Model& model, const Vec3<double>& point) {
  return std::ranges::any_of(model.geoms, [&](const ModelGeom& geom) {
    const auto& hull = std::get<Hull>(geom.shape->kind);
    const Vec3<double> at = geom.pose.inverse()(point);
    const FacetMesh& facets = *hull.points.facets();
    for (std::size_t i = 0; i < facets.size(); ++i)
      if (facets[i].normal().dot(at - facets[i].corner(0)) > 0) return false;
    return true;
  });
}

TEST(Dialects, sizes_of_zero_are_points_segments_and_disks) {
  const std::pair<const char*, const char*> of_urdf[] = {
      {"<sphere radius=\"0\"/>", "point"},
      {"<cylinder radius=\"0\" length=\"2\"/>", "segment"},
      {"<cylinder radius=\"0\" length=\"0\"/>", "point"},
      {"<cylinder radius=\"1\" length=\"0\"/>", "cylinder"},
      {"<capsule radius=\"0\" length=\"2\"/>", "segment"},
      {"<capsule radius=\"1\" length=\"0\"/>", "sphere"},
      {"<box size=\"1 0 0\"/>", "box"},
      {"<cone radius=\"0\" length=\"2\"/>", "segment"},
      {"<ellipsoid radii=\"1 2 0\"/>", "transform"},
      {"<ellipsoid radii=\"0 2 0\"/>", "segment"},
      {"<ellipsoid radii=\"0 0 0\"/>", "point"}};
  for (const auto& [shape, kind] : of_urdf)
    EXPECT_EQ(kind_of(model_of(urdf_shape(shape), "r.urdf")), kind) << shape;
  EXPECT_EQ(kind_of(model_of(sdf_shape("<sphere><radius>0</radius></sphere>"), "m.sdf")), "point");
  EXPECT_TRUE(has(mistakes_of(urdf_shape("<sphere radius=\"-1\"/>")), "radius: must be >= 0"));
  // A flat shape lies where the ellipsoid's section would.
  const Model flat = model_of(urdf_shape("<ellipsoid radii=\"0 3 2\"/>"), "r.urdf");
  const std::pair<Vec3<double>, double> reaches[] = {
      {{1, 0, 0}, 0}, {{0, 1, 0}, 3}, {{0, 0, 1}, 2}};
  for (const auto& [n, reach] : reaches)
    EXPECT_NEAR(support_of(flat.geoms[0], n).dot(n), reach, 1e-15);
}

TEST(Dialects, of_vendors_name_shapes_and_joints_that_there_are) {
  for (const std::string prefix : {"drake:", "gz:", "ignition:", "acme:"}) {
    EXPECT_EQ(kind_of(model_of(urdf_shape("<" + prefix + "capsule radius=\"1\" length=\"2\"/>"),
                               "r.urdf")),
              "capsule");
    EXPECT_EQ(
        kind_of(model_of(sdf_shape("<" + prefix + "capsule><" + prefix + "radius>1</" + prefix +
                                   "radius><length>2</length></" + prefix + "capsule>"),
                         "m.sdf")),
        "capsule");
  }
  EXPECT_EQ(kind_of(model_of(
                sdf_shape("<drake:ellipsoid><a>1</a><b>2</b><c>3</c></drake:ellipsoid>"), "m.sdf")),
            "ellipsoid");
  const std::string two_links =
      "<robot name=\"r\"><link name=\"a\"/><link name=\"b\"/><drake:joint name=\"j\" type=\"TYPE\">"
      "<parent link=\"a\"/><child link=\"b\"/></drake:joint></robot>";
  const std::tuple<const char*, JointKind, std::size_t> joints[] = {
      {"spherical", JointKind::ball, 1},
      {"ball", JointKind::ball, 1},
      {"universal", JointKind::hinge, 2},
      {"screw", JointKind::hinge, 1},
      {"planar", JointKind::planar, 1}};
  for (const auto& [type, kind, count] : joints) {
    std::string text = two_links;
    const Model model = model_of(text.replace(text.find("TYPE"), 4, type), "r.urdf");
    ASSERT_EQ(model.links.size(), 2u);
    ASSERT_EQ(model.links[1].joints.size(), count) << type;
    EXPECT_EQ(model.links[1].joints[0].kind, kind) << type;
  }
  const Model plane = model_of(urdf_shape("<plane normal=\"1 0 0\"/>"), "r.urdf");
  EXPECT_LT((plane.geoms[0].pose.linear * Vec3<double>(0, 0, 1) - Vec3<double>(1, 0, 0)).norm(),
            1e-15);
}

TEST(Dialects, a_missing_parent_is_told_once_and_not_as_a_circle) {
  const std::string message = mistakes_of(
      "<robot name=\"r\"><link name=\"a\"/><link name=\"b\"/><joint name=\"j\" type=\"fixed\">"
      "<parent link=\"absent\"/><child link=\"a\"/></joint><joint name=\"k\" type=\"fixed\">"
      "<parent link=\"a\"/><child link=\"b\"/></joint></robot>");
  EXPECT_TRUE(has(message, "the link \"absent\" not found"));
  EXPECT_EQ(std::ranges::count(message, '\n'), 0) << message;
}

TEST(Dialects, several_roots_are_told) {
  const Model model =
      model_of("<robot name=\"r\"><link name=\"a\"/><link name=\"b\"/></robot>", "r.urdf");
  EXPECT_TRUE(tells(model, "links without a parent"));
  EXPECT_TRUE(has(mistakes_of("<robot name=\"a\"><link name=\"x\"/></robot><robot name=\"b\"/>"),
                  "must have one root element"));
}

/// Compares the points of an area with the rule that counts crossings of a ray (even-odd).
TEST(Dialects, outlines_become_prisms_of_their_area) {
  const std::vector<std::vector<std::array<double, 2>>> shapes[] = {
      {{{0, 0}, {2, 0}, {2, 1}, {0, 1}}},                                            // convex
      {{{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {0, 1}}},                            // L
      {{{0, 0}, {1, 2}, {2, 0}, {2, 3}, {1, 2.5}, {0, 3}}},                          // M
      {{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}}, {{1, 1}, {1, 3}, {3, 3}, {3, 1}}},  // hole
      {{{0, 0}, {2, 2}, {2, 0}, {0, 2}}},                        // crosses itself
      {{{1, 0}, {0.3, 3}, {3, 1.2}, {-0.5, 1.1}, {2.5, 3.1}}}};  // star
  for (const auto& outlines : shapes) {
    std::string text;
    for (const auto& outline : outlines) {
      text += "<polyline>";
      for (const auto& [x, y] : outline)
        text += "<point>" + std::to_string(x) + " " + std::to_string(y) + "</point>";
      text += "<height>0.5</height></polyline>";
    }
    const Model model = model_of(sdf_shape(text), "m.sdf");
    ASSERT_FALSE(model.geoms.empty());
    testing::Random random(7);
    std::size_t inside = 0;
    for (int i = 0; i < 2000; ++i) {
      const double x = random.uniform(-1, 5), y = random.uniform(-1, 5),
                   z = random.uniform(-0.2, 0.7);
      bool is_in = false;
      for (const auto& outline : outlines)
        for (std::size_t k = 0; k < outline.size(); ++k) {
          const auto &a = outline[k], &b = outline[(k + 1) % outline.size()];
          if ((a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) * (b[0] - a[0]) / (b[1] - a[1]))
            is_in = !is_in;
        }
      is_in = is_in && z > 0 && z < 0.5;
      inside += is_in ? 1 : 0;
      EXPECT_EQ(is_inside(model, {x, y, z}), is_in) << x << " " << y << " " << z;
    }
    EXPECT_GT(inside, 20u);
  }
  EXPECT_EQ(model_of(sdf_shape("<polyline><point>0 0</point><point>1 0</point><point>1 1</point>"
                               "<height>1</height></polyline>"),
                     "m.sdf")
                .geoms.size(),
            1u);
  EXPECT_TRUE(has(
      mistakes_of(sdf_shape("<polyline><point>0 0</point><point>1 1</point></polyline>"), "m.sdf"),
      "must enclose an area"));
}

TEST_F(MeshFolder, meshes_have_their_own_colours_unless_the_robot_gives_others) {
  const std::string mesh = "<mesh filename=\"two.obj\"/>";
  const Imported one = import("r.urdf", urdf_shape(mesh));
  EXPECT_EQ(one.model->geoms[0].rgba, (Rgba{1, 0, 0, 1}));
  // Triangles keep their colours, and a hull has one.
  EXPECT_FALSE(tells(*one.model, "<mesh>", "has 2 colours"));
  ImportOptions hull;
  hull.meshes = MeshChoice::hull;
  EXPECT_TRUE(tells(*import("r.urdf", urdf_shape(mesh), hull).model, "<mesh>", "has 2 colours"));
  ImportOptions groups;
  groups.split = MeshSplit::groups;
  const Imported two = import("r.urdf", urdf_shape(mesh), groups);
  ASSERT_EQ(two.model->geoms.size(), 2u);
  EXPECT_EQ(two.model->geoms[1].rgba, (Rgba{0, 0, 1, 0.5}));
  std::string painted = urdf_shape(mesh);
  painted.insert(painted.find("</visual>"),
                 "<material name=\"m\"><color rgba=\"0 1 0 1\"/></material>");
  EXPECT_EQ(import("r.urdf", painted).model->geoms[0].rgba, (Rgba{0, 1, 0, 1}));
  folder.write("alone.obj",
               "mtllib gone.mtl\nusemtl x\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n");
  EXPECT_TRUE(tells(*import("r.urdf", urdf_shape("<mesh filename=\"alone.obj\"/>")).model, "<mesh>",
                    "gone.mtl"));
}

TEST_F(MeshFolder, a_submesh_is_shown_alone) {
  const auto model = [&](const std::string& submesh) {
    return *import("m.sdf", sdf_shape("<mesh><uri>two.obj</uri>" + submesh + "</mesh>")).model;
  };
  const auto lower_x = [](const Model& of) { return -support_of(of.geoms.at(0), {-1, 0, 0}).x(); };
  EXPECT_EQ(lower_x(model("")), 0);
  EXPECT_EQ(lower_x(model("<submesh><name>right</name></submesh>")), -5);
  EXPECT_EQ(lower_x(model("<submesh><name>right</name><center>true</center></submesh>")), 0.5);
  EXPECT_TRUE(
      tells(model("<submesh><name>middle</name></submesh>"), "<mesh>", "no part \"middle\""));
}

TEST_F(MeshFolder, a_package_has_the_name_of_its_package_xml) {
  std::filesystem::create_directories(folder.path() / "src/checkout-main/meshes");
  std::filesystem::create_directories(folder.path() / "src/robot/urdf");
  std::filesystem::copy_file(folder / "two.obj",
                             folder.path() / "src/checkout-main/meshes/two.obj");
  folder.write("src/checkout-main/package.xml",
               "<package format=\"3\">\n  <name>\n arm_description </name></package>");
  const std::string text =
      urdf_shape("<mesh filename=\"package://arm_description/meshes/two.obj\"/>");
  EXPECT_EQ(complaint(folder.write("src/robot/urdf/r.urdf", text)), "");
  const TemporaryFolder elsewhere;
  EXPECT_NE(complaint(elsewhere.write("r.urdf", text)), "");
  ImportOptions options;
  for (const char* given : {"src", "src/checkout-main"}) {
    options.package_dirs = {(folder.path() / given).string()};
    EXPECT_EQ(complaint(elsewhere.write("r.urdf", text), options), "") << given;
  }
}

TEST_F(MeshFolder, missing_meshes_are_one_line_that_names_what_helps) {
  std::string links;
  for (int i = 0; i < 20; ++i)
    links += "<visual><geometry><mesh filename=\"package://p/" + std::to_string(i % 10) +
             ".stl\"/></geometry></visual>";
  const std::string file =
      folder.write("r.urdf", "<robot name=\"r\"><link name=\"a\">" + links + "</link></robot>");
  const std::string message = complaint(file);
  EXPECT_EQ(std::ranges::count(message, '\n'), 1) << message;
  expect_parts(message, {"; 9 other meshes", "missing meshes: 10", "--package-dir",
                         "--skip-missing-meshes", "--verbose"});
  ImportOptions verbose;
  verbose.verbose = true;
  EXPECT_EQ(std::ranges::count(complaint(file, verbose), '\n'), 10);
  // Shapes that are not requested are not reported as missing.
  EXPECT_EQ(
      complaint(folder.write("c.urdf",
                             "<robot name=\"r\"><link name=\"a\"><visual><geometry><sphere "
                             "radius=\"1\"/></geometry></visual><collision><geometry><mesh "
                             "filename=\"gone.stl\"/></geometry></collision></link></robot>")),
      "");
}

TEST_F(MeshFolder, lenient_leaves_out_what_is_wrong_and_lists_it) {
  const std::string text =
      "<robot name=\"r\"><link name=\"a\"><visual><geometry><sphere "
      "radius=\"1\"/></geometry></visual>"
      "<visual><geometry><sphere radius=\"x\"/></geometry></visual>"
      "<visual><geometry><sphere radius=\"x\"/></geometry></visual>"
      "<visual><geometry><teapot/></geometry></visual><collision/>"
      "<visual><geometry><mesh filename=\"gone.stl\"/></geometry></visual></link></robot>";
  EXPECT_NE(mistakes_of(text), "");
  ImportOptions lenient;
  lenient.lenient = true;
  const Model model = model_of(text, "r.urdf", lenient);
  EXPECT_EQ(model.geoms.size(), 1u);
  EXPECT_TRUE(tells(model, "<sphere>", "radius"));
  EXPECT_TRUE(tells(model, "<teapot>"));
  EXPECT_TRUE(tells(model, "<mesh>", "gone.stl"));
  for (const PassedOver& one : model.passed_over) {
    if (one.what == "<sphere>") {
      EXPECT_EQ(one.count, 2u);
    }
  }
  const Model sdf = model_of(sdf_shape("<sphere><radius>y</radius></sphere>"), "m.sdf", lenient);
  EXPECT_TRUE(tells(sdf, "<radius>"));
  const Model flex =
      model_of(mjcf("<geom size=\"1\"/><flexcomp name=\"f\" type=\"grid\"/>"), "m.xml", lenient);
  EXPECT_EQ(flex.geoms.size(), 1u);
  EXPECT_TRUE(tells(flex, "<flexcomp>", "MuJoCo 3.0"));
}

TEST_F(MeshFolder, sdf_includes_robots_and_merges_models) {
  std::filesystem::create_directories(folder.path() / "hand");
  folder.write("hand/model.config", "<model><sdf version=\"1.9\">model.sdf</sdf></model>");
  folder.write(
      "hand/model.sdf",
      R"(<sdf version="1.9"><model name="hand"><frame name="grip"><pose>0 0 1 0 0 0</pose></frame>
    <link name="palm"/><link name="thumb"><pose relative_to="palm">1 0 0 0 0 0</pose></link>
    <joint name="t" type="revolute"><parent>palm</parent><child>thumb</child></joint></model></sdf>)");
  const auto at = [](const Imported& imported, const std::string& link) {
    const std::vector<Affine<double>> poses = link_poses(*imported.model);
    for (std::size_t i = 0; i < poses.size(); ++i)
      if (imported.model->links[i].name == link) return poses[i].translation;
    ADD_FAILURE() << "no link " << link;
    return Vec3<double>(9, 9, 9);
  };
  const Imported merged =
      import("m.sdf",
             R"(<sdf version="1.9"><model name="m"><link name="arm"><pose>0 0 2 0 0 0</pose></link>
    <include merge="true"><uri>model://hand</uri><pose relative_to="arm">0 3 0 0 0 0</pose></include>
    <link name="ring"><pose relative_to="thumb">0 0 0.5 0 0 0</pose></link>
    <joint name="j" type="fixed"><parent>arm</parent><child>palm</child></joint></model></sdf>)");
  EXPECT_EQ(merged.model->links.size(), 4u);
  EXPECT_LT((at(merged, "m::palm") - Vec3<double>(0, 3, 2)).norm(), 1e-15);
  EXPECT_LT((at(merged, "m::thumb") - Vec3<double>(1, 3, 2)).norm(), 1e-15);
  EXPECT_LT((at(merged, "m::ring") - Vec3<double>(1, 3, 2.5)).norm(), 1e-15);
  const Imported placed = import("p.sdf", R"(<sdf version="1.9"><model name="m"><link name="base"/>
    <include merge="true"><uri>model://hand</uri><placement_frame>grip</placement_frame><pose>0 0 5 0 0 0</pose></include>
    </model></sdf>)");
  EXPECT_LT((at(placed, "m::palm") - Vec3<double>(0, 0, 4)).norm(), 1e-12);

  folder.write(
      "arm.urdf",
      R"(<robot name="arm" xmlns:drake="d"><material name="red"><color rgba="1 0 0 1"/></material>
    <link name="base"/><link name="tip"><visual><origin xyz="0 0 1"/><geometry><drake:ellipsoid a="1" b="2" c="3"/></geometry>
    <material name="red"/></visual></link><joint name="j" type="revolute"><parent link="base"/><child link="tip"/>
    <origin xyz="1 0 0" rpy="0 0 1.5707963267948966"/><axis xyz="0 0 1"/></joint></robot>)");
  const Imported world = import(
      "w.world", R"(<sdf version="1.9"><world name="w"><include><uri>arm.urdf</uri><name>left</name>
    <pose>0 0 7 0 0 0</pose></include></world></sdf>)");
  EXPECT_LT((at(world, "left::tip") - Vec3<double>(1, 0, 7)).norm(), 1e-15);
  ASSERT_EQ(world.model->geoms.size(), 1u);
  EXPECT_EQ(world.model->geoms[0].rgba, (Rgba{1, 0, 0, 1}));
  EXPECT_EQ(kind_of(*world.model), "ellipsoid");
  EXPECT_EQ(world.model->links[1].joints.at(0).kind, JointKind::hinge);
}

TEST_F(MeshFolder, rows_of_joints_beyond_their_limits_are_told) {
  const std::string robot =
      R"(<robot name="r"><link name="a"/><link name="b"/><joint name="j" type="revolute"><parent link="a"/>
    <child link="b"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>)";
  ImportOptions options;
  options.joint_rows = folder.write("rows.csv", "\xef\xbb\xbftime,j\n0,0\n1,2\n2,3\n");
  const Imported moved = import("r.urdf", robot, options);
  EXPECT_TRUE(tells(*moved.model, "limit of the joint \"j\"", "at 3, outside -1 to 1"));
  options.joint_rows = folder.write("rows.csv", "time,j,j\n0,0,0\n");
  EXPECT_TRUE(
      has(complaint(folder / "r.urdf", options), "column \"j\": duplicate (given 2 times)"));
}

TEST_F(MeshFolder, formats_are_known_by_content) {
  const std::string robot = urdf_shape("<sphere radius=\"1\"/>");
  for (const char* name : {"r.txt", "r", "r.urdf.xacro", "r.json", "r.gltf"})
    EXPECT_EQ(complaint(folder.write(name, "\xef\xbb\xbf\n" + robot)), "") << name;
  EXPECT_EQ(complaint(folder.write("m.json", R"({"asset": {"version": "2.0"}, "nodes": [{}]})")),
            "");
  const std::pair<std::string, const char*> others[] = {
      {std::string("\x89PNG\r\n\x1a\n"), "a picture (PNG)"},
      {"BLENDER-v300", "a Blender file"},
      {"PK\x03\x04", "an archive (ZIP)"},
      {"solid x\n", "a mesh (STL)"}};
  for (const auto& [begin, what] : others) {
    const std::string message = complaint(folder.write("a.json", begin));
    EXPECT_TRUE(has(message, what));
  }
}

}  // namespace
}  // namespace minkray
