// SPDX-License-Identifier: MIT
#include "renderer/plan/planning_scene.h"

#include <algorithm>
#include <cmath>

#include "renderer/import/model/floating_joint.h"
#include "renderer/import/model/orientation.h"
#include "renderer/json/object_reader.h"
#include "renderer/json/values.h"
#include "renderer/plan/collision_object.h"
#include "renderer/plan/message_fields.h"
#include "renderer/plan/message_values.h"

namespace minkray {
namespace {

/// Joint of that name, or null.
const ModelJoint* joint_of(const Model& model, const std::string& name) {
  for (const ModelLink& link : model.links)
    for (const ModelJoint& joint : link.joints)
      if (joint.name == name) return &joint;
  return nullptr;
}

CollisionMatrix read_matrix(const Json& json, const JsonPath& path, Mistakes& mistakes) {
  CollisionMatrix matrix;
  const auto bit = [&](const Json& value, const JsonPath& at) {
    return read_bool(value, at, mistakes).value_or(false);
  };
  check_fields(json, Message::collision_matrix, path, mistakes);
  std::vector<std::string> names, defaults;
  if (const Json* list = member_of(json, "entry_names"))
    names = read_name_list(*list, path / "entry_names", mistakes);
  if (const Json* list = member_of(json, "default_entry_names"))
    defaults = read_name_list(*list, path / "default_entry_names", mistakes);
  matrix.names.insert(names.begin(), names.end());
  const Json& rows = list_of(json, "entry_values", path, mistakes);
  const JsonPath at = path / "entry_values";
  if (rows.size() != names.size())
    mistakes.add(at, "must have a row for each of the " + std::to_string(names.size()) +
                         " names (got " + std::to_string(rows.size()) + ")");
  for (std::size_t i = 0; i < std::min(rows.size(), names.size()); ++i) {
    const Json* row = &rows[i];
    JsonPath where = at / i;
    check_fields(*row, Message::collision_entry, where, mistakes);
    if (const Json* enabled = member_of(*row, "enabled")) {  // moveit_msgs/AllowedCollisionEntry
      row = enabled;
      where = where / "enabled";
    }
    if (!row->is_array() || row->size() != names.size()) {
      mistakes.add(where, "must be a list of " + std::to_string(names.size()) +
                              " of true and false (" + found(*row) + ")");
      continue;
    }
    for (std::size_t k = 0; k < names.size(); ++k) {
      const auto [entry, is_new] =
          matrix.entries.emplace(std::minmax(names[i], names[k]), bit((*row)[k], where / k));
      if (!is_new && entry->second != bit((*row)[k], where / k))
        mistakes.add(where / k, "must be the same as in the row of \"" + printable(names[k], 60) +
                                    "\": the matrix is symmetric");
    }
  }
  const Json& values = list_of(json, "default_entry_values", path, mistakes);
  if (values.size() != defaults.size())
    mistakes.add(path / "default_entry_values", "must be as many as default_entry_names (" +
                                                    std::to_string(defaults.size()) + "; got " +
                                                    std::to_string(values.size()) + ")");
  for (std::size_t i = 0; i < std::min(values.size(), defaults.size()); ++i)
    matrix.defaults[defaults[i]] = bit(values[i], path / "default_entry_values" / i);
  return matrix;
}

/// Adds the transforms of a MultiDOFJointState.
void add_multi_dof(const Json& json, const JsonPath& path, const Model& model, JointValues& values,
                   Mistakes& mistakes) {
  check_fields(json, Message::poses_state, path, mistakes);
  std::vector<std::string> names;
  if (const Json* list = member_of(json, "joint_names"))
    names = read_name_list(*list, path / "joint_names", mistakes);
  const Json& transforms = list_of(json, "transforms", path, mistakes);
  if (transforms.size() != names.size())
    mistakes.add(path / "transforms", "must be as many as joint_names (" +
                                          std::to_string(names.size()) + "; got " +
                                          std::to_string(transforms.size()) + ")");
  for (std::size_t i = 0; i < std::min(transforms.size(), names.size()); ++i) {
    const JsonPath at = path / "transforms" / i;
    const ModelJoint* joint = joint_of(model, names[i]);
    // Virtual joints that are fixed, or that no SRDF names, leave the robot where it is.
    if (joint && add_values_of_transform(transforms[i], at, model, *joint, values, mistakes))
      continue;
    const Affine<double> pose = read_message_pose(transforms[i], at, mistakes);
    if (!pose.translation.isZero(1e-9) || !pose.linear.isIdentity(1e-9))
      mistakes.add(at, "moves the joint \"" + printable(names[i], 60) +
                           "\", which is no floating or planar joint of the robot; an SRDF's "
                           "virtual_joint of type floating makes it one (--srdf)");
  }
}

}  // namespace

bool CollisionMatrix::allows(const std::string& a, const std::string& b) const {
  if (const auto entry = entries.find(std::minmax(a, b)); entry != entries.end())
    return entry->second;
  const auto of_a = defaults.find(a), of_b = defaults.find(b);
  // If both have a default, both must allow the collision, as in MoveIt.
  if (of_a != defaults.end() && of_b != defaults.end()) return of_a->second && of_b->second;
  if (of_a != defaults.end()) return of_a->second;
  return of_b != defaults.end() && of_b->second;
}

bool add_values_of_transform(const Json& json, const JsonPath& path, const Model& model,
                             const ModelJoint& joint, JointValues& values, Mistakes& mistakes) {
  const std::array<std::string, 3> slides = slides_of_floating(joint.name);
  const bool has_slides = joint.kind == JointKind::ball && joint_of(model, slides[0]);
  if (joint.kind != JointKind::free && joint.kind != JointKind::planar && !has_slides) return false;
  const Affine<double> pose = read_message_pose(json, path, mistakes);
  const Vec3<double>& p = pose.translation;
  if (joint.kind == JointKind::planar) {
    if (std::abs(p.z()) > 1e-9 || std::abs(pose.linear(2, 2) - 1) > 1e-9)
      mistakes.add(path, "must stay in the plane of its joint: z is 0, and turns are about z");
    values.emplace_back(
        joint.name, std::vector{p.x(), p.y(), std::atan2(pose.linear(1, 0), pose.linear(0, 0))});
    return true;
  }
  const auto q = quaternion_of(pose.linear);
  std::vector<double> turn = {q[3], q[0], q[1], q[2]};
  if (has_slides) {
    for (std::size_t i = 0; i < slides.size(); ++i)
      values.emplace_back(slides[i], std::vector{p[static_cast<Eigen::Index>(i)]});
  } else {
    turn.insert(turn.begin(), {p.x(), p.y(), p.z()});
  }
  values.emplace_back(joint.name, std::move(turn));
  return true;
}

JointValues read_robot_state(const Json& json, const JsonPath& path, const Model& model,
                             std::vector<std::string>& notes, Mistakes& mistakes) {
  JointValues values;
  check_fields(json, Message::robot_state, path, mistakes);
  if (const Json* state = member_of(json, "joint_state")) {
    const JsonPath at = path / "joint_state";
    check_fields(*state, Message::joint_state, at, mistakes);
    std::vector<std::string> names;
    std::vector<double> positions;
    if (const Json* list = member_of(*state, "name"))
      names = read_name_list(*list, at / "name", mistakes);
    if (const Json* list = member_of(*state, "position"))
      positions = read_number_list(*list, at / "position", mistakes);
    if (positions.size() != names.size())
      mistakes.add(at / "position", "must have a value for each of the " +
                                        std::to_string(names.size()) + " names (got " +
                                        std::to_string(positions.size()) + ")");
    for (std::size_t i = 0; i < std::min(names.size(), positions.size()); ++i) {
      if (std::find(names.begin(), names.begin() + std::ptrdiff_t(i), names[i]) !=
          names.begin() + std::ptrdiff_t(i))
        mistakes.add(at / "name" / i, "duplicate: \"" + printable(names[i], 60) + '"');
      const ModelJoint* joint = joint_of(model, names[i]);
      if (!joint)
        notes.push_back((at / "name" / i).text() + ": there is no joint \"" +
                        printable(names[i], 60) + "\"; its value is ignored");
      else if (width_of(joint->kind) == 1 && !joint->mimic)
        values.emplace_back(names[i], std::vector<double>{positions[i]});
    }
  }
  if (const Json* state = member_of(json, "multi_dof_joint_state"))
    add_multi_dof(*state, path / "multi_dof_joint_state", model, values, mistakes);
  return values;
}

const Json* scene_in(const Json& message, JsonPath& path) {
  if (member_of(message, "world") || member_of(message, "robot_state") ||
      member_of(message, "allowed_collision_matrix"))
    return &message;
  for (const std::string_view key : {"scene", "planning_scene", "motion_plan_request", "request"})
    if (const Json* inner = member_of(message, key)) {
      JsonPath there = path / key;
      if (const Json* found = scene_in(*inner, there)) {
        path = there;
        return found;
      }
    }
  return nullptr;
}

PlanningScene read_planning_scene(const Document& document, const Json& json, const JsonPath& path,
                                  const Model& model, const ImportOptions& options,
                                  Mistakes& mistakes) {
  PlanningScene scene;
  check_fields(json, Message::planning_scene, path, mistakes);
  CollisionObjects objects(document.file, options, mistakes);
  if (const Json* world = member_of(json, "world")) {
    const JsonPath at = path / "world";
    check_fields(*world, Message::world, at, mistakes);
    const Json& list = list_of(*world, "collision_objects", at, mistakes);
    for (std::size_t i = 0; i < list.size(); ++i)
      objects.add(list[i], at / "collision_objects" / i, scene.objects);
    const Json* octomap = member_of(*world, "octomap");
    if (octomap && !octomap->is_object())
      mistakes.add(at / "octomap", "must be an object (" + found(*octomap) + ")");
    const Json* inner = octomap ? member_of(*octomap, "octomap") : nullptr;
    if (const Json* data = inner ? member_of(*inner, "data") : nullptr; data && !data->empty())
      mistakes.add(at / "octomap" / "octomap" / "data",
                   "octomaps are not read: give their boxes as collision objects");
  }
  if (const Json* state = member_of(json, "robot_state")) {
    const JsonPath at = path / "robot_state";
    scene.state = read_robot_state(*state, at, model, scene.notes, mistakes);
    objects.add_attached(*state, at, scene.attached);
  }
  if (const Json* matrix = member_of(json, "allowed_collision_matrix"))
    scene.matrix = read_matrix(*matrix, path / "allowed_collision_matrix", mistakes);
  const Json& frames = list_of(json, "fixed_frame_transforms", path, mistakes);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const JsonPath at = path / "fixed_frame_transforms" / i;
    check_fields(frames[i], Message::fixed_frame, at, mistakes);
    const std::string name = text_of(frames[i], "child_frame_id", at, mistakes);
    if (const Json* transform = member_of(frames[i], "transform"))
      scene.fixed_frames[name] = read_message_pose(*transform, at / "transform", mistakes);
  }
  const Json& padding = list_of(json, "link_padding", path, mistakes);
  for (std::size_t i = 0; i < padding.size(); ++i) {
    const JsonPath at = path / "link_padding" / i;
    check_fields(padding[i], Message::link_padding, at, mistakes);
    const std::string name = text_of(padding[i], "link_name", at, mistakes);
    const bool is_link =
        std::ranges::find(model.links, name, &ModelLink::name) != model.links.end();
    if (!is_link)
      scene.notes.push_back((at / "link_name").text() + ": there is no link \"" +
                            printable(name, 60) + "\"; its padding is ignored");
    if (const Json* value = member_of(padding[i], "padding"))
      scene.padding[name] =
          read_number(*value, at / "padding", mistakes, Range::not_negative).value_or(0);
    else
      mistakes.add(at / "padding", "missing: must be a length >= 0");
  }
  const Json& scales = list_of(json, "link_scale", path, mistakes);
  for (std::size_t i = 0; i < scales.size(); ++i) {
    const JsonPath at = path / "link_scale" / i;
    check_fields(scales[i], Message::link_scale, at, mistakes);
    const Json* value = member_of(scales[i], "scale");
    if (value && !(value->is_number() && value->get<double>() == 1))
      mistakes.add(at / "scale", "must be 1: links are not scaled (" + found(*value) + ")");
  }
  return scene;
}

}  // namespace minkray
