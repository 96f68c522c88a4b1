// SPDX-License-Identifier: MIT
#include "tests/robots/models_beside_mujoco.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>

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

/// MuJoCo keeps vertices as floats in a frame of its own: a few roundings of 2^-24, of the extent.
constexpr double float_reading = 1e-6;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Rays of random directions from a ball around everything towards its middle.
SensorRays rays_at(const Scene& scene, int count) {
  const Vec3<double> centre = scene.camera.look_at;
  const double extent = (scene.camera.position - centre).norm();
  testing::Random random(20);
  SensorRays rays;
  for (int i = 0; i < count; ++i) {
    const Vec3<double> from = centre + extent * random.direction();
    const Vec3<double> to = centre + 0.35 * extent * random.direction();
    rays.rays.push_back({{from, unit<double>(to - from)}, 0});
  }
  return rays;
}

}  // namespace

MujocoRow beside_mujoco(const std::string& file, int ray_count, int runs) {
  MujocoRow row;
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

  const Scene scene = import_scene(file, options).scene;
  const double extent = (scene.camera.position - scene.camera.look_at).norm();
  const SensorRays rays = rays_at(scene, ray_count);
  Scan scanned;
  std::vector<double> ts(rays.rays.size());
  std::vector<int> ids(rays.rays.size());
  row.ours = row.theirs = std::numeric_limits<double>::infinity();
  // Each in turn, so that a machine that is busy for a while is busy for both.
  for (int run = 0; run < runs; ++run) {
    with_threads(1, [&] {
      const auto begin = Clock::now();
      scanned = scan(scene, rays, {});
      row.ours = std::min(row.ours, seconds_since(begin));
    });
    const auto begin = Clock::now();
    for (std::size_t i = 0; i < rays.rays.size(); ++i)
      ts[i] = theirs->ray(rays.rays[i].ray, ids[i]);
    row.theirs = std::min(row.theirs, seconds_since(begin));
  }

  const auto is_surface = [&](int geom) {
    if (geom < 0) return false;
    const std::string& kind = geoms[static_cast<std::size_t>(geom)].kind;
    return kind == "mesh" || kind == "hfield";
  };
  const auto agree = [&](const Echo& echo, std::size_t i) {
    const double allowed = is_surface(echo.object) && is_surface(ids[i]) ? float_reading : 1e-9;
    return echo.t == ts[i] || std::abs(echo.t - ts[i]) / extent < allowed;
  };
  std::vector<std::size_t> differing;
  for (std::size_t i = 0; i < rays.rays.size(); ++i) {
    const Echo& echo = scanned.echoes[i];
    if (echo.status == 2) continue;  // MuJoCo's rays do not begin inside
    ++row.rays;
    row.hits += echo.object >= 0 ? 1 : 0;
    if (!agree(echo, i)) {
      differing.push_back(i);
      continue;
    }
    if (echo.object < 0) continue;
    double& worst = is_surface(echo.object) ? row.worst_at_mesh : row.worst_t;
    worst = std::max(worst, std::abs(echo.t - ts[i]) / extent);
    row.ties += echo.object != ids[i] ? 1 : 0;
  }
  for (const std::size_t i : differing) {
    // Past the outline of a mesh of float vertices: a ray as near as that agrees.
    const bool is_at_surface = is_surface(scanned.echoes[i].object) || is_surface(ids[i]);
    const Ray<double>& ray = rays.rays[i].ray;
    SensorRays beside;
    for (int step = 0; is_at_surface && step < 16; ++step) {
      const Vec3<double> across = ray.direction.cross(ray.direction.unitOrthogonal());
      const Vec3<double> shift =
          std::cos(step) * ray.direction.unitOrthogonal() + std::sin(step) * across;
      beside.rays.push_back({{ray.origin + float_reading * extent * shift, ray.direction}, 0});
    }
    const Scan around = scan(scene, beside, {});
    // On steep surfaces t changes by more than the ray's place.
    double least = scanned.echoes[i].t, most = least;
    bool is_near = false;
    for (const Echo& echo : around.echoes) {
      is_near |= agree(echo, i);
      least = std::min(least, echo.t);
      most = std::max(most, echo.t);
    }
    is_near |= least <= ts[i] && ts[i] <= most;
    ++(is_near ? row.by_float : row.wrong);
    if (is_near || row.wrong > 20) continue;
    const Echo& echo = scanned.echoes[i];
    const auto kind = [&](int geom) {
      return geom < 0 ? "none" : geoms[static_cast<std::size_t>(geom)].kind.c_str();
    };
    std::fprintf(
        stderr,
        "%s: from %.17g %.17g %.17g along %.17g %.17g %.17g: %s %d at %.17g, MuJoCo: %s %d "
        "at %.17g\n",
        row.name.c_str(), ray.origin.x(), ray.origin.y(), ray.origin.z(), ray.direction.x(),
        ray.direction.y(), ray.direction.z(), kind(echo.object), echo.object, echo.t, kind(ids[i]),
        ids[i], ts[i]);
  }
  return row;
}

}  // namespace minkray
