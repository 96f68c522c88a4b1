// SPDX-License-Identifier: MIT
#include "renderer/import/sdf/sdf_joints.h"

#include <algorithm>

namespace minkray {
namespace {

class SdfTree {
 public:
  SdfTree(Model& model, const SdfLinks& links, const std::vector<SdfJoint>& joints, XmlFiles& files)
      : model_(model),
        links_(links),
        joints_(joints),
        files_(files),
        joint_of_(model.links.size(), -1),
        parent_of_(model.links.size(), -1) {}

  void connect();

 private:
  void find_parents();
  std::vector<int> parents_first() const;
  void add_joint(const SdfJoint& from, const Affine<double>& child_in_world, ModelLink& link);
  Vec3<double> axis_in_link(const XmlElement& xyz, const XmlElement& axis, const SdfJoint& from,
                            const Affine<double>& in_link, const Affine<double>& child_in_world);
  double bound(const XmlElement& limit, const char* key, double otherwise);

  Model& model_;
  const SdfLinks& links_;
  const std::vector<SdfJoint>& joints_;
  XmlFiles& files_;
  std::vector<int> joint_of_, parent_of_;  ///< by link; -1: none
};

void SdfTree::find_parents() {
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const SdfJoint& joint = joints_[j];
    const auto index_of = [&](const std::string& name) {
      const auto found = links_.index.find(joint.prefix + name);
      if (found != links_.index.end()) return found->second;
      const auto other = links_.index.find(joint.prefix + joint.frames->link_of(name));
      return other == links_.index.end() ? -1 : other->second;
    };
    const int child = index_of(joint.child);
    const int parent = joint.parent == "world" ? -1 : index_of(joint.parent);
    if (child < 0 || (parent < 0 && joint.parent != "world")) {
      files_.wrong(
          *joint.element,
          "the link \"" + printable(child < 0 ? joint.child : joint.parent, 60) + "\" not found");
      continue;
    }
    const auto c = static_cast<std::size_t>(child);
    if (joint_of_[c] >= 0) {
      // A loop: the links keep their places, and the first joint moves the child.
      model_.pass_over("<joint>", "closes a loop");
      continue;
    }
    joint_of_[c] = static_cast<int>(j);
    parent_of_[c] = parent;
  }
}

/// The links that can be reached from the world, each behind its parent.
std::vector<int> SdfTree::parents_first() const {
  const std::size_t count = model_.links.size();
  std::vector<std::vector<int>> children(count);
  std::vector<int> order, open;
  for (std::size_t i = count; i-- > 0;) {
    if (parent_of_[i] >= 0)
      children[static_cast<std::size_t>(parent_of_[i])].push_back(static_cast<int>(i));
    else
      open.push_back(static_cast<int>(i));
  }
  while (!open.empty()) {
    const int link = open.back();
    open.pop_back();
    order.push_back(link);
    for (const int child : children[static_cast<std::size_t>(link)]) open.push_back(child);
  }
  return order;
}

void SdfTree::connect() {
  find_parents();
  const std::size_t count = model_.links.size();
  const std::vector<int> order = parents_first();
  std::vector<int> place(count, -1);
  for (std::size_t i = 0; i < order.size(); ++i)
    place[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
  std::vector<ModelLink> links;
  for (const int old : order) {
    const auto i = static_cast<std::size_t>(old);
    ModelLink link = model_.links[i];
    const Affine<double> in_world = link.rest;
    if (parent_of_[i] >= 0) {
      const auto p = static_cast<std::size_t>(parent_of_[i]);
      link.parent = place[p];
      link.rest = model_.links[p].rest.inverse() * in_world;
    }
    if (joint_of_[i] >= 0)
      add_joint(joints_[static_cast<std::size_t>(joint_of_[i])], in_world, link);
    links.push_back(std::move(link));
  }
  if (order.size() < count) {
    for (std::size_t i = 0; i < count; ++i)
      if (place[i] < 0) {
        files_.wrong(*links_.elements[i], "joints must not form a cycle");
        break;
      }
    return;
  }
  model_.links = std::move(links);
  for (ModelGeom& geom : model_.geoms)
    if (geom.link >= 0) geom.link = place[static_cast<std::size_t>(geom.link)];
  std::ranges::stable_sort(model_.geoms, {}, &ModelGeom::link);
}

/// The axis in the link's frame; SDF gives it in the joint's, the model's or a frame that it names.
Vec3<double> SdfTree::axis_in_link(const XmlElement& xyz, const XmlElement& axis,
                                   const SdfJoint& from, const Affine<double>& in_link,
                                   const Affine<double>& child_in_world) {
  Vec3<double> written(0, 0, 1);
  if (const auto v = files_.numbers_in(xyz, xyz.text, "xyz", 3, 3))
    written = {(*v)[0], (*v)[1], (*v)[2]};
  const std::string expressed = xyz.attribute_or("expressed_in");
  const std::string given = sdf_text(axis, "use_parent_model_frame");
  const bool in_model = given.empty() ? from.axis_is_in_model : given == "1" || given == "true";
  if (!in_model && expressed.empty()) return in_link.linear * written;
  const Affine<double> frame = from.model_in_world * from.frames->pose_of(expressed, xyz);
  const Mat3<double> turn = child_in_world.linear.transpose() * frame.linear;
  return turn * written;
}

double SdfTree::bound(const XmlElement& limit, const char* key, double otherwise) {
  const XmlElement* at = limit.child(key);
  const std::string text = at ? sdf_text(limit, key) : "";
  if (text.empty() || text.find("inf") != text.npos) return otherwise;
  const auto v = files_.numbers_in(*at, text, key, 1, 1);
  return v ? (*v)[0] : otherwise;
}

void SdfTree::add_joint(const SdfJoint& from, const Affine<double>& child_in_world,
                        ModelLink& link) {
  static const std::map<std::string, JointKind> kinds = {
      {"revolute", JointKind::hinge},  {"continuous", JointKind::hinge},
      {"prismatic", JointKind::slide}, {"ball", JointKind::ball},
      {"fixed", JointKind::fixed},     {"universal", JointKind::hinge},
      {"revolute2", JointKind::hinge}, {"screw", JointKind::hinge},
      {"gearbox", JointKind::hinge}};
  const std::string type = from.element->attribute_or("type");
  const auto kind = kinds.find(type);
  if (kind == kinds.end())
    return files_.wrong(*from.element,
                        "type: must be a type of joint (got \"" + printable(type, 40) + "\")");
  if (type == "screw" || type == "gearbox")
    model_.pass_over("<joint type=\"" + type + "\">", "only turns here");
  const std::string own = from.element->attribute_or("name");
  const Affine<double> in_world = from.model_in_world * from.frames->pose_of(own, *from.element);
  const Affine<double> in_link = child_in_world.inverse() * in_world;
  const auto add = [&](const XmlElement* axis, const std::string& name) {
    ModelJoint joint;
    joint.name = name;
    joint.kind = kind->second;
    joint.anchor = in_link.translation;
    const XmlElement* xyz = axis ? axis->child("xyz") : nullptr;
    const XmlElement* limit = axis ? axis->child("limit") : nullptr;
    if (xyz) joint.axis = axis_in_link(*xyz, *axis, from, in_link, child_in_world);
    if (limit) joint.limits = {bound(*limit, "lower", -1e16), bound(*limit, "upper", 1e16)};
    joint.axis = unit(joint.axis);
    if (joint.axis.isZero(0)) files_.wrong(*from.element, "axis: must not be zero");
    link.joints.push_back(joint);
  };
  add(from.element->child("axis"), from.name);
  if (type == "universal" || type == "revolute2")
    add(from.element->child("axis2"), from.name + "/axis2");
}

}  // namespace

void connect_links(Model& model, const SdfLinks& links, const std::vector<SdfJoint>& joints,
                   XmlFiles& files) {
  SdfTree(model, links, joints, files).connect();
}

}  // namespace minkray
