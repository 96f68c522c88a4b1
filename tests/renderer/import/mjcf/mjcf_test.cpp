// SPDX-License-Identifier: MIT
// Compares MJCF with MuJoCo itself: every model of Debian's packages.
#include <gtest/gtest.h>

#include <fstream>

#include "renderer/film/render.h"
#include "tests/oracle/mujoco_model.h"
#include "tests/renderer/import/imports.h"
#include "tests/support/program.h"
#include "tests/support/random.h"
#include "tests/support/robot_models.h"

namespace minkray {
namespace {

#ifdef MINKRAY_MUJOCO

using testing::MujocoModel;

/// Sizes, positions and directions differ by what both programs round on the way through a chain of
/// bodies, of numbers up to some metres.
constexpr double same = 1e-12;

/// MuJoCo's meshes are floats.
constexpr double same_float = 1e-5;

std::vector<std::string> all_models() {
  std::vector<std::string> files = robot_files("mujoco", ".xml");
  for (const std::string& file : robot_files("dart/mjcf", ".xml")) files.push_back(file);
  return files;
}

std::optional<Model> ours(const std::string& file, std::string* complaint = nullptr) {
  Mistakes mistakes(file);
  ImportOptions options;
  options.geometry = GeometryChoice::all;
  std::optional<Model> model = load_model(file, options, mistakes);
  if (complaint) *complaint = mistakes.text();
  EXPECT_EQ(model.has_value(), mistakes.none()) << file;
  return model;
}

/// Largest distance between the geoms of the two; for meshes, the largest distance of MuJoCo's
/// vertices outside of our hull, and of ours outside of theirs.
void expect_same_geoms(const Model& model, const MujocoModel& theirs, const std::string& where) {
  const std::vector<MujocoModel::Geom> expected = theirs.geoms();
  const std::vector<Affine<double>> links = link_poses(model);
  ASSERT_EQ(model.geoms.size(), expected.size()) << where;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const ModelGeom& geom = model.geoms[i];
    SCOPED_TRACE(where + ": geom " + std::to_string(i) + " " + geom.name);
    EXPECT_EQ(geom.name, expected[i].name);
    EXPECT_EQ(geom.kind, expected[i].kind);
    const Affine<double> pose =
        geom.link < 0 ? geom.pose : links[static_cast<std::size_t>(geom.link)] * geom.pose;
    if (geom.kind == "mesh") {
      // MuJoCo moves meshes to their middle: only where the vertices are is the same.
      for (const Vec3<double>& n :
           {Vec3<double>(1, 0, 0), Vec3<double>(0, 1, 0), Vec3<double>(0, 0, 1),
            Vec3<double>(-1, 0, 0), Vec3<double>(0, -1, 0), Vec3<double>(0, 0, -1)}) {
        const double reach = n.dot(pose(support_of(geom, pose.linear.transpose() * n)));
        for (const Vec3<double>& vertex : expected[i].vertices)
          EXPECT_LE(n.dot(expected[i].pose(vertex)), reach + same_float);
      }
      continue;
    }
    EXPECT_LT((pose.translation - expected[i].pose.translation).norm(), same);
    EXPECT_LT((pose.linear - expected[i].pose.linear).cwiseAbs().maxCoeff(), same);
    if (geom.touches_as_half_space()) continue;
    // Sizes: as far as each reaches along the axes.
    const auto size = [&](const Vec3<double>& n) { return support_of(geom, n).dot(n); };
    const Vec3<double>& s = expected[i].size;
    const Vec3<double> reach = geom.kind == "sphere"     ? Vec3<double>::Constant(s.x())
                               : geom.kind == "capsule"  ? Vec3<double>(s.x(), s.x(), s.x() + s.y())
                               : geom.kind == "cylinder" ? Vec3<double>(s.x(), s.x(), s.y())
                                                         : s;
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(size(Vec3<double>::Unit(axis)), reach[axis], same);
  }
}

TEST(Mjcf, every_model_that_mujoco_loads_has_the_same_geoms_in_the_same_places) {
  if (!has_robot_models()) GTEST_SKIP() << "run scenes/fetch-models";
  int loaded = 0, refused = 0;
  for (const std::string& file : all_models()) {
    std::string why, complaint;
    const auto theirs = MujocoModel::load(file, why);
    const std::optional<Model> model = ours(file, &complaint);
    if (!theirs) {
      ++refused;  // read or refused, but with a reason
      EXPECT_TRUE(model.has_value() || !complaint.empty()) << file;
      continue;
    }
    ++loaded;
    ASSERT_TRUE(model) << complaint;
    expect_same_geoms(*model, *theirs, file);
    EXPECT_EQ(model->links.size() + 1, theirs->bodies()) << file;
  }
  EXPECT_GE(loaded, 30);
  EXPECT_GE(refused, 6);
}

TEST(Mjcf, joints_move_bodies_as_mujoco_moves_them) {
  if (!has_robot_models()) GTEST_SKIP() << "run scenes/fetch-models";
  testing::Random random(20);
  int states = 0;
  for (const std::string& file : all_models()) {
    std::string why;
    const auto theirs = MujocoModel::load(file, why);
    if (!theirs || theirs->positions() == 0 || theirs->positions() > 500) continue;
    std::optional<Model> model = ours(file);
    ASSERT_TRUE(model);
    for (int state = 0; state < 5; ++state) {
      std::vector<double> qpos;
      for (std::size_t i = 0; i < theirs->positions(); ++i) qpos.push_back(random.uniform(-1, 1));
      theirs->set_positions(qpos);
      set_values(*model, qpos);
      expect_same_geoms(*model, *theirs, file + ", state " + std::to_string(state));
      ++states;
    }
  }
  EXPECT_GE(states, 100);
}

TEST(Mjcf, keyframes_are_mujocos) {
  const TemporaryFolder folder;
  const std::string file = folder / "keys.xml";
  std::ofstream(file) << R"(<mujoco><compiler angle="degree" eulerseq="zyx"/><worldbody>
    <body pos="1 2 3"><freejoint name="free"/><geom size=".1"/>
      <body euler="10 20 30"><joint axis="0 1 1" pos=".1 .2 .3" ref="15"/><geom size=".2"/>
        <body><joint type="ball" pos="0 0 1"/><geom type="box" size="1 2 3" pos="1 0 0"/></body>
        <body><joint type="slide" axis="1 2 2" ref=".25"/><geom size=".3" zaxis="1 1 0"/></body>
      </body></body></worldbody>
    <keyframe><key name="home" qpos="1 0 2 .6 0 .8 0 .5 .8 .6 0 0 .75"/>
      <key qpos="0 0 0 1 1 1 1 -.5 1 2 3 4 0"/></keyframe></mujoco>)";
  std::string why;
  const auto theirs = MujocoModel::load(file, why);
  ASSERT_TRUE(theirs) << why;
  std::optional<Model> model = ours(file);
  ASSERT_TRUE(model);
  ASSERT_EQ(theirs->keyframes(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string name = i == 0 ? "home" : "1";
    ASSERT_TRUE(find_keyframe(*model, name));
    set_values(*model, find_keyframe(*model, name)->values);
    theirs->set_positions(theirs->keyframe(i));
    expect_same_geoms(*model, *theirs, "key " + name);
  }
}

TEST(Mjcf, rays_meet_what_mujocos_rays_meet) {
  int all_hits = 0, all_rays = 0;
  if (!has_robot_models()) GTEST_SKIP() << "run scenes/fetch-models";
  constexpr int rays = 2000;
  testing::Random random(21);
  for (const std::string& file : all_models()) {
    std::string why;
    const auto theirs = MujocoModel::load(file, why);
    if (!theirs) continue;
    ImportOptions options;
    options.geometry = GeometryChoice::all;
    const Scene scene = import_scene(file, options).scene;
    const World world = make_world(scene);
    // Vertices, heights and the meshes' own poses are floats.
    bool has_floats = false;
    for (const auto& geom : theirs->geoms())
      has_floats |= geom.kind == "mesh" || geom.kind == "hfield";
    const Vec3<double> centre = scene.camera.look_at;
    const double extent = (scene.camera.position - centre).norm();
    int hits = 0, at_edges = 0;
    for (int i = 0; i < rays; ++i) {
      const Vec3<double> from = centre + extent * random.direction();
      const Vec3<double> to = centre + 0.3 * extent * random.direction();
      const Ray<double> ray{from, unit<double>(to - from)};
      int geom = -1;
      const double t = theirs->ray(ray, geom);
      QueryCounts counts;
      const WorldHit hit = world.closest_hit(ray, counts);
      // MuJoCo's rays pass surfaces from behind: they do not begin inside.
      if (hit.cast.status == Status::inside) continue;
      const double our_t = hit.found() ? hit.cast.t() : std::numeric_limits<double>::infinity();
      hits += hit.found() ? 1 : 0;
      if (our_t == t) continue;  // none
      if (has_floats) {
        // A ray that runs along a surface, or past an edge, exceeds the precision of the floats.
        const bool is_near = std::abs(our_t - t) <= same_float * extent;
        at_edges += is_near ? 0 : 1;
        continue;
      }
      ASSERT_NEAR(our_t, t, 1e-9 * extent) << file << " ray " << i;
      if (static_cast<int>(hit.instance) == geom) continue;
      // A tie: the other one is met there as well.
      EXPECT_GE(geom, 0);
    }
    EXPECT_LE(at_edges, rays / 500) << file;
    all_hits += hits;
    all_rays += rays;
  }
  // In single files all rays may begin behind a plane.
  EXPECT_GT(all_hits, all_rays / 20);
}

#endif

TEST(Mjcf, composites_of_a_file_have_a_hundred_thousand_elements_at_most_together) {
  const auto file_with = [](const std::vector<std::string>& counts) {
    std::string text = "<mujoco><worldbody>\n";
    for (std::size_t i = 0; i < counts.size(); ++i)
      text += "<body><composite prefix=\"" + std::to_string(i) + "\" type=\"particle\" count=\"" +
              counts[i] + "\" spacing=\"0.1\"><geom size=\"0.01\"/></composite></body>\n";
    return text + "</worldbody></mujoco>";
  };
  EXPECT_EQ(model_of(file_with({"100 100 9", "100 10 10"}), "robot.xml").geoms.size(), 100'000u);

  for (const std::vector<std::string>& counts :
       {std::vector<std::string>{"100 1000 2"}, {"100 100 9", "100 101 1"}}) {
    EXPECT_TRUE(has(mistakes_of(file_with(counts), "robot.xml"), "at most 100,000 elements"));
  }
}

TEST(Mjcf, geoms_of_one_mesh_have_one_hull) {
  const auto file_with = [](const std::string& defaults, const std::string& mesh) {
    return "<mujoco><default>" + defaults + "</default><asset>\n<mesh name='t' " + mesh +
           " refpos='0 0 1'/></asset><worldbody><geom type='mesh' mesh='t'/>" +
           "<geom type='mesh' mesh='t' pos='1 0 0'/></worldbody></mujoco>";
  };
  const std::string vertices = "vertex='0 0 0 1 0 0 0 1 0 0 0 1'";
  const Model model = model_of(file_with("", vertices), "robot.xml");
  ASSERT_EQ(model.geoms.size(), 2u);
  EXPECT_EQ(model.meshes.size(), 1u);
  for (const ModelGeom& geom : model.geoms) EXPECT_EQ(support_of(geom, {0, 0, -1}).z(), -1);
  // Few lines of it could give many meshes many vertices.
  EXPECT_TRUE(has(mistakes_of(file_with("<mesh " + vertices + "/>", ""), "robot.xml"),
                  "line 2: <mesh name=\"t\">: vertex: must be in the <mesh> itself"));
}

TEST(Mjcf, mistakes_are_told_all_at_once_with_their_lines) {
  const std::string text = R"(<mujoco>
  <compiler angle="degrees"/>
  <worldbody>
    <geom type="capsule" size="1"/>
    <body><geom type="wedge" size="1"/>
      <joint axis="0 0 0"/>
      <geom size="nan"/>
      <geom mesh="none" type="mesh"/>
      <replicate/>
    </body>
  </worldbody>
</mujoco>)";
  const std::string message = mistakes_of(text, "robot.xml");
  expect_parts(
      message,
      {"line 2: <compiler>: angle", "line 4: <geom>: size: of a capsule must be 2 numbers > 0",
       "line 5: <geom>: type", "line 6: <joint>: axis", "line 7: <geom>: size",
       "line 8: <geom>: mesh: no <mesh> is named", "line 9: <replicate>: count: must be"});
}

}  // namespace
}  // namespace minkray
