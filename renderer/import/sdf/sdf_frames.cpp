// SPDX-License-Identifier: MIT
#include "renderer/import/sdf/sdf_frames.h"

#include <optional>
#include <vector>

#include "core/files/text.h"
#include "renderer/import/model/orientation.h"

namespace minkray {
namespace {

/// True if the name means the model's own frame.
bool is_of_model(const std::string& name) {
  return name.empty() || name == "__model__" || name == "world";
}

std::string canonical_link(const XmlElement& model) {
  if (const std::string* named = model.attribute("canonical_link")) return *named;
  const XmlElement* first = model.child("link");
  return first ? first->attribute_or("name") : "";
}

std::string relative_to(const XmlElement& element) {
  const XmlElement* pose = element.child("pose");
  if (!pose) return "";
  const std::string* named = pose->attribute("relative_to");
  return named ? *named : pose->attribute_or("frame");
}

}  // namespace

Affine<double> sdf_pose(const XmlElement& element, XmlFiles& files) {
  const XmlElement* pose = element.child("pose");
  if (!pose) return {};
  const std::string format = pose->attribute_or("rotation_format", "euler_rpy");
  const std::size_t count = format == "quat_xyzw" ? 7 : 6;
  if (pose->text.find_first_not_of(" \t\r\n") == std::string::npos) return {};
  const auto v = files.numbers_in(*pose, pose->text, "pose", count, count);
  if (!v) return {};
  Affine<double> result;
  result.translation = {(*v)[0], (*v)[1], (*v)[2]};
  if (count == 7) {
    result.linear = rotation_of_quaternion((*v)[3], (*v)[4], (*v)[5], (*v)[6]);
  } else {
    const bool is_degrees =
        pose->attribute_or("degrees") == "true" || pose->attribute_or("degrees") == "1";
    const double unit_of_angle = is_degrees ? 3.14159265358979323846 / 180 : 1;
    result.linear = rotation_of_rpy(unit_of_angle * Vec3<double>((*v)[3], (*v)[4], (*v)[5]));
  }
  return result;
}

std::string sdf_text(const XmlElement& element, std::string_view key) {
  const XmlElement* child = element.child(key);
  return child ? sdf_text(*child) : "";
}

std::string sdf_text(const XmlElement& element) {
  return std::string(without_blanks(element.text));
}

SdfFrames::SdfFrames(const XmlElement& model, XmlFiles& files) : model_(model), files_(files) {
  for (const XmlElement& child : model.children) {
    if (child.name == "include") {
      // Without a name of its own it has that of the included model, which is unknown here.
      const std::string own = sdf_text(child, "name");
      if (!own.empty() &&
          !frames_.emplace(own, Frame{sdf_pose(child, files), relative_to(child), &child}).second)
        files.wrong(child, "name: duplicate");
      continue;
    }
    if (child.name != "link" && child.name != "frame" && child.name != "joint" &&
        child.name != "model")
      continue;
    Frame frame{sdf_pose(child, files), relative_to(child), &child};
    if (child.name == "joint" && frame.relative_to.empty())
      frame.relative_to = sdf_text(child, "child");
    if (child.name == "frame" && frame.relative_to.empty())
      frame.relative_to = child.attribute_or("attached_to");
    const std::string own = child.attribute_or("name");
    // A file's only model may do without a name.
    if (own.empty() && child.name == "model" && model.name != "model") continue;
    if (own.empty()) files.wrong(child, "name: missing");
    if (!frames_.emplace(own, frame).second && child.name != "joint")
      files.wrong(child, "name: duplicate");
  }
}

Affine<double> SdfFrames::pose_of(const std::string& name, const XmlElement& asks) {
  if (is_of_model(name)) return {};
  const std::size_t colons = name.find("::");
  if (colons != name.npos) {
    const std::string outer = name.substr(0, colons), rest = name.substr(colons + 2);
    const auto nested = frames_.find(outer);
    if (nested != frames_.end() && nested->second.element->name == "model") {
      return pose_of(outer, asks) * inner_of(*nested->second.element).pose_of(rest, asks);
    }
  }
  const auto found = frames_.find(name);
  if (found == frames_.end()) {
    files_.wrong(asks, "no frame is named \"" + printable(name, 60) + "\"");
    return {};
  }
  Frame& frame = found->second;
  if (frame.is_open)
    files_.wrong(*frame.element, "frames must not be relative to each other in a cycle");
  else if (!frame.is_known)
    find(frame);
  return frame.in_model;
}

SdfFrames& SdfFrames::inner_of(const XmlElement& model) {
  auto& inner = inner_[&model];
  if (!inner) inner = std::make_unique<SdfFrames>(model, files_);
  return *inner;
}

Affine<double> SdfFrames::pose_in_model(const XmlElement& element, const std::string& otherwise) {
  const std::string named = relative_to(element);
  return pose_of(named.empty() ? otherwise : named, element) * sdf_pose(element, files_);
}

bool SdfFrames::is_relative(const XmlElement& element) const {
  return !relative_to(element).empty();
}

std::string SdfFrames::link_of(const std::string& name) const {
  std::string at = name;
  for (std::size_t steps = 0; steps <= frames_.size(); ++steps) {
    if (at == "__model__" || at.empty()) return canonical_link(model_);
    const auto found = frames_.find(at);
    if (found == frames_.end()) return at;
    const XmlElement& element = *found->second.element;
    if (element.name == "frame")
      at = element.attribute_or("attached_to");
    else if (element.name == "joint")
      at = sdf_text(element, "child");
    else if (element.name == "model")
      return at + "::" + canonical_link(element);
    else
      return at;
  }
  return name;  // in a circle, which is reported when its pose is computed
}

/// Chains of frames may be long: each is made known from its end, without recursion.
void SdfFrames::find(Frame& frame) {
  std::vector<Frame*> chain;
  Frame* at = &frame;
  Affine<double> outer;
  for (;;) {
    at->is_open = true;
    chain.push_back(at);
    const std::string& next = at->relative_to;
    if (is_of_model(next)) break;
    if (next.find("::") != next.npos) {
      outer = pose_of(next, *at->element);
      break;
    }
    const auto there = frames_.find(next);
    if (there == frames_.end() || there->second.is_open) {
      files_.wrong(*at->element,
                   there == frames_.end()
                       ? "relative_to: no frame is named \"" + printable(next, 60) + "\""
                       : "frames must not be relative to each other in a cycle");
      break;
    }
    if (there->second.is_known) {
      outer = there->second.in_model;
      break;
    }
    at = &there->second;
  }
  for (auto one = chain.rbegin(); one != chain.rend(); ++one) {
    outer = outer * (*one)->pose;
    // The frame that a pose places may be one of the nested model's own.
    const XmlElement& element = *(*one)->element;
    const std::string* placed = element.attribute("placement_frame");
    if (placed && element.name == "model")
      outer = outer * inner_of(element).pose_of(*placed, element).inverse();
    (*one)->in_model = outer;
    (*one)->is_known = true;
    (*one)->is_open = false;
  }
}

}  // namespace minkray
