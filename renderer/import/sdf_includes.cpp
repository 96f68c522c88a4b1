// SPDX-License-Identifier: MIT
#include "renderer/import/sdf_includes.h"

#include <algorithm>

#include "renderer/import/mesh_library.h"
#include "renderer/import/sdf_frames.h"

namespace minkray {
namespace {

constexpr int most_includes = 1000;
constexpr double newest_version = 1.9;

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
  version_of_file_[root.file] = files_.number(root, "version").value_or(newest_version);
  expand(root, 0);
}

double SdfIncludes::version_of(const XmlElement& element) const {
  const auto known = version_of_file_.find(element.file);
  return known == version_of_file_.end() ? newest_version : known->second;
}

void SdfIncludes::expand(XmlElement& parent, int depth) {
  for (XmlElement& child : parent.children) {
    int inner = depth;
    if (child.name == "include") {
      if (depth >= deepest_sdf_model) {
        files_.wrong(child, "files include each other for ever");
        continue;
      }
      std::optional<XmlElement> model = model_for(child);
      if (!model) continue;
      child = std::move(*model);
      ++inner;
    }
    if (child.name == "model" || child.name == "world") expand(child, inner);
  }
}

std::optional<XmlElement> SdfIncludes::model_for(const XmlElement& include) {
  const std::string uri = sdf_text(include, "uri");
  const auto refuse = [&](const std::string& why) {
    files_.wrong(include, why);
    return std::nullopt;
  };
  if (uri.empty()) return refuse("uri: must be there");
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
    return refuse("the model \"" + printable(uri, 100) + "\" is not there (looked for " +
                  list_of_places(places) + "); --model-dir says where models are");
  }
  std::optional<XmlElement> root = files_.read(*file);
  if (!root) return std::nullopt;
  version_of_file_[root->file] = files_.number(*root, "version").value_or(newest_version);
  const auto found = std::ranges::find(root->children, "model", &XmlElement::name);
  if (found == root->children.end())
    return refuse("the file " + printable(file->string(), 100) + " has no <model>");
  XmlElement model = std::move(*found);
  // What is wrong with its pose or name is wrong with the <include>.
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
  if (include.attribute_or("merge") == "true")
    model_.pass_over("merge of an <include>", "the model is nested instead");
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
  files_.wrong(include, printable(config.string(), 200) + ": names no <sdf> file that is there" +
                            (name.empty() ? "" : " (got \"" + printable(name, 60) + "\")"));
  return {};
}

}  // namespace minkray
