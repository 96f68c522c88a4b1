// SPDX-License-Identifier: MIT
// A robot's path in a scene: its rows of joint values, and all obstacles.
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "renderer/base/errors.h"
#include "renderer/clearance/bodies.h"
#include "renderer/clearance/step_motion.h"
#include "renderer/library/handles/call.h"
#include "renderer/library/handles/held_scene.h"
#include "renderer/library/handles/work_on_rays.h"

namespace minkray {

/// One row of numbers as values of the joints, in their order.
inline JointRow row_of(const HeldScene::Group& robot, const double* numbers, std::size_t index) {
  JointRow row;
  row.time = static_cast<double>(index);
  for (const auto& [name, width] : robot.joints) {
    row.values.emplace_back(name, std::vector<double>(numbers, numbers + width));
    numbers += width;
  }
  return row;
}

inline std::vector<JointRow> rows_of(const HeldScene::Group& robot, const double* path,
                                     std::size_t rows, std::size_t numbers) {
  std::size_t width = 0;
  for (const auto& joint : robot.joints) width += joint.second;
  if (numbers != width)
    wrong_use("numbers: must be " + std::to_string(width) + ", for all joints of the group (got " +
              std::to_string(numbers) + ")");
  if (rows == 0) wrong_use("rows: must be at least 1");
  if (width > 0) require(path, "path");
  require_room(rows, sizeof(double) * (width + 1), "rows");
  for (std::size_t i = 0; i < rows * width; ++i)
    if (!std::isfinite(path[i]))
      wrong_use("path[" + std::to_string(i / width) + "][" + std::to_string(i % width) +
                "]: must be a finite number (got " + std::to_string(path[i]) + ")");
  std::vector<JointRow> read;
  // A robot without joints rests all the time: rows of nothing cost its caller nothing.
  for (std::size_t i = 0; i < (width > 0 ? rows : 1); ++i)
    read.push_back(row_of(robot, path + i * width, i));
  return read;
}

inline JointPath path_of(const Model& model, const std::vector<JointRow>& rows) {
  try {
    return JointPath(model, rows);
  } catch (const BadInput& error) {
    wrong_use(error.what());
  }
}

/// Everything else in the scene as the robot's own frame has it.
inline void add_obstacles(const HeldScene& held, const HeldScene::Group& robot,
                          std::vector<ClearanceBody>& bodies, std::vector<std::uint32_t>& objects) {
  const Scene whole = held.whole();
  std::vector<ClearanceBody> all = bodies_of(whole);
  const std::vector<std::uint32_t> numbers = objects_of_bodies(whole);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::uint32_t object = numbers[i];
    if (held.is_removed(object)) continue;
    if (object >= robot.first && object - robot.first < robot.count) continue;
    bodies.push_back(seen_from(robot.pose, std::move(all[i])));
    objects.push_back(object);
  }
}

/// A robot and all that it may meet.
struct RobotAmong {
  std::vector<ClearanceBody> bodies;
  std::vector<std::uint32_t> objects;
  std::vector<BodyPair> pairs;

  RobotAmong(const HeldScene& held, const HeldScene::Group& robot, bool self) {
    std::uint32_t index = 0;
    for (ClearanceBody& body : bodies_of(*robot.model, robot.options.geometry)) {
      const std::uint32_t object = robot.first + index++;
      if (held.is_removed(object)) continue;
      bodies.push_back(std::move(body));
      objects.push_back(object);
    }
    if (bodies.empty())
      wrong_use("group: must have shapes (got a robot without any of the chosen geometry)");
    add_obstacles(held, robot, bodies, objects);
    pairs = pairs_of(bodies, *robot.model, {}, self);
    std::erase_if(pairs, [&](const BodyPair& pair) {
      return !held.pair_rules().are_pair(objects[pair.a], objects[pair.b]);
    });
  }
};

}  // namespace minkray
