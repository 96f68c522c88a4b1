// SPDX-License-Identifier: MIT
#include "renderer/import/sdf.h"

#include <memory>

#include "renderer/import/mesh_library.h"
#include "renderer/import/sdf_geometry.h"
#include "renderer/import/sdf_joints.h"

namespace minkray {
namespace {

constexpr int deepest_model = 32;

class SdfReader {
 public:
  SdfReader(XmlFiles& files, const ImportOptions& options)
      : files_(files), options_(options), geometry_(model_, files, options) {}

  Model read(const XmlElement& root) {
    model_.format = "SDF";
    read_world(root, 0);
    for (const XmlElement& world : root.children)
      if (world.name == "world") {
        model_.name = world.attribute_or("name");
        read_world(world, 0);
      }
    if (model_.links.empty() && !has_content_)
      files_.wrong(root, "must hold a <world>, a <model> or a <link>");
    connect_links(model_, links_, joints_, files_);
    model_.hash = files_.hash_text();
    geometry_.hand_over_meshes();
    return std::move(model_);
  }

 private:
  void read_world(const XmlElement& world, int depth) {
    for (const XmlElement& child : world.children) {
      if (child.name == "model" || child.name == "actor") {
        if (model_.name.empty()) model_.name = child.attribute_or("name");
        read_model(child, {}, "", depth, "");
      } else if (child.name == "include") {
        read_include(child, {}, "", depth);
      } else if (child.name == "world") {
        has_content_ = true;
      } else if (world.name == "world" && child.name != "physics" && child.name != "gravity") {
        model_.pass_over("<" + printable(child.name, 40) + ">", "is no geometry");
        has_content_ = true;
      }
    }
  }

  void read_model(const XmlElement& model, const Affine<double>& outer, const std::string& prefix,
                  int depth, const std::string& name_given,
                  const std::optional<Affine<double>>& pose_given = std::nullopt) {
    has_content_ = true;
    if (depth > deepest_model)
      return files_.wrong(model, "models are nested too deeply, or for ever");
    frames_.push_back(std::make_unique<SdfFrames>(model, files_));
    SdfFrames& frames = *frames_.back();
    const Affine<double> pose = outer * pose_given.value_or(sdf_pose(model, files_));
    const std::string name = name_given.empty() ? model.attribute_or("name") : name_given;
    const std::string inner = prefix + (name.empty() ? "" : name + "::");

    for (const XmlElement& child : model.children) {
      const std::string own = child.attribute_or("name");
      if (child.name == "link") {
        add_link(child, pose * frames.pose_of(own, child), inner + own);
      } else if (child.name == "joint") {
        joints_.push_back({&child, sdf_text(child, "parent"), sdf_text(child, "child"), inner + own,
                           &frames, pose, inner});
      } else if (child.name == "model") {
        const Affine<double> at = frames.pose_of(own, child);
        read_model(child, pose, inner, depth + 1, own, at);
      } else if (child.name == "include") {
        read_include(child, pose, inner, depth + 1);
      } else if (child.name == "plugin" || child.name == "gripper") {
        model_.pass_over("<" + child.name + ">", "is no geometry");
      }
    }
  }

  /// Another file's model, in a folder with a model.config or a model.sdf.
  void read_include(const XmlElement& include, const Affine<double>& outer,
                    const std::string& prefix, int depth) {
    has_content_ = true;
    const std::string uri = sdf_text(include, "uri");
    if (uri.empty()) return files_.wrong(include, "uri: must be there");
    if (depth > deepest_model) return files_.wrong(include, "files include each other for ever");
    if (++includes_ > 1000) return files_.wrong(include, "includes more than 1000 files");
    const std::filesystem::path folder = files_.files()[include.file].parent_path();
    std::vector<std::filesystem::path> places;
    std::optional<std::filesystem::path> file;
    for (const char* inside : {"", "/model.sdf"}) {
      MeshLibrary library(folder, options_);
      if (!file) file = library.find(uri + inside, places);
    }
    if (!file) {
      if (uri == "model://sun") return model_.pass_over("<include>", "model://sun is a light");
      if (uri == "model://ground_plane") return add_ground_plane(include, outer);
      std::string text;
      for (const auto& place : places) text += (text.empty() ? "" : ", ") + place.string();
      return files_.wrong(include, "the model \"" + printable(uri, 100) +
                                       "\" is not there (looked for " + printable(text, 400) +
                                       "); --model-dir says where models are");
    }
    std::optional<XmlElement> root = files_.read(*file);
    if (!root) return;
    included_.push_back(std::make_unique<XmlElement>(std::move(*root)));
    for (const XmlElement& model : included_.back()->children) {
      if (model.name != "model") continue;
      std::optional<Affine<double>> pose;
      if (include.child("pose")) pose = sdf_pose(include, files_);
      read_model(model, outer, prefix, depth + 1, sdf_text(include, "name"), pose);
      return;
    }
    files_.wrong(include, "the file " + printable(file->string(), 100) + " has no <model>");
  }

  /// Gazebo has it wherever it is installed.
  void add_ground_plane(const XmlElement& include, const Affine<double>& outer) {
    ModelGeom geom;
    geom.kind = "plane";
    geom.name = "ground_plane";
    geom.pose = outer * sdf_pose(include, files_);
    model_.geoms.push_back(geom);
  }

  void add_link(const XmlElement& link, const Affine<double>& in_world, const std::string& name) {
    const int index = static_cast<int>(model_.links.size());
    if (!links_.index.emplace(name, index).second)
      files_.wrong(link, "name: must not be the name of two links");
    model_.links.push_back({name, -1, in_world});
    links_.elements.push_back(&link);
    for (const XmlElement& child : link.children) {
      if (child.name == "visual" || child.name == "collision")
        geometry_.add(child, index);
      else if (child.name == "light" || child.name == "sensor" || child.name == "projector" ||
               child.name == "particle_emitter")
        model_.pass_over("<" + child.name + ">", "is no geometry");
    }
  }

  XmlFiles& files_;
  const ImportOptions& options_;
  Model model_;
  SdfGeometry geometry_;
  bool has_content_ = false;
  int includes_ = 0;
  std::vector<std::unique_ptr<SdfFrames>> frames_;  ///< of each model
  std::vector<std::unique_ptr<XmlElement>> included_;
  std::vector<SdfJoint> joints_;
  SdfLinks links_;
};

}  // namespace

Model read_sdf(const XmlElement& root, XmlFiles& files, const ImportOptions& options) {
  return SdfReader(files, options).read(root);
}

}  // namespace minkray
