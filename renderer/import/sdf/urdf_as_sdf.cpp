// SPDX-License-Identifier: MIT
#include "renderer/import/sdf/urdf_as_sdf.h"

#include <map>

namespace minkray {
namespace {

XmlElement element(const XmlElement& from, std::string name, std::string text = "") {
  XmlElement made;
  made.name = std::move(name);
  made.text = std::move(text);
  made.line = from.line;
  made.file = from.file;
  return made;
}

void set(XmlElement& to, const char* name, const std::string& value) {
  to.attributes.push_back({name, value});
}

/// The <pose> that an <origin> means, relative to a frame.
XmlElement pose_of(const XmlElement& from, const std::string& relative_to) {
  const XmlElement* origin = from.child("origin");
  const std::string xyz = origin ? origin->attribute_or("xyz", "0 0 0") : "0 0 0";
  const std::string* quaternion = origin ? origin->attribute("quat_xyzw") : nullptr;
  const std::string rpy = origin ? origin->attribute_or("rpy", "0 0 0") : "0 0 0";
  XmlElement pose =
      element(origin ? *origin : from, "pose", xyz + " " + (quaternion ? *quaternion : rpy));
  if (quaternion) set(pose, "rotation_format", "quat_xyzw");
  if (!relative_to.empty()) set(pose, "relative_to", relative_to);
  return pose;
}

/// Sizes are elements in SDF, and attributes in URDF.
XmlElement shape_of(const XmlElement& shape) {
  XmlElement made = element(shape, shape.name);
  for (const XmlAttribute& one : shape.attributes)
    made.children.push_back(element(shape, one.name == "filename" ? "uri" : one.name, one.value));
  if (shape.name == "ellipsoid" && shape.attribute("a"))
    made.children.push_back(element(
        shape, "radii",
        shape.attribute_or("a") + " " + shape.attribute_or("b") + " " + shape.attribute_or("c")));
  return made;
}

using Colours = std::map<std::string, std::string>;

/// A <visual> or <collision>.
XmlElement geom_of(const XmlElement& geom, const Colours& colours) {
  XmlElement made = element(geom, geom.name);
  if (const std::string* name = geom.attribute("name")) set(made, "name", *name);
  made.children.push_back(pose_of(geom, ""));
  if (const XmlElement* geometry = geom.child("geometry")) {
    XmlElement shapes = element(*geometry, "geometry");
    for (const XmlElement& shape : geometry->children) shapes.children.push_back(shape_of(shape));
    made.children.push_back(std::move(shapes));
  }
  const XmlElement* material = geom.child("material");
  if (!material) return made;
  const XmlElement* colour = material->child("color");
  const auto known = colours.find(material->attribute_or("name"));
  if (!colour && known == colours.end()) return made;
  XmlElement painted = element(*material, "material");
  painted.children.push_back(
      element(*material, "diffuse", colour ? colour->attribute_or("rgba") : known->second));
  made.children.push_back(std::move(painted));
  return made;
}

}  // namespace

XmlElement sdf_of_urdf(XmlElement robot, XmlFiles& files) {
  drop_vendor_prefixes(robot);
  XmlElement model = element(robot, "model");
  set(model, "name", robot.attribute_or("name"));
  Colours colours;
  std::map<std::string, const XmlElement*> joint_of;
  for (const XmlElement& child : robot.children) {
    if (child.name == "material")
      if (const XmlElement* colour = child.child("color"))
        colours[child.attribute_or("name")] = colour->attribute_or("rgba");
    const XmlElement* end = child.name == "joint" ? child.child("child") : nullptr;
    if (end && !joint_of.emplace(end->attribute_or("link"), &child).second)
      files.wrong(child, "child: must not be the child of two joints");
    if (child.name.starts_with("xacro:"))
      files.wrong(child, "is a macro: expand the file first (xacro robot.urdf.xacro)");
  }
  bool has_world = false;
  for (const XmlElement& child : robot.children)
    has_world |= child.name == "link" && child.attribute_or("name") == "world";
  const auto parent_of = [&](const XmlElement& joint) {
    const XmlElement* end = joint.child("parent");
    const std::string name = end ? end->attribute_or("link") : "";
    return name == "world" && !has_world ? std::string("__model__") : name;
  };
  for (const XmlElement& child : robot.children) {
    if (child.name == "link") {
      XmlElement link = element(child, "link");
      const std::string name = child.attribute_or("name");
      set(link, "name", name);
      if (const auto joint = joint_of.find(name); joint != joint_of.end())
        link.children.push_back(pose_of(*joint->second, parent_of(*joint->second)));
      for (const XmlElement& geom : child.children)
        if (geom.name == "visual" || geom.name == "collision")
          link.children.push_back(geom_of(geom, colours));
      model.children.push_back(std::move(link));
    } else if (child.name == "joint" && child.child("child")) {
      XmlElement joint = element(child, "joint");
      set(joint, "name", child.attribute_or("name"));
      const std::string type = child.attribute_or("type");
      const std::string parent = parent_of(child);
      // SDF has no joints that are free in all or three ways: the link stays at its place.
      if (type == "floating" || type == "planar" || parent == "__model__") continue;
      set(joint, "type", type == "spherical" ? "ball" : type);
      joint.children.push_back(element(child, "parent", parent));
      joint.children.push_back(element(child, "child", child.child("child")->attribute_or("link")));
      XmlElement axis = element(child, "axis");
      const XmlElement* written = child.child("axis");
      axis.children.push_back(
          element(child, "xyz", written ? written->attribute_or("xyz", "1 0 0") : "1 0 0"));
      if (type == "universal") {
        axis.children[0].text = "1 0 0";
        XmlElement second = element(child, "axis2");
        second.children.push_back(element(child, "xyz", "0 1 0"));
        joint.children.push_back(std::move(second));
      }
      joint.children.push_back(std::move(axis));
      model.children.push_back(std::move(joint));
    }
  }
  return model;
}

}  // namespace minkray
