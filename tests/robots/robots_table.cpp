// SPDX-License-Identifier: MIT
// Robots' models of Debian's packages beside MuJoCo: geoms, poses, rays and speeds, as a table
// (./run robots [RAYS]).
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "core/parallel/parallel.h"
#include "renderer/film/render.h"
#include "renderer/import/import.h"
#include "renderer/sensor/scan.h"
#include "tests/oracle/mujoco_model.h"
#include "tests/support/random.h"
#include "tests/support/robot_models.h"

namespace minkray {
namespace {

using testing::MujocoModel;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

struct Row {
  std::string name, refused;
  std::size_t geoms = 0, planes = 0;
  bool same_kinds = true;
  double pose_error = 0;
  int rays = 0, hits = 0, ties = 0, wrong = 0, hull_in_front = 0;
  double worst_t = 0;  ///< of the extent
  double ours = 0, theirs = 0;
};

Row compare(const std::string& file, int ray_count) {
  Row row;
  row.name = std::filesystem::relative(file, robot_models()).string();
  std::string why;
  const auto theirs = MujocoModel::load(file, why);
  Mistakes mistakes(file);
  ImportOptions options;
  options.geometry = GeometryChoice::all;
  std::optional<Model> model = load_model(file, options, mistakes);
  if (!theirs || !model) {
    row.refused = !theirs && !model ? "both" : !theirs ? "MuJoCo" : "Minkray";
    return row;
  }
  const std::vector<MujocoModel::Geom> geoms = theirs->geoms();
  const std::vector<Affine<double>> links = link_poses(*model);
  row.geoms = geoms.size();
  row.same_kinds = geoms.size() == model->geoms.size();
  for (std::size_t i = 0; row.same_kinds && i < geoms.size(); ++i) {
    const ModelGeom& geom = model->geoms[i];
    row.same_kinds = geom.kind == geoms[i].kind;
    row.planes += geom.kind == "plane" ? 1 : 0;
    if (geom.kind == "mesh") continue;
    const Affine<double> pose =
        geom.link < 0 ? geom.pose : links[static_cast<std::size_t>(geom.link)] * geom.pose;
    row.pose_error =
        std::max({row.pose_error, (pose.translation - geoms[i].pose.translation).norm(),
                  (pose.linear - geoms[i].pose.linear).cwiseAbs().maxCoeff()});
  }

  Scene scene = import_scene(file, options).scene;
  const Vec3<double> centre = scene.camera.look_at;
  const double extent = (scene.camera.position - centre).norm();
  testing::Random random(20);
  SensorRays rays;
  for (int i = 0; i < ray_count; ++i) {
    const Vec3<double> from = centre + extent * random.direction();
    const Vec3<double> to = centre + 0.35 * extent * random.direction();
    rays.rays.push_back({{from, unit<double>(to - from)}, 0});
  }
  Scan scanned;
  with_threads(1, [&] {
    scan(scene, {{rays.rays[0]}}, {});  // what is done once is done
    const auto begin = Clock::now();
    scanned = scan(scene, rays, {});
    row.ours = seconds_since(begin);
  });
  std::vector<double> ts(rays.rays.size());
  std::vector<int> ids(rays.rays.size());
  const auto begin = Clock::now();
  for (std::size_t i = 0; i < rays.rays.size(); ++i) ts[i] = theirs->ray(rays.rays[i].ray, ids[i]);
  row.theirs = seconds_since(begin);

  for (std::size_t i = 0; i < rays.rays.size(); ++i) {
    const Echo& echo = scanned.echoes[i];
    if (echo.status == 2) continue;  // MuJoCo's rays do not begin inside
    ++row.rays;
    row.hits += echo.object >= 0 ? 1 : 0;
    if (echo.t == ts[i] && (echo.object == ids[i] || echo.object < 0)) continue;
    const double error = std::abs(echo.t - ts[i]) / extent;
    const bool ours_is_mesh =
        echo.object >= 0 && geoms[static_cast<std::size_t>(echo.object)].kind == "mesh";
    if (ours_is_mesh && echo.t <= ts[i] + 1e-5 * extent) {
      ++row.hull_in_front;
    } else if (!(error < 1e-9)) {
      ++row.wrong;
    } else {
      row.worst_t = std::max(row.worst_t, error);
      row.ties += echo.object != ids[i] ? 1 : 0;
    }
  }
  return row;
}

int run(int rays) {
  if (!has_robot_models()) {
    std::fprintf(stderr, "robots: run scenes/fetch-models first\n");
    return 3;
  }
  std::printf(
      "| model | geoms | planes | kinds | pose error | rays | hits | wrong | ties | hull in "
      "front of its mesh | worst t / extent | ours ns | mj_ray ns | times |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  bool all_good = true;
  std::vector<std::string> files = robot_files("mujoco", ".xml");
  for (const std::string& file : robot_files("dart/mjcf", ".xml")) files.push_back(file);
  for (const std::string& file : files) {
    const Row row = compare(file, rays);
    if (!row.refused.empty()) {
      std::printf("| %s | refused by %s | | | | | | | | | | | | |\n", row.name.c_str(),
                  row.refused.c_str());
      all_good &= row.refused != "Minkray";
      continue;
    }
    const double each = 1e9 / std::max(rays, 1);
    std::printf(
        "| %s | %zu | %zu | %s | %.1e | %d | %d | %d | %d | %d | %.1e | %.0f | %.0f | %.1f |\n",
        row.name.c_str(), row.geoms, row.planes, row.same_kinds ? "same" : "DIFFER", row.pose_error,
        row.rays, row.hits, row.wrong, row.ties, row.hull_in_front, row.worst_t, each * row.ours,
        each * row.theirs, row.theirs / row.ours);
    all_good &= row.same_kinds && row.pose_error < 1e-12 && row.wrong == 0;
    std::fflush(stdout);
  }
  return all_good ? 0 : 1;
}

}  // namespace
}  // namespace minkray

int main(int argc, char** argv) {
  return minkray::run(argc > 1 ? std::atoi(argv[1]) : 100000);
}
