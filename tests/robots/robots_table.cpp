// SPDX-License-Identifier: MIT
// Requirements on reading and scanning robots, with measurements: models compared with MuJoCo and
// DART, speeds, hostile files (./run robots [RAYS [models]]).
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string_view>
#include <thread>

#include "renderer/sensor/npy.h"
#include "tests/robots/hostile_files.h"
#include "tests/robots/models_beside_mujoco.h"
#include "tests/support/dart_frames.h"
#include "tests/support/program.h"
#include "tests/support/random.h"
#include "tests/support/robot_models.h"

namespace minkray {
namespace {

constexpr const char* speed_model = "mujoco/humanoid/22_humanoids.xml";
constexpr int speed_runs = 7;
constexpr std::size_t array_rays = 1'000'000;

/// A line of the table at the end.
struct Verdict {
  std::string what, required, reached;
  bool held = false;
};

std::string text_of(const char* format, double number) {
  char text[60];
  std::snprintf(text, sizeof text, format, number);
  return text;
}

void models(int rays, std::vector<Verdict>& verdicts) {
  std::printf(
      "\n## Models beside MuJoCo\n\n"
      "| model | geoms | planes | kinds | pose error | rays | hits | wrong | ties | float "
      "vertices | worst t / extent | at meshes | ours ns | mj_ray ns | times |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  std::vector<std::string> files = robot_files("mujoco", ".xml");
  for (const std::string& file : robot_files("dart/mjcf", ".xml")) files.push_back(file);
  std::size_t read = 0, both_refuse = 0, only_ours = 0, good = 0;
  double worst_pose = 0, worst_t = 0, times = 0;
  long long all_rays = 0, wrong = 0;
  for (const std::string& file : files) {
    const bool is_timed = file.ends_with(speed_model);
    const MujocoRow row = beside_mujoco(file, rays, is_timed ? speed_runs : 1);
    if (!row.refused.empty()) {
      std::printf("| %s | refused by %s | | | | | | | | | | | | | |\n", row.name.c_str(),
                  row.refused.c_str());
      (row.refused == "Minkray" ? only_ours : both_refuse) += 1;
      continue;
    }
    const double each = 1e9 / std::max(rays, 1);
    std::printf(
        "| %s | %zu | %zu | %s | %.1e | %d | %d | %d | %d | %d | %.1e | %.1e | %.0f | %.0f | %.1f "
        "|\n",
        row.name.c_str(), row.geoms, row.planes, row.same_kinds ? "same" : "DIFFER", row.pose_error,
        row.rays, row.hits, row.wrong, row.ties, row.by_float, row.worst_t, row.worst_at_mesh,
        each * row.ours, each * row.theirs, row.theirs / row.ours);
    std::fflush(stdout);
    ++read;
    good += row.same_kinds && row.pose_error < 1e-12 ? 1 : 0;
    worst_pose = std::max(worst_pose, row.pose_error);
    worst_t = std::max(worst_t, row.worst_t);
    all_rays += row.rays;
    wrong += row.wrong;
    if (is_timed) times = row.theirs / row.ours;
  }
  verdicts.push_back({"MJCF that MuJoCo loads: same geoms, poses", "all, to 1e-12",
                      std::to_string(good) + " of " + std::to_string(read + only_ours) +
                          ", pose error " + text_of("%.1e", worst_pose) + "; " +
                          std::to_string(both_refuse) + " refused by MuJoCo",
                      good == read && only_ours == 0 && read > 0});
  verdicts.push_back({std::to_string(rays) + " rays at each beside mj_ray",
                      "same hit and geom but on ties, t to 1e-9 of the extent; at meshes to the "
                      "1e-6 of MuJoCo's floats",
                      std::to_string(wrong) + " wrong of " + std::to_string(all_rays) +
                          ", worst t " + text_of("%.1e", worst_t),
                      wrong == 0 && all_rays > 0});
  verdicts.push_back({"scan of 22_humanoids beside mj_ray, one thread, same rays, same run",
                      "at least 10 times", text_of("%.1f times", times), times >= 10});
}

void frames(std::vector<Verdict>& verdicts) {
  constexpr int states = 100;
  std::printf(
      "\n## Links beside DART, %d random states\n\n| robot | links | worst |\n|---|---|---|\n",
      states);
  double worst = 0;
  bool all_known = true, is_installed = true;
  for (const char* name : robots_beside_dart) {
    const auto errors = frames_beside_dart((robot_models() / name).string(), states);
    if (!errors) {
      std::printf("| %s | python3-dartpy is not installed | |\n", name);
      is_installed = false;
      continue;
    }
    std::printf("| %s | %zu | %.1e |\n", name, errors->links, errors->worst);
    worst = std::max(worst, errors->worst);
    all_known &= errors->missing.empty() && errors->links > 0;
  }
  std::fflush(stdout);
  verdicts.push_back({"Atlas, WAM, KR5, DRC-HUBO, 100 random joint states: links beside dartpy",
                      "to 1e-12", is_installed ? text_of("%.1e", worst) : "not installed",
                      is_installed && all_known && worst < 1e-12});
}

/// From an array of rays to an array of answers, the whole program.
void arrays(std::vector<Verdict>& verdicts) {
  const TemporaryFolder folder;
  {
    std::ofstream file(folder / "rays.npy", std::ios::binary);
    file << npy_header("'<f8'", array_rays, 6);
    testing::Random random(22);
    for (std::size_t i = 0; i < array_rays; ++i) {
      const Vec3<double> from = Vec3<double>(0, 0, 1) + 12 * random.direction();
      const Vec3<double> towards = Vec3<double>(0, 0, 1) + 4 * random.direction() - from;
      file.write(reinterpret_cast<const char*>(from.data()), sizeof from);
      file.write(reinterpret_cast<const char*>(towards.data()), sizeof towards);
    }
  }
  ProcessCost least;
  for (int run = 0; run < speed_runs; ++run) {
    const ProcessCost cost =
        cost_of_minkray({"scan", (robot_models() / speed_model).string(), "--rays",
                         folder / "rays.npy", "-o", folder / "answers.npy", "-q"});
    if (run == 0 || cost.seconds < least.seconds || cost.exit_code != 0) least = cost;
    if (cost.exit_code != 0) break;
  }
  verdicts.push_back({"10^6 rays at 22_humanoids from .npy to .npy, the whole program, " +
                          std::to_string(std::thread::hardware_concurrency()) + " cores",
                      "under a second",
                      text_of("%.2f s", least.seconds) + text_of(", %.0f MB", least.megabytes),
                      least.exit_code == 0 && least.seconds < 1});
}

void hostile(std::vector<Verdict>& verdicts) {
  std::printf("\n## Hostile files\n\n| file | exit code | seconds | MB |\n|---|---|---|---|\n");
  std::size_t held = 0;
  double slowest = 0, largest = 0;
  const std::vector<HostileRow> rows = hostile_files();
  for (const HostileRow& row : rows) {
    std::printf("| %s | %d%s | %.2f | %.0f |\n", row.what.c_str(), row.exit_code,
                row.holds() ? "" : " NOT AS MEANT", row.seconds, row.megabytes);
    held += row.holds() ? 1 : 0;
    slowest = std::max(slowest, row.seconds);
    largest = std::max(largest, row.megabytes);
  }
  verdicts.push_back({"hostile files", "an answer in seconds, bounded memory",
                      std::to_string(held) + " of " + std::to_string(rows.size()) +
                          text_of(", at most %.1f s", slowest) + text_of(", %.0f MB", largest),
                      held == rows.size()});
}

int run(int rays, bool is_all) {
  if (!has_robot_models()) {
    std::fprintf(stderr, "robots: run scenes/fetch-models first\n");
    return 3;
  }
  std::vector<Verdict> verdicts;
  // First: what is measured of a process begins as large as this one.
  if (is_all) hostile(verdicts);
  models(rays, verdicts);
  if (is_all) frames(verdicts);
  if (is_all) arrays(verdicts);
  std::printf("\n## Must hold\n\n| what | required | reached | held |\n|---|---|---|---|\n");
  bool all_held = true;
  for (const Verdict& verdict : verdicts) {
    std::printf("| %s | %s | %s | %s |\n", verdict.what.c_str(), verdict.required.c_str(),
                verdict.reached.c_str(), verdict.held ? "yes" : "NO");
    all_held &= verdict.held;
  }
  return all_held ? 0 : 1;
}

}  // namespace
}  // namespace minkray

int main(int argc, char** argv) {
  return minkray::run(argc > 1 ? std::atoi(argv[1]) : 100000,
                      !(argc > 2 && std::string_view(argv[2]) == "models"));
}
