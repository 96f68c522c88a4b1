// SPDX-License-Identifier: MIT
// C interface: clearance of a robot's path.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/parallel/parallel.h"
#include "renderer/base/errors.h"
#include "renderer/clearance/clearance.h"
#include "renderer/clearance/clearance_derivative.h"
#include "renderer/library/handles/call.h"
#include "renderer/library/handles/held_scene.h"
#include "renderer/library/handles/poses.h"
#include "renderer/library/handles/robot_among.h"
#include "renderer/library/handles/work_on_rays.h"

namespace minkray {
namespace {

minkray_clearance plain_clearance(const Closest& found, const Affine<double>& robot,
                                  const std::vector<std::uint32_t>& objects) {
  minkray_clearance plain = {};
  plain.lower = found.lower;
  plain.upper = found.upper;
  plain.row = found.time;
  plain.is_settled = found.is_settled ? 1 : 0;
  plain.object_a = plain.object_b = MINKRAY_NO_OBJECT;
  if (!std::isfinite(found.upper)) return plain;
  plain.object_a = objects[found.a];
  plain.object_b = objects[found.b];
  const Vec3<double> a = robot(found.distance.point_a), b = robot(found.distance.point_b);
  const Vec3<double> n = robot.linear * found.distance.normal;
  for (int k = 0; k < 3; ++k) {
    plain.point_a[k] = a[k];
    plain.point_b[k] = b[k];
    plain.normal[k] = n[k];
  }
  return plain;
}

/// Output of derivatives: a row of numbers for each step, and a flag; null if they are not wanted.
struct DerivativeRoom {
  double* jac = nullptr;
  std::uint8_t* is_ridge = nullptr;
  double* jac_error = nullptr;

  explicit operator bool() const { return jac || is_ridge || jac_error; }
};

void find_derivatives(const Clearance& found, const JointPath& path, const RobotAmong& among,
                      const JointWidths& joints, std::size_t steps, std::size_t numbers,
                      const DerivativeRoom& room) {
  parallel_for(steps, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t step = std::min(i, path.steps() - 1);
      const ClearanceDerivative derivative =
          derivative_of(step < found.steps.size() ? found.steps[step] : Closest{}, path,
                        among.bodies, among.pairs, joints, room.jac_error != nullptr);
      if (room.jac) std::ranges::copy(derivative.by_joints, room.jac + i * numbers);
      if (room.jac_error) std::ranges::copy(derivative.errors, room.jac_error + i * numbers);
      if (room.is_ridge) room.is_ridge[i] = derivative.is_ridge ? 1 : 0;
    }
  });
}

struct ClearanceCall {
  const double* path;
  std::size_t rows, numbers;
  minkray_clearance* steps;
  minkray_clearance* least;
  DerivativeRoom derivatives;
};

void find_clearance(const HeldScene& held, const HeldScene::Group& robot,
                    const std::vector<JointRow>& read, const minkray_clearance_options& given,
                    const ClearanceCall& asked) {
  const RobotAmong among(held, robot, given.only_obstacles == 0);
  ClearanceOptions options;
  if (given.tolerance > 0) options.tolerance = given.tolerance;
  options.every_step = asked.steps || asked.derivatives;
  const JointPath path = path_of(*robot.model, read);
  const Clearance found = clearance_of(path, among.bodies, among.pairs, options);
  throw_if_lied(held.customs());
  if (asked.least) *asked.least = plain_clearance(found.closest, robot.pose, among.objects);
  const std::size_t steps = std::max<std::size_t>(asked.rows - 1, 1);
  for (std::size_t i = 0; asked.steps && i < steps; ++i) {
    const std::size_t step = std::min(i, path.steps() - 1);
    minkray_clearance& to = asked.steps[i];
    to = plain_clearance(step < found.steps.size() ? found.steps[step] : Closest{}, robot.pose,
                         among.objects);
    to.row += static_cast<double>(i - step);
  }
  if (!asked.derivatives) return;
  find_derivatives(found, path, among, robot.joints, steps, asked.numbers, asked.derivatives);
  throw_if_lied(held.customs());
}

void clearance_call(minkray_scene scene, std::uint32_t group,
                    const minkray_clearance_options* options, const ClearanceCall& asked) {
  const SceneQuery held(scene);
  held->world();  // checks that the scene is committed
  const HeldScene::Group& robot = held->group(group);
  if (!robot.model) wrong_use("group: must be a robot's, from URDF, MJCF, SDF or glTF");
  if (!is_rigid(robot.pose)) wrong_use("group: must have a pose that keeps lengths");
  minkray_clearance_options given = {sizeof given, 0, 0, 0, nullptr};
  if (options) {
    if (options->size < offsetof(minkray_clearance_options, jac_error))
      wrong_use("options.size: must be sizeof(minkray_clearance_options)");
    std::memcpy(&given, options, std::min(options->size, sizeof given));
  }
  if (!(given.tolerance >= 0 && given.tolerance <= 1))
    wrong_use("options.tolerance: must be between 0 and 1 (got " + std::to_string(given.tolerance) +
              ")");
  const std::vector<JointRow> read = rows_of(robot, asked.path, asked.rows, asked.numbers);
  with_threads(checked_threads(given.threads),
               [&] { find_clearance(*held, robot, read, given, asked); });
}

/// Null for programs that were compiled before there was one.
double* jac_error_of(const minkray_clearance_options* options) {
  return options && options->size >= sizeof *options ? options->jac_error : nullptr;
}

}  // namespace
}  // namespace minkray

using namespace minkray;

extern "C" {

int minkray_scene_clearance(minkray_scene scene, uint32_t group, const double* path, size_t rows,
                            size_t numbers, const minkray_clearance_options* options,
                            minkray_clearance* steps, minkray_clearance* least) {
  return call("minkray_scene_clearance", [&] {
    clearance_call(scene, group, options, {path, rows, numbers, steps, least, {}});
  });
}

int minkray_scene_clearance_derivatives(minkray_scene scene, uint32_t group, const double* path,
                                        size_t rows, size_t numbers,
                                        const minkray_clearance_options* options,
                                        minkray_clearance* steps, double* jac, uint8_t* is_ridge) {
  return call("minkray_scene_clearance_derivatives", [&] {
    clearance_call(scene, group, options,
                   {path, rows, numbers, steps, nullptr, {jac, is_ridge, jac_error_of(options)}});
  });
}

}  // extern "C"
