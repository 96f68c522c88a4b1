// SPDX-License-Identifier: MIT
#include "renderer/import/sdf/sdf_includes.h"

#include <algorithm>
#include <sstream>

#include "renderer/import/mesh/mesh_library.h"
#include "renderer/import/model/orientation.h"
#include "renderer/import/sdf/sdf_frames.h"
#include "renderer/import/sdf/urdf_as_sdf.h"

namespace minkray {
namespace {

constexpr int most_includes = 1000;
constexpr double newest_version = 1.9;

bool is_true(const std::string& text) {
  return text == "true" || text == "1";
}

void set_attribute(XmlElement& element, const std::string& name, const std::string& value) {
  for (XmlAttribute& attribute : element.attributes)
    if (attribute.name == name) {
      attribute.value = value;
      return;
    }
  element.attributes.push_back({name, value});
}

}  // namespace

void SdfIncludes::expand(XmlElement& root) {
  drop_vendor_prefixes(root);
  version_of_file_[root.file] = files_.number(root, "version").value_or(newest_version);
  expand(root, 0);
}

double SdfIncludes::version_of(const XmlElement& element) const {
  const auto known = version_of_file_.find(element.file);
  return known == version_of_file_.end() ? newest_version : known->second;
}

void SdfIncludes::expand(XmlElement& parent, int depth) {
  std::vector<XmlElement> children;
  for (XmlElement& child : parent.children) {
    int inner = depth;
    bool is_merged = false;
    if (child.name == "include") {
      if (depth >= deepest_sdf_model) {
        files_.wrong(child, "files include each other in a cycle");
        continue;
      }
      std::optional<XmlElement> model = model_for(child);
      if (!model) {
        children.push_back(std::move(child));
        continue;
      }
      is_merged = parent.name == "model" && is_true(child.attribute_or("merge"));
      child = std::move(*model);
      ++inner;
    }
    if (child.name == "model" || child.name == "world") expand(child, inner);
    if (is_merged)
      merge(std::move(child), children);
    else
      children.push_back(std::move(child));
  }
  parent.children = std::move(children);
}

/// The contents of the model become the parent's own, placed by a frame that represents the model.
void SdfIncludes::merge(XmlElement model, std::vector<XmlElement>& children) {
  const std::string frame_name = "_merged__" + model.attribute_or("name") + "__model__";
  const auto is_of_model = [](const std::string& name) {
    return name.empty() || name == "__model__";
  };
  XmlElement frame;
  frame.name = "frame";
  frame.line = model.line;
  frame.file = model.file;
  set_attribute(frame, "name", frame_name);
  if (const XmlElement* first = model.child("link"))
    set_attribute(frame, "attached_to",
                  model.attribute_or("canonical_link", first->attribute_or("name")));
  const XmlElement* given = model.child("pose");
  XmlElement pose = given ? *given : frame;
  pose.name = "pose";
  if (!given) pose.attributes.clear();
  if (is_of_model(pose.attribute_or("relative_to")))
    set_attribute(pose, "relative_to", "__model__");
  if (const std::string placed = model.attribute_or("placement_frame"); !placed.empty())
    place_by(SdfFrames(model, files_).pose_of(placed, model), pose);
  frame.children.push_back(std::move(pose));
  children.push_back(std::move(frame));

  for (XmlElement& child : model.children) {
    const bool is_placed =
        child.name == "link" || child.name == "model" || child.name == "include" ||
        (child.name == "frame" && is_of_model(child.attribute_or("attached_to")));
    if (child.name == "pose" || child.name == "static") continue;
    if (child.name == "frame" && is_of_model(child.attribute_or("attached_to")))
      set_attribute(child, "attached_to", frame_name);
    auto own = std::ranges::find(child.children, "pose", &XmlElement::name);
    if (own == child.children.end() && is_placed) {
      XmlElement at_origin;
      at_origin.name = "pose";
      at_origin.line = child.line;
      at_origin.file = child.file;
      child.children.push_back(std::move(at_origin));
      own = child.children.end() - 1;
    }
    if (own != child.children.end()) {
      const std::string* named = own->attribute("relative_to");
      if (named ? is_of_model(*named) : is_placed) set_attribute(*own, "relative_to", frame_name);
    }
    if (child.name == "joint")
      for (XmlElement& end : child.children)
        if ((end.name == "parent" || end.name == "child") && sdf_text(end) == "__model__")
          end.text = frame_name;
    children.push_back(std::move(child));
  }
}

void SdfIncludes::place_by(const Affine<double>& placed, XmlElement& pose) {
  XmlElement holder;
  holder.children.push_back(pose);
  const Affine<double> at = sdf_pose(holder, files_) * placed.inverse();
  std::ostringstream text;
  text.precision(17);
  for (const double x : at.translation) text << x << ' ';
  for (const double x : quaternion_of(at.linear)) text << x << ' ';
  pose.text = text.str();
  std::erase_if(pose.attributes, [](const XmlAttribute& one) { return one.name == "degrees"; });
  set_attribute(pose, "rotation_format", "quat_xyzw");
}

std::optional<XmlElement> SdfIncludes::model_for(const XmlElement& include) {
  const std::string uri = sdf_text(include, "uri");
  const auto refuse = [&](const std::string& why) {
    files_.wrong(include, why);
    return std::nullopt;
  };
  if (uri.empty()) return refuse("uri: missing");
  if (++count_ > most_includes)
    return refuse("includes more than " + std::to_string(most_includes) + " files");
  const std::filesystem::path folder = files_.files()[include.file].parent_path();
  std::vector<std::filesystem::path> places;
  std::optional<std::filesystem::path> file;
  const MeshLibrary library(folder, options_);
  for (const char* inside : {"", "/model.config", "/model.sdf"})
    if (!file) file = library.find(uri + inside, places);
  if (file && file->filename() == "model.config") file = file_of_config(*file, include);
  if (file && file->empty()) return std::nullopt;
  if (!file) {
    if (uri == "model://sun") model_.pass_over("<include>", "model://sun is a light");
    if (uri == "model://sun" || uri == "model://ground_plane") return std::nullopt;
    return refuse("the model \"" + printable(uri, 100) +
                  "\" not found (searched: " + list_of_places(places) + "); set --model-dir");
  }
  std::optional<XmlElement> root = files_.read(*file);
  if (!root) return std::nullopt;
  if (root->name != "robot") drop_vendor_prefixes(*root);
  version_of_file_[root->file] = files_.number(*root, "version").value_or(newest_version);
  XmlElement model;
  if (root->name == "robot") {
    model = sdf_of_urdf(std::move(*root), files_);
  } else {
    const auto found = std::ranges::find_if(root->children, [](const XmlElement& child) {
      return child.name == "model" || child.name == "actor" || child.name == "light";
    });
    if (found == root->children.end())
      return refuse("the file " + printable(file->string(), 100) +
                    " has no <model>, <actor> or <light>");
    if (found->name == "light") {
      model_.pass_over("<light>", "not a geometry");
      return std::nullopt;
    }
    model = std::move(*found);
  }
  // A mistake in its pose or name is a mistake of the <include>.
  model.line = include.line;
  model.file = include.file;
  if (const std::string name = sdf_text(include, "name"); !name.empty()) {
    if (const auto complaint = complaint_of_length(name)) return refuse("name: " + *complaint);
    set_attribute(model, "name", name);
  }
  if (const std::string frame = sdf_text(include, "placement_frame"); !frame.empty())
    set_attribute(model, "placement_frame", frame);
  if (const XmlElement* pose = include.child("pose")) {
    std::erase_if(model.children, [](const XmlElement& child) { return child.name == "pose"; });
    model.children.push_back(*pose);
  }
  return model;
}

/// The file that a model.config names: of several that of the highest version. An empty path, and a
/// mistake, if it names none.
std::filesystem::path SdfIncludes::file_of_config(const std::filesystem::path& config,
                                                  const XmlElement& include) {
  const std::optional<XmlElement> root = files_.read(config);
  if (!root) return {};
  std::string name;
  double highest = -1;
  for (const XmlElement& child : root->children) {
    if (child.name != "sdf") continue;
    const double version = files_.number(child, "version").value_or(0);
    if (version <= highest) continue;
    highest = version;
    name = sdf_text(child);
  }
  std::error_code error;
  const std::filesystem::path file = config.parent_path() / name;
  if (!name.empty() && std::filesystem::is_regular_file(file, error)) return file;
  files_.wrong(include, printable(config.string(), 200) + ": no <sdf> file found" +
                            (name.empty() ? "" : " (got \"" + printable(name, 60) + "\")"));
  return {};
}

}  // namespace minkray
