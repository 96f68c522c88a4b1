// SPDX-License-Identifier: MIT
#include "renderer/plan/trajectory.h"

#include <algorithm>
#include <map>
#include <set>

#include "renderer/json/closest_word.h"
#include "renderer/json/object_reader.h"
#include "renderer/json/values.h"
#include "renderer/plan/message_fields.h"
#include "renderer/plan/message_values.h"
#include "renderer/plan/robot_meaning.h"

namespace minkray {
namespace {

/// Limit of mistakes: files with more repeat the same one.
constexpr std::size_t most_mistakes = 20;

class TrajectoryReader {
 public:
  TrajectoryReader(const Model& model, Mistakes& mistakes) : model_(model), mistakes_(mistakes) {
    for (const ModelLink& link : model.links)
      for (const ModelJoint& joint : link.joints)
        if (joint.kind != JointKind::fixed) joints_.emplace(joint.name, &joint);
  }

  Trajectory read(const Json& message, const JsonPath& path) {
    find(message, path);
    if (!is_found_ && mistakes_.none())
      mistakes_.add(path,
                    "must be a trajectory: joint_names and points (JointTrajectory), "
                    "joint_trajectory (RobotTrajectory), or a request of start_state and "
                    "goal_constraints");
    if (mistakes_.none()) check_times();
    return std::move(trajectory_);
  }

 private:
  /// Searches messages that contain a trajectory.
  void find(const Json& message, const JsonPath& path) {
    if (is_found_ || !mistakes_.none()) return;
    if (message.is_array()) {  // DisplayTrajectory has a list, which one robot follows in order
      for (std::size_t i = 0; i < message.size(); ++i) {
        is_found_ = false;
        find(message[i], path / i);
      }
      return;
    }
    if (message.is_object()) check_fields(message, Message::with_trajectory, path, mistakes_);
    for (const std::string_view key : {"trajectory_start", "start_state"})
      if (const Json* state = member_of(message, key))
        for (auto& value :
             read_robot_state(*state, path / key, model_, trajectory_.notes, mistakes_))
          trajectory_.start.push_back(std::move(value));
    if (member_of(message, "points")) {
      is_found_ = true;
      return add_joint_trajectory(message, path);
    }
    const Json* joints = member_of(message, "joint_trajectory");
    const Json* multi = member_of(message, "multi_dof_joint_trajectory");
    if (joints || multi) {
      is_found_ = true;
      return add_robot_trajectory(joints, multi, path);
    }
    if (const Json* goals = member_of(message, "goal_constraints")) {
      is_found_ = true;
      return add_request(*goals, path / "goal_constraints");
    }
    for (const std::string_view key :
         {"trajectory", "planned_trajectory", "solution", "motion_plan_response", "response",
          "motion_plan_request", "request", "result", "goal"})
      if (const Json* inner = member_of(message, key)) find(*inner, path / key);
  }

  const ModelJoint* joint_of(const std::string& name, const JsonPath& path) {
    const auto found = joints_.find(name);
    if (found != joints_.end()) return found->second;
    if (mistakes_.messages().size() >= most_mistakes) return nullptr;
    std::vector<std::string> names;
    for (const auto& [one, joint] : joints_) names.push_back(one);
    mistakes_.add(path, "there is no joint \"" + printable(name, 60) + "\" that moves (" +
                            suggestion(name, names) + ")");
    return nullptr;
  }

  std::vector<const ModelJoint*> joints_of(const Json& json, const JsonPath& path) {
    std::vector<const ModelJoint*> joints;
    const Json* list = member_of(json, "joint_names");
    if (!list) {
      mistakes_.add(path / "joint_names", "missing: must be a list of joints");
      return joints;
    }
    std::size_t index = 0;
    std::set<std::string> names;
    for (const std::string& name : read_name_list(*list, path / "joint_names", mistakes_)) {
      if (!names.insert(name).second)
        mistakes_.add(path / "joint_names" / index,
                      "duplicate: \"" + printable(name, 60) + "\" is named twice");
      joints.push_back(joint_of(name, path / "joint_names" / index++));
    }
    return joints;
  }

  /// Reads one number per joint; none if the list is empty or missing.
  JointValues numbers_of(const Json& point, std::string_view key, const JsonPath& path,
                         const std::vector<const ModelJoint*>& joints) {
    JointValues values;
    const Json* list = member_of(point, key);
    if (!list) return values;
    const std::vector<double> numbers = read_number_list(*list, path / key, mistakes_);
    if (numbers.empty()) return values;
    if (numbers.size() != joints.size()) {
      mistakes_.add(path / key, "must have a number for each of the " +
                                    std::to_string(joints.size()) + " joints (got " +
                                    std::to_string(numbers.size()) + ")");
      return values;
    }
    for (std::size_t k = 0; k < numbers.size(); ++k)
      if (joints[k] && !joints[k]->mimic)
        values.emplace_back(joints[k]->name, std::vector{numbers[k]});
    return values;
  }

  double time_of(const Json& point, const JsonPath& path) {
    const Json* time = member_of(point, "time_from_start");
    if (!time) return 0;
    return read_message_duration(*time, path / "time_from_start", mistakes_).value_or(0);
  }

  void add_joint_trajectory(const Json& json, const JsonPath& path) {
    check_fields(json, Message::joint_trajectory, path, mistakes_);
    points_ = path / "points";
    const std::vector<const ModelJoint*> joints = joints_of(json, path);
    for (std::size_t k = 0; k < joints.size(); ++k)
      if (joints[k] && width_of(joints[k]->kind) != 1)
        mistakes_.add(path / "joint_names" / k,
                      "must be a joint of one number; others are in multi_dof_joint_trajectory");
    const Json& points = list_of(json, "points", path, mistakes_);
    for (std::size_t i = 0; i < points.size() && mistakes_.messages().size() < most_mistakes; ++i) {
      const JsonPath at = path / "points" / i;
      check_fields(points[i], Message::joint_trajectory_point, at, mistakes_);
      JointRow row{time_of(points[i], at), numbers_of(points[i], "positions", at, joints)};
      if (row.values.empty() && mistakes_.none())
        mistakes_.add(at / "positions", "missing: must be a number for each joint");
      trajectory_.rates.push_back(numbers_of(points[i], "velocities", at, joints));
      trajectory_.accelerations.push_back(numbers_of(points[i], "accelerations", at, joints));
      add_row(std::move(row));
    }
  }

  /// Trajectories of a list are joined, each from its own time 0.
  void add_row(JointRow row) {
    if (is_new_part_ && !trajectory_.rows.empty()) before_ = trajectory_.rows.back().time;
    is_new_part_ = false;
    row.time += before_;
    trajectory_.rows.push_back(std::move(row));
  }

  void add_robot_trajectory(const Json* of_joints, const Json* of_poses, const JsonPath& path) {
    is_new_part_ = true;
    const std::size_t first = trajectory_.rows.size();
    points_ = path / (of_joints ? "joint_trajectory" : "multi_dof_joint_trajectory") / "points";
    if (of_joints)
      check_fields(*of_joints, Message::joint_trajectory, path / "joint_trajectory", mistakes_);
    if (of_joints && !list_of(*of_joints, "points", path / "joint_trajectory", mistakes_).empty())
      add_joint_trajectory(*of_joints, path / "joint_trajectory");
    if (!of_poses) return;
    const JsonPath at = path / "multi_dof_joint_trajectory";
    check_fields(*of_poses, Message::poses_trajectory, at, mistakes_);
    const Json& points = list_of(*of_poses, "points", at, mistakes_);
    if (points.empty()) return;
    const std::vector<const ModelJoint*> joints = joints_of(*of_poses, at);
    const bool is_alone = trajectory_.rows.size() == first;
    if (!is_alone && trajectory_.rows.size() - first != points.size())
      return mistakes_.add(at / "points", "must be as many as those of joint_trajectory (" +
                                              std::to_string(trajectory_.rows.size() - first) +
                                              "; got " + std::to_string(points.size()) + ")");
    for (std::size_t i = 0; i < points.size(); ++i) {
      const JsonPath point = at / "points" / i;
      if (i == 0 && !list_of(points[i], "velocities", point, mistakes_).empty())
        trajectory_.notes.push_back(at.text() + ": velocities are ignored: poses go straight");
      check_fields(points[i], Message::poses_trajectory_point, point, mistakes_);
      JointValues values;
      const Json& transforms = list_of(points[i], "transforms", point, mistakes_);
      if (transforms.size() != joints.size())
        mistakes_.add(point / "transforms",
                      "must have one for each of the " + std::to_string(joints.size()) + " joints");
      for (std::size_t k = 0; k < std::min(transforms.size(), joints.size()); ++k) {
        if (!joints[k]) continue;
        if (!add_values_of_transform(transforms[k], point / "transforms" / k, model_, *joints[k],
                                     values, mistakes_))
          mistakes_.add(at / "joint_names" / k, "must be a floating or a planar joint");
      }
      if (!is_alone) {
        for (auto& value : values) trajectory_.rows[first + i].values.push_back(std::move(value));
        continue;
      }
      trajectory_.rates.emplace_back();
      trajectory_.accelerations.emplace_back();
      add_row({time_of(points[i], point), std::move(values)});
    }
  }

  /// Goes from the start straight to the first goal.
  void add_request(const Json& goals, const JsonPath& path) {
    if (!goals.is_array() || goals.empty()) return mistakes_.add(path, "must be a list of goals");
    const JsonPath at = path / std::size_t{0} / "joint_constraints";
    check_fields(goals[0], Message::constraints, path / std::size_t{0}, mistakes_);
    if (!mistakes_.none()) return;
    const Json& constraints =
        list_of(goals[0], "joint_constraints", path / std::size_t{0}, mistakes_);
    if (constraints.empty()) return mistakes_.add(at, "missing: a goal must be given by joints");
    JointRow first{0, {}}, last{1, {}};
    for (std::size_t i = 0; i < constraints.size(); ++i) {
      check_fields(constraints[i], Message::joint_constraint, at / i, mistakes_);
      const ModelJoint* joint =
          joint_of(text_of(constraints[i], "joint_name", at / i, mistakes_), at / i / "joint_name");
      const Json* position = member_of(constraints[i], "position");
      if (!position) mistakes_.add(at / i / "position", "missing: must be a number");
      if (!joint || !position) continue;
      if (std::ranges::find(last.values, joint->name, &JointValues::value_type::first) !=
          last.values.end())
        mistakes_.add(at / i / "joint_name",
                      "duplicate: \"" + printable(joint->name, 60) + "\" has a goal already");
      const auto goal = read_number(*position, at / i / "position", mistakes_);
      if (!goal || joint->mimic) continue;
      last.values.emplace_back(joint->name, std::vector{*goal});
      std::vector<double> from = joint->value;
      for (const auto& [name, values] : trajectory_.start)
        if (name == joint->name) from = values;
      if (from.empty()) from = {joint->reference};
      first.values.emplace_back(joint->name, from);
    }
    trajectory_.rows = {first, last};
    trajectory_.rates.resize(2);
    trajectory_.accelerations.resize(2);
    trajectory_.has_times = false;
  }

  void check_times() {
    std::vector<JointRow>& rows = trajectory_.rows;
    if (rows.empty()) return mistakes_.add(points_, "must not be empty");
    const bool any_time =
        std::ranges::any_of(rows, [](const JointRow& row) { return row.time != 0; });
    if (!any_time || !trajectory_.has_times) {
      // A path without times does not use rates.
      trajectory_.has_times = rows.size() == 1;
      for (std::size_t i = 0; i < rows.size(); ++i) rows[i].time = static_cast<double>(i);
      const auto any = [](const JointValues& row) { return !row.empty(); };
      if (rows.size() > 1 && std::ranges::any_of(trajectory_.rates, any))
        trajectory_.notes.push_back(
            "no point has a time_from_start: velocities are ignored, joints go straight");
      trajectory_.rates.clear();
      trajectory_.accelerations.clear();
      return;
    }
    for (std::size_t i = 1; i < rows.size(); ++i)
      if (!(rows[i].time >= rows[i - 1].time))
        return mistakes_.add(points_, "times must increase: point " + std::to_string(i) +
                                          " is earlier than the one before it");
  }

  const Model& model_;
  Mistakes& mistakes_;
  std::map<std::string, const ModelJoint*> joints_;
  Trajectory trajectory_;
  bool is_found_ = false, is_new_part_ = true;
  double before_ = 0;
  JsonPath points_;  ///< place of the last list of points
};

}  // namespace

Trajectory read_trajectory(const Json& message, const JsonPath& path, const Model& model,
                           Mistakes& mistakes) {
  return TrajectoryReader(model, mistakes).read(message, path);
}

Trajectory read_trajectory(const Document& document, const Model& model, Mistakes& mistakes) {
  Trajectory trajectory;
  with_lines(document, mistakes, [&](Mistakes& found) {
    trajectory = read_trajectory(document.json, {}, model, found);
  });
  return trajectory;
}

}  // namespace minkray
