// SPDX-License-Identifier: MIT
#include "renderer/import/model/model.h"

#include <algorithm>
#include <cmath>

#include "core/support/named_kind.h"
#include "renderer/import/model/orientation.h"

namespace minkray {
namespace {

/// A turn about a unit axis (Rodrigues).
Mat3<double> turn(const Vec3<double>& axis, double angle) {
  const double half = angle / 2, s = std::sin(half);
  return rotation_matrix(axis.x() * s, axis.y() * s, axis.z() * s, std::cos(half));
}

}  // namespace

std::array<Vec3<double>, 2> directions_across(const Vec3<double>& normal) {
  const Vec3<double> helper =
      std::abs(normal.x()) < 0.5 ? Vec3<double>(1, 0, 0) : Vec3<double>(0, 1, 0);
  const Vec3<double> u = unit<double>(helper - normal.dot(helper) * normal);
  return {u, normal.cross(u)};
}

Affine<double> motion_of(const ModelJoint& joint) {
  const std::vector<double>& q = joint.value;
  const auto about_anchor = [&](const Mat3<double>& rotation) {
    return Affine<double>{rotation, joint.anchor - rotation * joint.anchor};
  };
  switch (joint.kind) {
    case JointKind::hinge:
      return about_anchor(turn(joint.axis, q[0] - joint.reference));
    case JointKind::slide:
      return {Mat3<double>::Identity(), (q[0] - joint.reference) * joint.axis};
    case JointKind::ball:
      return about_anchor(rotation_of_quaternion(q[1], q[2], q[3], q[0]));
    case JointKind::planar: {
      const auto [u, v] = directions_across(joint.axis);
      return {turn(joint.axis, q[2]), q[0] * u + q[1] * v};
    }
    case JointKind::fixed:
    case JointKind::free:
      break;
  }
  return {};
}

std::size_t width_of(JointKind kind) {
  switch (kind) {
    case JointKind::fixed:
      return 0;
    case JointKind::hinge:
    case JointKind::slide:
      return 1;
    case JointKind::planar:
      return 3;
    case JointKind::ball:
      return 4;
    case JointKind::free:
      return 7;
  }
  return 0;
}

std::string_view name_of(JointKind kind) {
  return name_at({"fixed", "hinge", "slide", "ball", "free", "planar"}, kind);
}

void Model::pass_over(const std::string& what, const std::string& why, std::size_t count) {
  for (PassedOver& known : passed_over)
    if (known.what == what && known.why == why) {
      known.count += count;
      return;
    }
  // Each is looked for among all: a hostile file could have a hundred thousand.
  constexpr std::size_t most_kinds = 200;
  if (passed_over.size() < most_kinds)
    passed_over.push_back({what, why, count});
  else if (passed_over.size() == most_kinds)
    passed_over.push_back({"other things", "too many kinds to list", count});
  else
    passed_over.back().count += count;
}

std::vector<Affine<double>> link_poses(const Model& model) {
  std::vector<Affine<double>> poses;
  poses.reserve(model.links.size());
  for (const ModelLink& link : model.links) {
    Affine<double> pose = link.rest;
    if (link.parent >= 0) pose = poses[static_cast<std::size_t>(link.parent)] * pose;
    for (const ModelJoint& joint : link.joints) {
      if (joint.value.size() != width_of(joint.kind) || joint.value.empty()) continue;
      if (joint.kind == JointKind::free) {
        const std::vector<double>& q = joint.value;
        pose = {rotation_of_quaternion(q[4], q[5], q[6], q[3]), {q[0], q[1], q[2]}};
      } else {
        pose = pose * motion_of(joint);
      }
    }
    poses.push_back(pose);
  }
  return poses;
}

JointsByName joints_by_name(Model& model) {
  JointsByName joints;
  for (ModelLink& link : model.links)
    for (ModelJoint& joint : link.joints)
      if (joint.kind != JointKind::fixed) joints.emplace(joint.name, &joint);
  return joints;
}

int find_link(const Model& model, std::string_view name) {
  const auto link = std::ranges::find(model.links, name, &ModelLink::name);
  return link == model.links.end() ? -1 : static_cast<int>(link - model.links.begin());
}

ModelJoint* find_joint(Model& model, const std::string& name) {
  for (ModelLink& link : model.links)
    for (ModelJoint& joint : link.joints)
      if (joint.name == name && joint.kind != JointKind::fixed) return &joint;
  return nullptr;
}

std::vector<double> value_of(const ModelLink& link, const ModelJoint& joint) {
  if (!joint.value.empty()) return joint.value;
  switch (joint.kind) {
    case JointKind::hinge:
    case JointKind::slide:
      return {joint.reference};
    case JointKind::ball:
      return {1, 0, 0, 0};
    case JointKind::planar:
      return {0, 0, 0};
    case JointKind::free: {
      const Vec3<double>& at = link.rest.translation;
      const auto [x, y, z, w] = quaternion_of(link.rest.linear);
      return {at.x(), at.y(), at.z(), w, x, y, z};
    }
    case JointKind::fixed:
      break;
  }
  return {};
}

const ModelKeyframe* find_keyframe(const Model& model, const std::string& name) {
  for (const ModelKeyframe& keyframe : model.keyframes)
    if (!name.empty() && keyframe.name == name) return &keyframe;
  for (std::size_t i = 0; i < model.keyframes.size(); ++i)
    if (name == std::to_string(i)) return &model.keyframes[i];
  return nullptr;
}

std::vector<std::string> keyframe_names(const Model& model) {
  std::vector<std::string> names;
  for (const ModelKeyframe& keyframe : model.keyframes)
    names.push_back(keyframe.name.empty() ? std::to_string(names.size()) : keyframe.name);
  return names;
}

void set_values(Model& model, const std::vector<double>& values) {
  std::size_t at = 0;
  for (ModelLink& link : model.links)
    for (ModelJoint& joint : link.joints) {
      const std::size_t width = width_of(joint.kind);
      if (width == 0 || at + width > values.size()) continue;
      joint.value.assign(values.begin() + static_cast<std::ptrdiff_t>(at),
                         values.begin() + static_cast<std::ptrdiff_t>(at + width));
      at += width;
    }
}

std::string follow_mimics(Model& model) {
  std::unordered_map<std::string, ModelJoint*> by_name;
  for (ModelLink& link : model.links)
    for (ModelJoint& joint : link.joints) by_name.emplace(joint.name, &joint);
  for (ModelLink& link : model.links)
    for (ModelJoint& joint : link.joints) {
      if (!joint.mimic) continue;
      // value = multiplier * other + offset, along the chain of others.
      double multiplier = 1, offset = 0;
      const ModelJoint* other = &joint;
      std::size_t steps = 0;
      while (other->mimic) {
        offset += multiplier * other->mimic->offset;
        multiplier *= other->mimic->multiplier;
        const auto next = by_name.find(other->mimic->joint);
        if (next == by_name.end() || ++steps > longest_mimicry) return other->mimic->joint;
        other = next->second;
      }
      const bool is_scalar = width_of(joint.kind) == 1 && width_of(other->kind) == 1;
      if (!is_scalar) continue;
      const double leader = other->value.empty() ? other->reference : other->value[0];
      joint.value = {multiplier * leader + offset};
    }
  return "";
}

}  // namespace minkray
