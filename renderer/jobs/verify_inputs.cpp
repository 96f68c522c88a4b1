// SPDX-License-Identifier: MIT
#include "renderer/jobs/verify_inputs.h"

#include <algorithm>
#include <cmath>

#include "core/files/text.h"
#include "renderer/base/errors.h"
#include "renderer/import/import.h"
#include "renderer/json/parse.h"
#include "renderer/plan/message_values.h"

namespace minkray {
namespace {

/// True for JSON with a scene's keys; it may have comments, unlike planners' files.
bool is_own_scene(const std::string& file) {
  Mistakes unread(file);
  const auto text = read_text_file(file, unread);
  const auto json = text ? parse_json(without_comments(*text).text, unread) : std::nullopt;
  return json && json->is_object() && !json->contains("world") &&
         (json->contains("objects") || json->contains("include"));
}

/// Returns a file that contains a planning scene, or a request with one; nothing for other scenes.
std::optional<Document> planning_document(const std::string& file, Mistakes& mistakes) {
  if (is_foreign(file) || is_own_scene(file)) return std::nullopt;
  std::optional<Document> document = read_document(file, mistakes);
  if (document && member_of(document->json, "objects") && !member_of(document->json, "world"))
    return std::nullopt;  // a scene of our own format, as YAML
  return document;
}

std::map<std::string, double> inflated(const std::vector<std::string>& texts, const Model& model) {
  std::map<std::string, double> radii;
  for (const std::string& text : texts) {
    const std::size_t equals = text.rfind('=');
    const std::string name = text.substr(0, equals);
    const double radius =
        equals == text.npos ? -1 : finite_number(text.substr(equals + 1)).value_or(-1);
    if (find_link(model, name) < 0 || radius < 0)
      throw BadInput("--inflate: must be LINK=RADIUS of a link of the robot (got \"" +
                     printable(text, 80) + "\")");
    if (!radii.emplace(name, radius).second)
      throw BadInput("--inflate: duplicate: \"" + printable(name, 60) + '"');
  }
  return radii;
}

std::vector<std::string> columns_of(const VerifyInputs& inputs, const RobotMeaning& meaning,
                                    const Model& model) {
  if (inputs.group.empty()) return moving_joints(model);
  const auto group = meaning.groups.find(inputs.group);
  if (group != meaning.groups.end()) return group->second;
  const std::string names = listed(meaning.groups, [](const auto& group) { return group.first; });
  throw BadInput("--group: no group named \"" + printable(inputs.group, 60) + "\" (" +
                 (names.empty() ? "--srdf gives groups" : "there are " + printable(names, 200)) +
                 ")");
}

/// Notes links of the SRDF that the robot does not have: their pairs have no effect.
AllowedPairs allowed_pairs(const AllowedLinks& links, const Model& model,
                           std::vector<std::string>& notes, Mistakes& mistakes) {
  AllowedLinks others = links;
  others.srdf.clear();
  AllowedPairs allowed = others.read(model, mistakes);
  if (links.srdf.empty()) return allowed;
  Mistakes of_srdf(links.srdf), serious("");
  read_srdf(links.srdf, model, allowed, of_srdf);
  for (const std::string& message : of_srdf.messages())
    if (message.find("there is no link") != message.npos ||
        message.find("further errors") != message.npos)
      notes.push_back(message);
    else
      serious.add(message);
  if (!serious.none()) throw BadInput(of_srdf.text());
  return allowed;
}

/// Obstacles from files of robots and worlds use collision shapes, as the robot itself does.
ImportOptions options_of_obstacles(const ImportOptions& of_robot, const std::string& file) {
  ImportOptions options;
  if (!is_foreign(file)) return options;
  options = of_robot;
  options.keyframe.clear();
  options.joints.clear();
  return options;
}

void append(JointValues& to, const JointValues& values) {
  to.insert(to.end(), values.begin(), values.end());
}

}  // namespace

VerifyCell load_cell(const VerifyInputs& inputs, CommandFiles& files) {
  Mistakes mistakes(inputs.robot);
  if (!is_foreign(inputs.robot)) mistakes.add("must be a robot's file: " + foreign_formats());
  throw_if_any(mistakes);
  std::optional<Model> model = load_model(inputs.robot, inputs.import, mistakes);
  throw_if_any(mistakes);
  files.read(model->files);
  VerifyCell cell;
  cell.files = model->files;
  if (!inputs.allowed.srdf.empty()) cell.files.emplace_back(inputs.allowed.srdf);
  for (const std::string& file : inputs.scenes) cell.files.emplace_back(file);
  RobotMeaning meaning;
  if (!inputs.allowed.srdf.empty()) {
    Mistakes of_srdf(inputs.allowed.srdf);
    meaning = read_robot_meaning(inputs.allowed.srdf, *model, of_srdf);
    throw_if_any(of_srdf);
    for (const std::string& note : meaning.notes)
      cell.notes.push_back(inputs.allowed.srdf + ": " + note);
  }
  pose_model(*model, inputs.import, mistakes);
  const AllowedPairs allowed = allowed_pairs(inputs.allowed, *model, cell.notes, mistakes);
  throw_if_any(mistakes);

  PlanningScene planning;
  bool has_planning = false;
  std::vector<Scene> scenes;
  for (const std::string& file : inputs.scenes) {
    Mistakes of_scene(file);
    const std::optional<Document> document = planning_document(file, of_scene);
    throw_if_any(of_scene);
    if (!document) {
      Imported imported = import_scene(file, options_of_obstacles(inputs.import, file));
      files.read(imported.files);
      scenes.push_back(std::move(imported.scene));
      continue;
    }
    if (has_planning) throw BadInput(file + ": only one planning scene can be given");
    has_planning = true;
    with_lines(*document, of_scene, [&](Mistakes& found) {
      JsonPath path;
      if (const Json* json = scene_in(document->json, path))
        planning = read_planning_scene(*document, *json, path, *model, inputs.import, found);
      else
        found.add(path,
                  "must be a planning scene (with world, robot_state or "
                  "allowed_collision_matrix), or a Minkray scene (with objects)");
    });
    throw_if_any(of_scene);
    for (const std::string& note : planning.notes) cell.notes.push_back(file + ": " + note);
    add_to_model(planning, *model, of_scene);
    throw_if_any(of_scene);
  }

  append(cell.state, planning.state);
  if (!inputs.state.empty()) {
    const GroupState* state = find_state(meaning, inputs.state, mistakes);
    throw_if_any(mistakes);
    append(cell.state, state->values);
  }
  cell.columns = columns_of(inputs, meaning, *model);
  WorkcellOptions options = inputs.cell;
  options.geometry = inputs.import.geometry;
  options.inflate = inflated(inputs.inflate, *model);
  cell.cell = workcell_of(std::move(*model), std::move(scenes), has_planning ? &planning : nullptr,
                          allowed, options);
  if (std::ranges::all_of(cell.cell.bodies,
                          [](const ClearanceBody& body) { return body.link_index < 0; }))
    cell.notes.push_back(inputs.robot +
                         ": has no shapes that can collide; --geometry visual uses visible ones");
  return cell;
}

namespace {

Plan plan_of(Trajectory&& trajectory, const std::string& name, const VerifyCell& cell) {
  Model model = cell.cell.model;
  try {
    JointPath path = path_of(trajectory, model, cell.state);
    return {std::move(trajectory), std::move(path)};
  } catch (const BadInput& error) {
    throw BadInput(printable(name, 200) + ": " + error.what());
  }
}

Plan plan_of_document(const Document& document, const std::string& name, const VerifyCell& cell,
                      Mistakes& mistakes) {
  Trajectory trajectory = read_trajectory(document, cell.cell.model, mistakes);
  throw_if_any(mistakes);
  return plan_of(std::move(trajectory), name, cell);
}

}  // namespace

Plan load_plan(const std::string& file, const VerifyCell& cell) {
  Mistakes mistakes(file);
  const auto load_table = [&] {
    Model model = cell.cell.model;
    Trajectory trajectory = read_table(file, model, cell.columns, mistakes);
    throw_if_any(mistakes);
    return plan_of(std::move(trajectory), file, cell);
  };
  if (is_table(file)) return load_table();
  const auto document = read_document(file, mistakes);
  throw_if_any(mistakes);
  if (is_table(document->json, cell.cell.model)) return load_table();
  return plan_of_document(*document, file, cell, mistakes);
}

Plan parse_plan(const std::string& line, const std::string& name, const VerifyCell& cell) {
  Mistakes mistakes(name);
  const std::optional<Document> document = parse_document(line, name, mistakes);
  throw_if_any(mistakes);
  return plan_of_document(*document, name, cell, mistakes);
}

}  // namespace minkray
