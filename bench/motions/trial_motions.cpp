// SPDX-License-Identifier: MIT
// Verdicts on the problems of MotionBenchMaker (C. Chamzas et al., 2022) as VAMP's repository ships
// them: a motion from each start straight to its goal, judged, and each verdict sampled by FCL.
#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>

#include "bench/motions/fcl_sampler.h"
#include "core/parallel/parallel.h"
#include "renderer/base/errors.h"
#include "renderer/import/import.h"
#include "renderer/plan/message_values.h"
#include "renderer/plan/robot_meaning.h"
#include "renderer/plan/trajectory.h"

namespace minkray {
namespace {

namespace fs = std::filesystem;

/// FCL's solvers of convex pieces end at 1e-6 by default; metres.
constexpr double fcl_tolerance = 1e-5;

struct Options {
  std::size_t states = 1000;  ///< number that FCL checks in each free motion
  std::size_t rows = 2;       ///< of each motion
  std::size_t percent = 100;  ///< of the way to the goal that is gone
  std::string set;            ///< of problems; empty: all
  bool exact = false;         ///< verdicts are of meshes' triangles, not of their hulls
  bool fcl_time = false;      ///< measures FCL's time for 1000 states as well
  std::vector<std::string> folders;
};

struct Counts {
  std::size_t motions = 0, free = 0, colliding = 0, undecided = 0, bad = 0;
  std::size_t false_free = 0, unconfirmed = 0, states = 0;
  std::size_t grazing = 0;  ///< not confirmed by FCL, and shallower than its resolution
  std::vector<double> seconds, fcl_seconds;
};

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

class Robot {
 public:
  explicit Robot(const fs::path& folder) {
    const std::string name = folder.filename().string();
    options_.package_dirs = {folder.string()};
    options_.meshes = MeshChoice::exact;  // FCL samples the triangles
    options_.geometry = GeometryChoice::collision;
    const fs::path urdf = folder / (name + ".urdf"), srdf = folder / (name + ".srdf");
    Mistakes mistakes(urdf.string());
    auto model = load_model(urdf, options_, mistakes);
    throw_if_any(mistakes);
    model_ = std::move(*model);
    Mistakes of_srdf(srdf.string());
    read_robot_meaning(srdf.string(), model_, of_srdf);
    throw_if_any(of_srdf);
    Mistakes of_links("");  // links that this variant does not have
    read_srdf(srdf.string(), model_, allowed_, of_links);
  }

  void judge(const fs::path& scene_file, const fs::path& request_file, const Options& options,
             Counts& counts) const {
    Mistakes mistakes(scene_file.string());
    const auto document = read_document(scene_file, mistakes);
    throw_if_any(mistakes);
    PlanningScene planning;
    with_lines(*document, mistakes, [&](Mistakes& found) {
      planning = read_planning_scene(*document, document->json, {}, model_, options_, found);
    });
    Model model = model_;
    throw_if_any(mistakes);
    add_to_model(planning, model, mistakes);
    throw_if_any(mistakes);
    if (!options.exact)
      for (ModelGeom& geom : model.geoms)
        if (geom.mesh && geom.touches == Touch::as_seen) geom.touches = Touch::as_hull;
    const Workcell cell = workcell_of(std::move(model), {}, &planning, allowed_, {});

    Mistakes of_request(request_file.string());
    const auto request = read_document(request_file, of_request);
    throw_if_any(of_request);
    Trajectory trajectory = read_trajectory(*request, cell.model, of_request);
    throw_if_any(of_request);
    divide(trajectory, options);
    Model posed = cell.model;
    const JointPath path = path_of(trajectory, posed, planning.state);

    const auto begin = std::chrono::steady_clock::now();
    const MotionVerdict verdict = verdict_of(path, cell.bodies, cell.pairs);
    counts.seconds.push_back(seconds_since(begin));
    ++counts.motions;
    const double first = path.times.front(), last = path.times.back();
    const auto time_of = [&](std::size_t i, std::size_t of) {
      return first + (last - first) * static_cast<double>(i) / static_cast<double>(of - 1);
    };
    if (verdict.status == MotionStatus::free) {
      ++counts.free;
      FclSampler meshes(cell, Triangles::of_meshes);
      for (std::size_t i = 0; i < options.states; ++i, ++counts.states)
        if (!meshes.colliding_pairs(path, time_of(i, options.states), true).empty()) {
          ++counts.false_free;
          std::printf("FALSE free: %s at %g\n", request_file.c_str(), time_of(i, options.states));
          break;
        }
    } else if (verdict.status == MotionStatus::collides) {
      ++counts.colliding;
      FclSampler hulls(cell, Triangles::of_hulls);
      for (const Stretch& stretch : verdict.stretches)
        if (stretch.collides && !hulls.collides(path, stretch.time, stretch.pair)) {
          ++(-stretch.upper < fcl_tolerance ? counts.grazing : counts.unconfirmed);
          std::printf("not confirmed: %s at %.9g: %s, %s by %g\n", request_file.c_str(),
                      stretch.time, cell.bodies[cell.pairs[stretch.pair].a].name.c_str(),
                      cell.bodies[cell.pairs[stretch.pair].b].name.c_str(), -stretch.upper);
        }
    } else {
      ++counts.undecided;
      std::printf("undecided: %s\n", request_file.c_str());
    }
    if (!options.fcl_time) return;
    FclSampler hulls(cell, Triangles::of_hulls);
    const auto fcl_begin = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < 1000; ++i) hulls.colliding_pairs(path, time_of(i, 1000), true);
    counts.fcl_seconds.push_back(seconds_since(fcl_begin));
  }

 private:
  /// The straight way, divided into `rows` rows.
  static void divide(Trajectory& trajectory, const Options& options) {
    const std::size_t rows = options.rows;
    const JointRow first = trajectory.rows.front(), last = trajectory.rows.back();
    trajectory.rows.clear();
    trajectory.rates.clear();
    trajectory.accelerations.clear();
    for (std::size_t i = 0; i < rows; ++i) {
      const double s =
          0.01 * static_cast<double>(options.percent * i) / static_cast<double>(rows - 1);
      JointRow row{static_cast<double>(i), first.values};
      for (std::size_t k = 0; k < row.values.size(); ++k)
        for (std::size_t n = 0; n < row.values[k].second.size(); ++n)
          row.values[k].second[n] += s * (last.values[k].second[n] - first.values[k].second[n]);
      trajectory.rows.push_back(std::move(row));
    }
  }

  ImportOptions options_;
  Model model_;
  AllowedPairs allowed_;
};

double median(std::vector<double> values, double part = 0.5) {
  if (values.empty()) return 0;
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
}

void print(const std::string& name, const Counts& counts) {
  std::printf("%-42s %6zu %6zu %9zu %9zu %4zu %10zu %11zu %7zu %8.2f %8.2f", name.c_str(),
              counts.motions, counts.free, counts.colliding, counts.undecided, counts.bad,
              counts.false_free, counts.unconfirmed, counts.grazing, 1e3 * median(counts.seconds),
              1e3 * median(counts.seconds, 0.99));
  if (!counts.fcl_seconds.empty()) std::printf(" %8.2f", 1e3 * median(counts.fcl_seconds));
  std::printf("\n");
  std::fflush(stdout);
}

void add(Counts& all, const Counts& more) {
  for (auto member :
       {&Counts::motions, &Counts::free, &Counts::colliding, &Counts::undecided, &Counts::bad,
        &Counts::false_free, &Counts::unconfirmed, &Counts::grazing, &Counts::states})
    all.*member += more.*member;
  all.seconds.insert(all.seconds.end(), more.seconds.begin(), more.seconds.end());
  all.fcl_seconds.insert(all.fcl_seconds.end(), more.fcl_seconds.begin(), more.fcl_seconds.end());
}

int run(const Options& options) {
  std::printf("%-42s %6s %6s %9s %9s %4s %10s %11s %7s %8s %8s\n", "set", "all", "free", "collide",
              "undecided", "bad", "false free", "unconfirmed", "grazing", "ms", "99 % ms");
  Counts all;
  for (std::size_t k = 0; k + 1 < options.folders.size(); k += 2) {
    const Robot robot(fs::path(options.folders[k]).lexically_normal());
    std::map<std::string, std::vector<fs::path>> sets;
    for (const auto& entry : fs::recursive_directory_iterator(options.folders[k + 1])) {
      const std::string file = entry.path().filename().string();
      if (file.starts_with("scene0") && file.ends_with(".yaml"))
        sets[entry.path().parent_path().filename().string()].push_back(entry.path());
    }
    for (auto& [name, scenes] : sets) {
      if (!options.set.empty() && name != options.set) continue;
      std::ranges::sort(scenes);
      Counts counts;
      for (const fs::path& scene : scenes) {
        std::string file = scene.filename().string();
        file.replace(0, std::strlen("scene"), "request");
        try {
          robot.judge(scene, scene.parent_path() / file, options, counts);
        } catch (const BadInput& error) {
          ++counts.bad;
          std::printf("%s\n", error.what());
        }
      }
      print(name, counts);
      add(all, counts);
    }
  }
  print("all", all);
  std::printf("FCL looked at %zu states of free motions\n", all.states);
  return all.false_free + all.unconfirmed + all.bad == 0 ? 0 : 1;
}

}  // namespace
}  // namespace minkray

int main(int argc, char** argv) {
  minkray::Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const auto number = [&](std::size_t& to) {
      const std::string text = i + 1 < argc ? argv[++i] : "";
      const auto [next, error] = std::from_chars(text.data(), text.data() + text.size(), to);
      return error == std::errc() && next == text.data() + text.size() && to >= 2;
    };
    bool is_good = true;
    if (word == "--states")
      is_good = number(options.states);
    else if (word == "--rows")
      is_good = number(options.rows);
    else if (word == "--percent")
      is_good = number(options.percent);
    else if (word == "--set" && i + 1 < argc)
      options.set = argv[++i];
    else if (word == "--exact")
      options.exact = true;
    else if (word == "--fcl-time")
      options.fcl_time = true;
    else if (word != "--")
      options.folders.push_back(word);
    if (!is_good) {
      std::fprintf(stderr, "%s: must be a whole number of at least 2\n", word.c_str());
      return 2;
    }
  }
  if (options.folders.empty() || options.folders.size() % 2 != 0) {
    std::fprintf(stderr, "no robots with problems: see ./run trial-motions\n");
    return 2;
  }
  try {
    int status = 0;
    minkray::with_threads(1, [&] { status = minkray::run(options); });
    return status;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  }
}
