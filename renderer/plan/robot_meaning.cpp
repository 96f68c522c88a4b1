// SPDX-License-Identifier: MIT
#include "renderer/plan/robot_meaning.h"

#include <algorithm>
#include <set>
#include <sstream>

#include "renderer/import/model/xml.h"
#include "renderer/json/object_reader.h"

namespace minkray {
namespace {

class MeaningReader {
 public:
  MeaningReader(Model& model, XmlFiles& files) : model_(model), files_(files) {}

  RobotMeaning read(const XmlElement& root) {
    for (const XmlElement& element : root.children)
      if (element.name == "virtual_joint") add_virtual_joint(element);
    for (const XmlElement& element : root.children)
      if (element.name == "group") elements_.emplace(element.attribute_or("name"), &element);
    for (const auto& [name, element] : elements_) {
      std::set<std::string> joints, open;
      collect(name, *element, joints, open);
      // Orders a group's joints as links follow each other, which is MoveIt's order.
      for (const std::string& joint : moving_joints(model_))
        if (joints.contains(joint)) meaning_.groups[name].push_back(joint);
    }
    for (const XmlElement& element : root.children)
      if (element.name == "group_state") add_state(element);
    return std::move(meaning_);
  }

 private:
  /// Notes an unknown name. Variants of a robot share files, so MoveIt ignores names that this one
  /// does not have.
  void note(const XmlElement& element, const std::string& what) {
    meaning_.notes.push_back("line " + std::to_string(element.line) + ": " + name_of(element) +
                             ": " + what + "; ignored");
  }

  int link(const XmlElement& element, std::string_view key) {
    const std::string name = element.attribute_or(key);
    const int link = find_link(model_, name);
    if (link < 0)
      note(element, std::string(key) + ": there is no link \"" + printable(name, 60) + "\"");
    return link;
  }

  void add_virtual_joint(const XmlElement& element) {
    const std::string type = element.attribute_or("type");
    if (type != "floating" && type != "planar") return;
    const int child = link(element, "child_link");
    if (child < 0) return;
    ModelLink& of = model_.links[static_cast<std::size_t>(child)];
    if (of.parent >= 0) return files_.wrong(element, "child_link: must be a root of the robot");
    // A free joint places its link in the world, so the link would not move with the root.
    for (const ModelLink& other : model_.links)
      for (const ModelJoint& joint : other.joints)
        if (other.parent >= 0 && joint.kind == JointKind::free)
          return files_.wrong(element, "type: must be fixed: \"" + printable(joint.name, 60) +
                                           "\" floats on the root already");
    ModelJoint joint;
    joint.name = element.attribute_or("name");
    joint.kind = type == "floating" ? JointKind::free : JointKind::planar;
    joint.value = {0, 0, 0};
    if (joint.kind == JointKind::free) joint.value = {0, 0, 0, 1, 0, 0, 0};
    of.joints.insert(of.joints.begin(), joint);
  }

  void add_joints_of(int of, std::set<std::string>& joints) const {
    for (const ModelJoint& joint : model_.links[static_cast<std::size_t>(of)].joints)
      joints.insert(joint.name);
  }

  void collect(const std::string& name, const XmlElement& element, std::set<std::string>& joints,
               std::set<std::string>& open) {
    if (!open.insert(name).second) return files_.wrong(element, "must not hold itself");
    for (const XmlElement& part : element.children) {
      if (part.name == "joint") {
        joints.insert(part.attribute_or("name"));
      } else if (part.name == "link") {
        if (const int at = link(part, "name"); at >= 0) add_joints_of(at, joints);
      } else if (part.name == "chain") {
        const int base = link(part, "base_link");
        int at = link(part, "tip_link");
        for (; base >= 0 && at >= 0 && at != base;
             at = model_.links[static_cast<std::size_t>(at)].parent)
          add_joints_of(at, joints);
      } else if (part.name == "group") {
        const auto other = elements_.find(part.attribute_or("name"));
        if (other == elements_.end())
          files_.wrong(
              part, "name: there is no group \"" + printable(part.attribute_or("name"), 60) + "\"");
        else
          collect(other->first, *other->second, joints, open);
      }
    }
    open.erase(name);
  }

  void add_state(const XmlElement& element) {
    GroupState state{element.attribute_or("group"), element.attribute_or("name"), {}};
    const JointsByName joints = joints_by_name(model_);
    for (const XmlElement& part : element.children) {
      if (part.name != "joint") continue;
      const std::string name = part.attribute_or("name");
      const auto joint = joints.find(name);
      if (joint == joints.end()) {
        note(part, "there is no joint \"" + printable(name, 60) + "\" that moves");
        continue;
      }
      const std::size_t width = width_of(joint->second->kind);
      if (const auto values = files_.numbers(part, "value", width, width))
        state.values.emplace_back(name, *values);
    }
    meaning_.states.push_back(std::move(state));
  }

  Model& model_;
  XmlFiles& files_;
  RobotMeaning meaning_;
  std::map<std::string, const XmlElement*> elements_;
};

}  // namespace

RobotMeaning read_robot_meaning(const std::string& file, Model& model, Mistakes& mistakes) {
  XmlFiles files(mistakes);
  const auto root = files.read(file);
  if (!root) return {};
  if (root->name != "robot") {
    files.wrong(*root, "must be <robot> (SRDF)");
    return {};
  }
  return MeaningReader(model, files).read(*root);
}

const GroupState* find_state(const RobotMeaning& meaning, const std::string& name,
                             Mistakes& mistakes) {
  const GroupState* found = nullptr;
  std::vector<std::string> names;
  std::size_t count = 0;
  for (const GroupState& state : meaning.states) {
    const std::string whole = state.group + "/" + state.name;
    names.push_back(state.name);
    if (whole == name) return &state;
    if (state.name != name) continue;
    found = &state;
    ++count;
  }
  if (count == 0)
    mistakes.add("--state: no state named \"" + printable(name, 60) + "\" (" +
                 suggestion(name, names) + ")");
  if (count > 1)
    mistakes.add("--state: several groups have a state \"" + printable(name, 60) +
                 "\": give GROUP/" + printable(name, 60));
  return count == 1 ? found : nullptr;
}

std::vector<std::string> moving_joints(const Model& model) {
  std::vector<std::string> names;
  for (const ModelLink& link : model.links)
    for (const ModelJoint& joint : link.joints)
      if (joint.kind != JointKind::fixed && !joint.mimic) names.push_back(joint.name);
  return names;
}

}  // namespace minkray
