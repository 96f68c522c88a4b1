// SPDX-License-Identifier: MIT
// Tables of joint values, and the path of a robot along a trajectory.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/files/regular_file.h"
#include "renderer/base/csv.h"
#include "renderer/import/import.h"
#include "renderer/json/parse.h"
#include "renderer/plan/trajectory.h"
#include "renderer/sensor/npy.h"

namespace minkray {
namespace {

Trajectory read_npy_rows(const std::string& file, const Model& model,
                         const std::vector<std::string>& columns, Mistakes& mistakes) {
  Trajectory trajectory;
  const NpyArray array = read_npy(file);
  std::vector<std::size_t> widths;
  std::size_t width = 0;
  for (const std::string& name : columns)
    for (const ModelLink& link : model.links)
      for (const ModelJoint& joint : link.joints)
        if (joint.name == name) {
          widths.push_back(width_of(joint.kind));
          width += widths.back();
        }
  Mistakes of_file(file);
  const std::size_t given = array.shape.size() == 2 ? array.shape[1] : 0;
  if (given == 0 || (given != width && given != width + 1))
    of_file.add("must have the shape (rows, " + std::to_string(width) + "), or one column more " +
                "for the time (got " + array.shape_text() + "); --group names other joints");
  else if (array.shape[0] == 0)
    of_file.add("must have rows");
  trajectory.has_times = given == width + 1;
  for (std::size_t i = 0; of_file.none() && i < array.shape[0]; ++i) {
    const double* at = array.values.data() + i * given;
    JointRow row{trajectory.has_times ? *at++ : static_cast<double>(i), {}};
    for (std::size_t k = 0; k < columns.size(); at += widths[k++])
      row.values.emplace_back(columns[k], std::vector<double>(at, at + widths[k]));
    const bool is_finite = std::all_of(array.values.begin() + std::ptrdiff_t(i * given),
                                       array.values.begin() + std::ptrdiff_t((i + 1) * given),
                                       [](double value) { return std::isfinite(value); });
    if (!is_finite) of_file.add("row " + std::to_string(i + 1) + ": must be finite numbers");
    if (i > 0 && !(row.time > trajectory.rows.back().time))
      of_file.add("row " + std::to_string(i + 1) + ": times must increase");
    trajectory.rows.push_back(std::move(row));
  }
  for (const std::string& message : of_file.messages()) mistakes.add(message);
  return trajectory;
}

/// True if a table has a column of times, or its rows a key.
bool gives_times(const std::string& file) {
  Mistakes ignored(file);
  const std::string text = read_text_file(file, ignored).value_or("");
  if (lower_ending(file) != ".csv") return text.find("\"time\"") != text.npos;
  const CsvLines lines(text);
  return std::ranges::find(lines.cells(), "time") != lines.cells().end();
}

/// True if a row has rates of that joint: they lead it its own way round.
bool has_rates(const Trajectory& trajectory, const std::string& joint) {
  return std::ranges::any_of(trajectory.rates, [&](const JointValues& row) {
    return std::ranges::find(row, joint, &JointValues::value_type::first) != row.end();
  });
}

/// Moves angles of continuous and planar joints by whole turns so that no step is longer than half
/// a turn.
void go_shorter_way(Trajectory& trajectory, const Model& model) {
  constexpr double whole = 2 * std::numbers::pi;
  for (const ModelLink& link : model.links)
    for (const ModelJoint& joint : link.joints) {
      const bool is_planar = joint.kind == JointKind::planar;
      const bool is_round = is_planar || (joint.kind == JointKind::hinge && !joint.limits);
      if (!is_round || joint.mimic || has_rates(trajectory, joint.name)) continue;
      const std::size_t number = is_planar ? 2 : 0;
      double turns = 0, before = 0;
      std::size_t steps = 0;
      bool is_first = true;
      for (JointRow& row : trajectory.rows)
        for (auto& [name, values] : row.values) {
          if (name != joint.name || values.size() != width_of(joint.kind)) continue;
          double& angle = values[number];
          const double step = angle + whole * turns - before;
          if (!is_first && std::abs(step) > std::numbers::pi * (1 + 1e-9)) {
            turns -= std::round(step / whole);
            ++steps;
          }
          angle += whole * turns;
          before = angle;
          is_first = false;
        }
      if (steps > 0)
        trajectory.notes.push_back(
            "the joint \"" + printable(joint.name, 60) + "\" turns by more " +
            "than half a turn in " + std::to_string(steps) + (steps == 1 ? " step" : " steps") +
            "; using the shorter way (" + (is_planar ? "planar" : "continuous") + " joint)");
    }
}

/// Notes a joint that is elsewhere in the start state than in the first row.
void note_distant_start(Trajectory& trajectory) {
  constexpr double near = 0.01;  // MoveIt's allowed_start_tolerance
  const JointValues& first = trajectory.rows.front().values;
  for (const auto& [name, numbers] : trajectory.start) {
    const auto row = std::ranges::find(first, name, &JointValues::value_type::first);
    if (row == first.end() || numbers.size() != 1 || row->second.size() != 1) continue;
    if (std::abs(row->second[0] - numbers[0]) <= near) continue;
    trajectory.notes.push_back("the joint \"" + printable(name, 60) +
                               "\" has another value in the first row than in the start state; the "
                               "motion between the two is not verified");
    return;
  }
}

/// Values in the order of a path's joints. Joints that mimic others get their derived values.
std::vector<std::vector<double>> in_order(const Model& model, const JointValues& values) {
  std::map<std::string_view, const std::vector<double>*> by_name;
  for (const auto& [name, numbers] : values) by_name.emplace(name, &numbers);
  std::map<std::string_view, const ModelJoint*> joints;
  for (const ModelLink& link : model.links)
    for (const ModelJoint& joint : link.joints) joints.emplace(joint.name, &joint);
  std::vector<std::vector<double>> ordered;
  for (const ModelLink& link : model.links)
    for (const ModelJoint& joint : link.joints) {
      double multiplier = 1;
      const ModelJoint* leader = &joint;
      for (std::size_t i = 0; leader->mimic && i <= longest_mimicry; ++i) {
        multiplier *= leader->mimic->multiplier;
        const auto next = joints.find(leader->mimic->joint);
        if (next == joints.end()) break;
        leader = next->second;
      }
      ordered.emplace_back();
      const auto found = by_name.find(leader->name);
      if (found == by_name.end() || found->second->size() != width_of(joint.kind)) continue;
      for (const double number : *found->second) ordered.back().push_back(multiplier * number);
    }
  return ordered;
}

}  // namespace

bool is_table(const std::string& file) {
  const std::string ending = lower_ending(file);
  return ending == ".csv" || ending == ".npy";
}

bool is_table(const Json& json, const Model& model) {
  if (!json.is_array() || json.empty() || !json[0].is_object() || json[0].empty()) return false;
  const auto is_column = [&](const std::string& name) {
    if (name == "time") return true;
    for (const ModelLink& link : model.links)
      for (const ModelJoint& joint : link.joints)
        if (joint.name == name) return true;
    return false;
  };
  for (const auto& [name, value] : json[0].members())
    if (!is_column(name)) return false;
  return true;
}

Trajectory read_table(const std::string& file, Model& model,
                      const std::vector<std::string>& columns, Mistakes& mistakes) {
  if (lower_ending(file) == ".npy") return read_npy_rows(file, model, columns, mistakes);
  Trajectory trajectory;
  Mistakes of_file("");
  trajectory.rows = read_joint_rows(file, model, of_file, "", 1);
  // Each message is ": : FILE: TEXT".
  const std::size_t begin = printable(file).size() + 6;
  for (const std::string& message : of_file.messages())
    mistakes.add(std::string_view(message).substr(std::min(begin, message.size())));
  trajectory.has_times = gives_times(file);
  return trajectory;
}

JointPath path_of(Trajectory& trajectory, Model& model, const JointValues& state) {
  for (const JointValues* values : {&state, &std::as_const(trajectory).start})
    for (const auto& [name, numbers] : *values)
      if (ModelJoint* joint = find_joint(model, name))
        if (numbers.size() == width_of(joint->kind)) joint->value = numbers;
  // Joints that only later rows name are at rest before those rows.
  for (ModelLink& link : model.links)
    for (ModelJoint& joint : link.joints)
      if (joint.value.empty() && joint.kind != JointKind::fixed)
        joint.value = value_of(link, joint);
  follow_mimics(model);
  note_distant_start(trajectory);
  go_shorter_way(trajectory, model);
  JointPath path(model, trajectory.rows);
  for (const JointValues& row : trajectory.rates) path.rates.push_back(in_order(model, row));
  for (const JointValues& row : trajectory.accelerations)
    path.accelerations.push_back(in_order(model, row));
  return path;
}

}  // namespace minkray
