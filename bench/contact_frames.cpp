// SPDX-License-Identifier: MIT
// Benefit of a memory of pairs from frame to frame (core/pair/pair_memory.h) on real motion:
//   contact-frames [--bodies N] [--frames N] [ROBOT JOINTS.csv]
// Each query runs without and with a memory per pair, in turns: one thread, processor time. Bodies
// tumble through a room; with ROBOT, links move along a path as `minkray clearance` takes it.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <random>
#include <string>

#include "core/pair_motion/impact.h"
#include "core/world/near_pairs.h"
#include "renderer/clearance/bodies.h"
#include "renderer/clearance/step_motion.h"
#include "renderer/import/import.h"
#include "renderer/json/mistakes.h"

namespace {

using namespace minkray;

/// Cost of one query about one pair, without and with its memory.
/// Queries: signed distance, overlap, contact within the frame; of tumbling bodies in each frame
/// for all pairs whose boxes are nearer than a tenth of a body.
struct Cost {
  double anew = 0, kept = 0;  ///< nanoseconds of all queries
  long supports_anew = 0, supports_kept = 0, queries = 0;
  double furthest = 0;  ///< difference of the two results, in sizes
};

struct Asked {
  const ContactShape* a;
  const ContactShape* b;
  RigidMotion of_a, of_b;  ///< of this frame
  PairMemory* memory;
};

double now() {
  return 1e9 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Queries all pairs of a frame of the same kinds, repeatedly, so that the clock has something to
/// measure.
template <class Ask>
void ask_all(const std::vector<Asked>& pairs, Cost& cost, const Ask& ask) {
  constexpr int rounds = 3;
  std::vector<std::pair<double, int>> anew(pairs.size()), kept(pairs.size());
  std::vector<PairMemory> before;
  before.reserve(pairs.size());
  for (const Asked& pair : pairs) before.push_back(*pair.memory);
  double best_anew = std::numeric_limits<double>::infinity(), best_kept = best_anew;
  for (int round = 0; round < rounds; ++round) {
    double start = now();
    for (std::size_t i = 0; i < pairs.size(); ++i) anew[i] = ask(pairs[i], nullptr);
    best_anew = std::min(best_anew, now() - start);
    for (std::size_t i = 0; i < pairs.size(); ++i) *pairs[i].memory = before[i];
    start = now();
    for (std::size_t i = 0; i < pairs.size(); ++i) kept[i] = ask(pairs[i], pairs[i].memory);
    best_kept = std::min(best_kept, now() - start);
  }
  cost.anew += best_anew;
  cost.kept += best_kept;
  cost.queries += static_cast<long>(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    cost.supports_anew += anew[i].second;
    cost.supports_kept += kept[i].second;
    const double size = pairs[i].a->ball_radius() + pairs[i].b->ball_radius();
    if (std::isfinite(anew[i].first) && std::isfinite(kept[i].first))
      cost.furthest = std::max(cost.furthest, std::abs(anew[i].first - kept[i].first) / size);
  }
}

std::pair<double, int> distance(const Asked& pair, PairMemory* memory, bool only_sign) {
  SignedDistanceOptions options;
  options.only_sign = only_sign;
  const SignedDistance found =
      memory ? signed_distance(*pair.a, pair.of_a.pose, *pair.b, pair.of_b.pose, *memory, options)
             : signed_distance(*pair.a, pair.of_a.pose, *pair.b, pair.of_b.pose, options);
  return {only_sign ? 0 : found.value, found.supports};
}

std::pair<double, int> impact(const Asked& pair, PairMemory* memory, double t_max) {
  ImpactOptions options;
  options.points_of_misses = false;
  const Impact found =
      memory ? first_impact(*pair.a, pair.of_a, *pair.b, pair.of_b, t_max, *memory, options)
             : first_impact(*pair.a, pair.of_a, *pair.b, pair.of_b, t_max, options);
  return {found.status == ImpactStatus::hit ? 0 : 0, found.steps};
}

using Costs = std::map<std::string, Cost>;

void print(const char* what, const Costs& costs) {
  std::printf(
      "\n%s\n\n| pair | queries | ns anew | ns kept | times | supports anew | kept |\n"
      "|---|---|---|---|---|---|---|\n",
      what);
  for (const auto& [name, cost] : costs) {
    const auto n = static_cast<double>(cost.queries);
    std::printf("| %s | %ld | %.0f | %.0f | %.2f | %.2f | %.2f |\n", name.c_str(), cost.queries,
                cost.anew / n, cost.kept / n, cost.anew / cost.kept,
                static_cast<double>(cost.supports_anew) / n,
                static_cast<double>(cost.supports_kept) / n);
  }
  std::fflush(stdout);
}

void add_all(Costs& costs, const std::string& those) {
  Cost all;
  for (const auto& [name, cost] : costs) {
    if (name.find(those) == std::string::npos || name.starts_with("~")) continue;
    all.anew += cost.anew;
    all.kept += cost.kept;
    all.supports_anew += cost.supports_anew;
    all.supports_kept += cost.supports_kept;
    all.queries += cost.queries;
    all.furthest = std::max(all.furthest, cost.furthest);
  }
  costs["~ all" + those] = all;
}

/// Keys of pairs to their memories.
using Memories = std::map<std::pair<std::size_t, std::size_t>, std::array<PairMemory, 4>>;

class Room {
 public:
  Room(std::size_t count, unsigned seed) : engine_(seed) {
    half_ = 0.5 * std::cbrt(static_cast<double>(count) * volume_a_body);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t kind = i % names.size();
      bodies_.push_back({ContactShape(shape(kind)), {turn(), in_cube(half_)}});
      velocities_.push_back(2 * direction() * in(0, 1));
      spins_.push_back(4 * direction() * in(0, 1));
      kinds_.push_back(kind);
    }
  }

  static constexpr std::array<const char*, 7> names = {"box",  "cylinder",  "cone",   "hull 32",
                                                       "ball", "ellipsoid", "capsule"};
  static constexpr double frame_time = 1.0 / 60;

  const std::vector<ContactBody>& bodies() const { return bodies_; }
  std::size_t kind(std::size_t body) const { return kinds_[body]; }
  RigidMotion motion(std::size_t i, bool turns) const {
    return {bodies_[i].pose, velocities_[i], turns ? spins_[i] : Vec3<double>(0, 0, 0)};
  }

  /// Each flies on and turns on; at the walls it turns back.
  void advance() {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      bodies_[i].pose = motion(i, true).at(frame_time);
      for (int k = 0; k < 3; ++k)
        if (std::abs(bodies_[i].pose.translation[k]) > half_)
          velocities_[i][k] = std::copysign(velocities_[i][k], -bodies_[i].pose.translation[k]);
    }
  }

 private:
  static constexpr double volume_a_body = 6;

  double in(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_()) / 18446744073709551616.0);
  }
  Vec3<double> in_cube(double half) {
    const double x = in(-half, half), y = in(-half, half), z = in(-half, half);
    return {x, y, z};
  }
  Vec3<double> direction() {
    for (;;)
      if (const Vec3<double> p = in_cube(1); p.norm() <= 1 && p.norm() > 0.1) return p.normalized();
  }
  Mat3<double> turn() {
    const Vec3<double> axis = direction();
    return Eigen::AngleAxis<double>(in(0, 3), axis).toRotationMatrix();
  }
  Shape shape(std::size_t kind) {
    switch (kind) {
      case 0:
        return Box{{0.6, 0.4, 0.3}};
      case 1:
        return Cylinder{0.4, 0.5};
      case 2:
        return Cone{0.5, 0.5};
      case 3: {
        std::vector<Vec3<double>> points;
        for (int i = 0; i < 32; ++i) points.push_back(0.6 * direction());
        return Hull{PointCloud(points)};
      }
      case 4:
        return Sphere{0.5};
      case 5:
        return Ellipsoid{{0.7, 0.5, 0.3}};
      default:
        return Capsule{0.3, 0.4};
    }
  }

  std::mt19937_64 engine_;
  double half_;
  std::vector<ContactBody> bodies_;
  std::vector<Vec3<double>> velocities_, spins_;
  std::vector<std::size_t> kinds_;
};

void tumble(std::size_t count, int frames) {
  Room room(count, 7);
  Memories memories;
  Costs distances, signs, impacts, turning;
  std::size_t near = 0;
  for (int frame = 0; frame < frames; ++frame, room.advance()) {
    NearPairsOptions options;
    options.at_most = 0.5;
    const std::vector<NearPair> pairs = near_pairs(ContactWorld(room.bodies()), options);
    near += pairs.size();
    std::map<std::string, std::array<std::vector<Asked>, 4>> groups;
    Memories of_frame;
    for (const NearPair& pair : pairs) {
      const auto key = std::make_pair(pair.a, pair.b);
      const auto former = memories.find(key);
      auto& memory = of_frame[key];
      if (former != memories.end()) memory = former->second;
      const std::size_t kind_a = std::min(room.kind(pair.a), room.kind(pair.b)),
                        kind_b = std::max(room.kind(pair.a), room.kind(pair.b));
      const char* how = pair.distance.upper < 0 ? ", overlapping" : ", apart";
      auto& group = groups[std::string(Room::names[kind_a]) + ", " + Room::names[kind_b] + how];
      const ContactShape *a = &room.bodies()[pair.a].shape, *b = &room.bodies()[pair.b].shape;
      for (std::size_t i = 0; i < 4; ++i)
        group[i].push_back(
            {a, b, room.motion(pair.a, i == 3), room.motion(pair.b, i == 3), &memory[i]});
    }
    for (const auto& [name, group] : groups) {
      ask_all(group[0], distances[name],
              [](const Asked& pair, PairMemory* memory) { return distance(pair, memory, false); });
      ask_all(group[1], signs[name],
              [](const Asked& pair, PairMemory* memory) { return distance(pair, memory, true); });
      ask_all(group[2], impacts[name], [](const Asked& pair, PairMemory* memory) {
        return impact(pair, memory, Room::frame_time);
      });
      ask_all(group[3], turning[name], [](const Asked& pair, PairMemory* memory) {
        return impact(pair, memory, Room::frame_time);
      });
    }
    memories = std::move(of_frame);
  }
  for (Costs* costs : {&distances, &signs, &impacts, &turning})
    for (const char* those : {", apart", ", overlapping"}) add_all(*costs, those);
  std::printf("%zu bodies, %d frames, %.0f near pairs a frame; answers differ by %.0e sizes\n",
              count, frames, static_cast<double>(near) / frames,
              distances["~ all, apart"].furthest);
  print("Signed distances, depths included", distances);
  print("Overlap alone, distances of those apart", signs);
  print("Whether they touch within the frame, not turning", impacts);
  print("Whether they touch within the frame, turning (steps for supports)", turning);
}

void walk(const std::string& robot, const std::string& joints) {
  Mistakes mistakes(robot);
  ImportOptions import;
  import.geometry = GeometryChoice::collision;
  import.joint_rows = joints;
  std::optional<Model> model = load_model(robot, import, mistakes);
  throw_if_any(mistakes);
  pose_model(*model, import, mistakes);
  const std::vector<JointRow> rows = read_joint_rows(joints, *model, mistakes, "--path");
  throw_if_any(mistakes);
  const std::vector<ClearanceBody> bodies = bodies_of(*model, import.geometry);
  const std::vector<BodyPair> pairs = pairs_of(bodies, *model, {}, true);
  const JointPath path(*model, rows);
  std::vector<PairMemory> memories(pairs.size());
  Costs costs;
  constexpr int samples = 60;
  for (std::size_t step = 0; step < path.steps(); ++step) {
    StepMotion motion(path, step);
    for (int i = 0; i < samples; ++i) {
      const auto& links = motion.links_at(static_cast<double>(i) / samples);
      const auto pose = [&](const ClearanceBody& body) {
        return body.link_index < 0 ? Affine<double>()
                                   : links[static_cast<std::size_t>(body.link_index)];
      };
      std::vector<Asked> asked;
      for (std::size_t p = 0; p < pairs.size(); ++p) {
        const ClearanceBody &a = bodies[pairs[p].a], &b = bodies[pairs[p].b];
        if (a.plane || b.plane) continue;
        asked.push_back({&a.shape, &b.shape, {pose(a)}, {pose(b)}, &memories[p]});
      }
      ask_all(asked, costs["links"],
              [](const Asked& pair, PairMemory* memory) { return distance(pair, memory, false); });
    }
  }
  std::printf("\n%s: %zu pairs, answers differ by %.0e sizes\n", robot.c_str(), pairs.size(),
              costs["links"].furthest);
  print("Signed distances of all pairs of links, 60 times a step of the path", costs);
}

}  // namespace

int main(int count, char** words) {
  std::size_t bodies = 10000;
  int frames = 20;
  std::vector<std::string> files;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    if (word == "--bodies" && i + 1 < count)
      bodies = static_cast<std::size_t>(std::max(2, std::atoi(words[++i])));
    else if (word == "--frames" && i + 1 < count)
      frames = std::max(1, std::atoi(words[++i]));
    else
      files.push_back(word);
  }
  try {
    if (files.size() == 2)
      walk(files[0], files[1]);
    else
      tumble(bodies, frames);
  } catch (const std::exception& wrong) {
    std::fprintf(stderr, "contact-frames: %s\n", wrong.what());
    return 1;
  }
  return 0;
}
