// SPDX-License-Identifier: MIT
// C interface: verdicts on a robot's motion.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/parallel/parallel.h"
#include "renderer/base/build.h"
#include "renderer/io/output_file.h"
#include "renderer/library/handles/poses.h"
#include "renderer/library/handles/robot_among.h"
#include "renderer/verify/proof.h"
#include "renderer/verify/provable.h"
#include "renderer/verify/referee.h"

namespace minkray {
namespace {

/// First or second derivatives of the joints' values with respect to time, in the order of the
/// path's joints.
std::vector<std::vector<std::vector<double>>> derivatives_of(const HeldScene::Group& robot,
                                                             const JointPath& path,
                                                             const double* rates,
                                                             std::size_t rows) {
  std::vector<std::vector<std::vector<double>>> all;
  for (std::size_t row = 0; row < rows; ++row) {
    all.emplace_back();
    for (const ModelLink& link : path.skeleton.links)
      for (const ModelJoint& joint : link.joints) {
        double multiplier = 1;
        std::string leader = joint.name;
        for (const ModelJoint* at = &joint; at && at->mimic;) {
          multiplier *= at->mimic->multiplier;
          leader = at->mimic->joint;
          at = nullptr;
          for (const ModelLink& other : path.skeleton.links)
            for (const ModelJoint& one : other.joints)
              if (one.name == leader && one.mimic) at = &one;
        }
        std::vector<double> numbers;
        std::size_t first = 0;
        for (const auto& [name, width] : robot.joints) {
          if (name == leader && width == width_of(joint.kind))
            for (std::size_t i = 0; i < width; ++i)
              numbers.push_back(multiplier * rates[first + i]);
          first += width;
        }
        all.back().push_back(std::move(numbers));
      }
    std::size_t width = 0;
    for (const auto& joint : robot.joints) width += joint.second;
    rates += width;
  }
  return all;
}

minkray_verdict plain_verdict(const MotionVerdict& found, const std::vector<RefereePair>& pairs,
                              const RobotAmong& among, const Affine<double>& robot) {
  minkray_verdict plain = {};
  plain.status = static_cast<int32_t>(found.status);
  plain.lower = found.least.lower;
  plain.upper = found.least.upper;
  plain.row = plain.begin = plain.end = found.least.time;
  plain.object_a = plain.object_b = MINKRAY_NO_OBJECT;
  const auto name_pair = [&](std::size_t pair, const Vec3<double>& at) {
    plain.object_a = among.objects[pairs[pair].a];
    plain.object_b = among.objects[pairs[pair].b];
    const Vec3<double> point = robot(at);
    for (int k = 0; k < 3; ++k) plain.point[k] = point[k];
  };
  const LeastClearance& least = found.least;
  if (std::isfinite(least.upper))
    name_pair(least.pair, (least.distance.point_a + least.distance.point_b) / 2);
  // The first to collide is named, else the first that may.
  const Stretch* first = nullptr;
  for (const Stretch& stretch : found.stretches)
    if (!first || stretch.collides > first->collides ||
        (stretch.collides == first->collides && stretch.begin < first->begin))
      first = &stretch;
  if (!first) return plain;
  name_pair(first->pair, first->point);
  plain.begin = first->begin;
  plain.end = first->end;
  plain.row = first->collides ? first->time : first->begin;
  if (first->collides) plain.upper = first->upper;
  return plain;
}

struct VerdictCall {
  const double* path;
  const double* rates;
  std::size_t rows, numbers;
  minkray_verdict_options given;
};

void check_finite(const double* numbers, std::size_t count, const char* argument) {
  for (std::size_t i = 0; i < count; ++i)
    if (!std::isfinite(numbers[i])) wrong_use(std::string(argument) + ": must be finite numbers");
}

/// Writes a proof, except of an undecided motion.
void write_proof(const std::string& file, const MotionVerdict& found, const JointPath& path,
                 const RobotAmong& among, const std::vector<RefereePair>& pairs,
                 const RefereeOptions& options) {
  if (found.status == MotionStatus::undecided) return;
  const std::string text = proof_text(provable(found, path, among.bodies, pairs, options), path,
                                      {std::string(version_and_commit())});
  write_file(file, text);
}

void set_times(std::vector<JointRow>& rows, const double* times) {
  check_finite(times, rows.size(), "options.times");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i > 0 && !(times[i] > times[i - 1]))
      wrong_use("options.times[" + std::to_string(i) + "]: must be greater than " +
                std::to_string(times[i - 1]) + " (got " + std::to_string(times[i]) + ")");
    rows[i].time = times[i];
  }
}

/// The position of a time between the rows: 2.25 is a quarter of the way from row 2 to row 3.
double row_of(double time, const std::vector<double>& times) {
  if (times.size() < 2) return 0;
  const auto next = std::upper_bound(times.begin() + 1, times.end() - 1, time);
  const double from = *(next - 1), to = *next;
  return static_cast<double>(next - 1 - times.begin()) + (time - from) / (to - from);
}

minkray_verdict judge(const HeldScene& held, const HeldScene::Group& robot,
                      const VerdictCall& asked) {
  std::vector<JointRow> read = rows_of(robot, asked.path, asked.rows, asked.numbers);
  if (asked.given.times) set_times(read, asked.given.times);
  const RobotAmong among(held, robot, asked.given.only_obstacles == 0);
  JointPath path = path_of(*robot.model, read);
  const double* const accelerations = asked.given.accelerations;
  if (asked.rates) {
    check_finite(asked.rates, asked.rows * asked.numbers, "rates");
    path.rates = derivatives_of(robot, path, asked.rates, read.size());
  }
  if (accelerations) {
    if (!asked.rates) wrong_use("options.accelerations: must have rates");
    check_finite(accelerations, asked.rows * asked.numbers, "options.accelerations");
    path.accelerations = derivatives_of(robot, path, accelerations, read.size());
  }
  std::vector<RefereePair> pairs;
  for (const BodyPair& pair : among.pairs) {
    const bool is_obstacle =
        among.bodies[pair.a].link_index < 0 || among.bodies[pair.b].link_index < 0;
    pairs.push_back({pair.a, pair.b, is_obstacle ? asked.given.margin : 0});
  }
  RefereeOptions options;
  if (asked.given.tolerance > 0) options.tolerance = asked.given.tolerance;
  if (asked.given.budget > 0) options.budget = asked.given.budget;
  options.keep_planes = asked.given.proof != nullptr;
  const MotionVerdict found = verdict_of(path, among.bodies, pairs, options);
  throw_if_lied(held.customs());
  if (asked.given.proof) write_proof(asked.given.proof, found, path, among, pairs, options);
  minkray_verdict verdict = plain_verdict(found, pairs, among, robot.pose);
  if (asked.given.times)
    for (double* const at : {&verdict.row, &verdict.begin, &verdict.end})
      *at = row_of(*at, path.times);
  return verdict;
}

}  // namespace
}  // namespace minkray

using namespace minkray;

extern "C" {

int minkray_scene_verify(minkray_scene scene, uint32_t group, const double* path,
                         const double* rates, size_t rows, size_t numbers,
                         const minkray_verdict_options* options, minkray_verdict* verdict) {
  return call("minkray_scene_verify", [&] {
    require(verdict, "verdict");
    const SceneQuery held(scene);
    held->world();  // checks that the scene is committed
    const HeldScene::Group& robot = held->group(group);
    if (!robot.model) wrong_use("group: must be a robot's, from URDF, MJCF, SDF or glTF");
    if (!is_rigid(robot.pose)) wrong_use("group: must have a pose that keeps lengths");
    minkray_verdict_options given = {};
    if (options) {
      if (options->size < offsetof(minkray_verdict_options, accelerations))
        wrong_use("options.size: must be sizeof(minkray_verdict_options)");
      std::memcpy(&given, options, std::min(options->size, sizeof given));
    }
    if (!(given.tolerance >= 0 && given.tolerance <= 1))
      wrong_use("options.tolerance: must be between 0 and 1 (got " +
                std::to_string(given.tolerance) + ")");
    if (!(given.margin >= 0 && std::isfinite(given.margin)))
      wrong_use("options.margin: must be at least 0 (got " + std::to_string(given.margin) + ")");
    with_threads(checked_threads(given.threads), [&] {
      *verdict = judge(*held, robot, {path, rates, rows, numbers, given});
    });
  });
}

}  // extern "C"
