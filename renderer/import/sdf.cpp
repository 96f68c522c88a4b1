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
    read_world(root, version_of(root));
    for (const XmlElement& world : root.children)
      if (world.name == "world") {
        model_.name = world.attribute_or("name");
        read_world(world, version_of(root));
      }
    if (model_.links.empty() && !has_content_)
      files_.wrong(root, "must hold a <world>, a <model> or a <link>");
    connect_links(model_, links_, joints_, files_);
    model_.hash = files_.hash_text();
    geometry_.hand_over_meshes();
    return std::move(model_);
  }

 private:
  /// Where a model stands, and what it is called there.
  struct Placing {
    Affine<double> outer;  ///< of what it is in
    std::string prefix = {};
    int depth = 0;
    double version = 0;                           ///< of the file
    std::string name = {}, placement_frame = {};  ///< empty: its own
    std::optional<Affine<double>> pose = {};
  };

  double version_of(const XmlElement& root) { return files_.number(root, "version").value_or(1.9); }

  void read_world(const XmlElement& world, double version) {
    frames_.push_back(std::make_unique<SdfFrames>(world, files_));
    SdfFrames& frames = *frames_.back();
    for (const XmlElement& child : world.children) {
      if (child.name == "model" || child.name == "actor") {
        if (model_.name.empty()) model_.name = child.attribute_or("name");
        Placing at{{}, "", 0, version};
        at.pose = frames.pose_in_model(child);
        read_model(child, at);
      } else if (child.name == "include") {
        read_include(child, frames, {{}, "", 0, version});
      } else if (child.name == "world") {
        has_content_ = true;
      } else if (world.name == "world" && child.name != "physics" && child.name != "gravity" &&
                 child.name != "frame") {
        model_.pass_over("<" + printable(child.name, 40) + ">", "is no geometry");
        has_content_ = true;
      }
    }
  }

  void read_model(const XmlElement& model, const Placing& at) {
    has_content_ = true;
    if (at.depth > deepest_model)
      return files_.wrong(model, "models are nested too deeply, or for ever");
    frames_.push_back(std::make_unique<SdfFrames>(model, files_));
    SdfFrames& frames = *frames_.back();
    Affine<double> pose = at.outer * at.pose.value_or(sdf_pose(model, files_));
    // The pose may be that of one of the model's own frames.
    const std::string placed =
        at.placement_frame.empty() ? model.attribute_or("placement_frame") : at.placement_frame;
    if (!placed.empty()) pose = pose * frames.pose_of(placed, model).inverse();
    const std::string name = at.name.empty() ? model.attribute_or("name") : at.name;
    const std::string inner = at.prefix + (name.empty() ? "" : name + "::");

    for (const XmlElement& child : model.children) {
      const std::string own = child.attribute_or("name");
      if (child.name == "link") {
        add_link(child, pose, frames, inner);
      } else if (child.name == "joint") {
        joints_.push_back({&child, sdf_text(child, "parent"), sdf_text(child, "child"), inner + own,
                           &frames, pose, inner, at.version < 1.45});
      } else if (child.name == "model") {
        read_model(child,
                   {pose, inner, at.depth + 1, at.version, own, "", frames.pose_in_model(child)});
      } else if (child.name == "include") {
        read_include(child, frames, {pose, inner, at.depth + 1, at.version});
      } else if (child.name == "plugin" || child.name == "gripper") {
        model_.pass_over("<" + child.name + ">", "is no geometry");
      }
    }
  }

  /// The file that a model.config names: of several that of the highest version. An empty path, and
  /// a mistake, if it names none.
  std::filesystem::path file_of_config(const std::filesystem::path& config,
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

  /// Another file's model, in a folder with a model.config or a model.sdf.
  void read_include(const XmlElement& include, SdfFrames& frames, Placing at) {
    has_content_ = true;
    const std::string uri = sdf_text(include, "uri");
    if (uri.empty()) return files_.wrong(include, "uri: must be there");
    if (at.depth > deepest_model) return files_.wrong(include, "files include each other for ever");
    if (++includes_ > 1000) return files_.wrong(include, "includes more than 1000 files");
    const std::filesystem::path folder = files_.files()[include.file].parent_path();
    std::vector<std::filesystem::path> places;
    std::optional<std::filesystem::path> file;
    const MeshLibrary library(folder, options_);
    for (const char* inside : {"", "/model.config", "/model.sdf"})
      if (!file) file = library.find(uri + inside, places);
    if (file && file->filename() == "model.config") file = file_of_config(*file, include);
    if (file && file->empty()) return;
    if (!file) {
      if (uri == "model://sun") return model_.pass_over("<include>", "model://sun is a light");
      if (uri == "model://ground_plane")
        return add_ground_plane(at.outer * frames.pose_in_model(include));
      return files_.wrong(include, "the model \"" + printable(uri, 100) +
                                       "\" is not there (looked for " + list_of_places(places) +
                                       "); --model-dir says where models are");
    }
    std::optional<XmlElement> root = files_.read(*file);
    if (!root) return;
    included_.push_back(std::make_unique<XmlElement>(std::move(*root)));
    for (const XmlElement& model : included_.back()->children) {
      if (model.name != "model") continue;
      if (include.child("pose")) at.pose = frames.pose_in_model(include);
      at.name = sdf_text(include, "name");
      at.placement_frame = sdf_text(include, "placement_frame");
      at.version = version_of(*included_.back());
      ++at.depth;
      return read_model(model, at);
    }
    files_.wrong(include, "the file " + printable(file->string(), 100) + " has no <model>");
  }

  /// Gazebo has it wherever it is installed.
  void add_ground_plane(const Affine<double>& pose) {
    ModelGeom geom;
    geom.kind = "plane";
    geom.name = "ground_plane";
    geom.pose = pose;
    model_.geoms.push_back(geom);
  }

  void add_link(const XmlElement& link, const Affine<double>& model_in_world, SdfFrames& frames,
                const std::string& prefix) {
    const std::string own = link.attribute_or("name"), name = prefix + own;
    const Affine<double> in_model = frames.pose_of(own, link);
    const int index = static_cast<int>(model_.links.size());
    if (!links_.index.emplace(name, index).second)
      files_.wrong(link, "name: must not be the name of two links");
    model_.links.push_back({name, -1, model_in_world * in_model});
    links_.elements.push_back(&link);
    for (const XmlElement& child : link.children) {
      if (child.name == "visual" || child.name == "collision")
        geometry_.add(child, index,
                      frames.is_relative(child) ? in_model.inverse() * frames.pose_in_model(child)
                                                : sdf_pose(child, files_));
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
