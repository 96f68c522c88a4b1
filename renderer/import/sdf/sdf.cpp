// SPDX-License-Identifier: MIT
#include "renderer/import/sdf/sdf.h"

#include <memory>

#include "renderer/import/sdf/sdf_geometry.h"
#include "renderer/import/sdf/sdf_includes.h"
#include "renderer/import/sdf/sdf_joints.h"

namespace minkray {
namespace {

class SdfReader {
 public:
  SdfReader(XmlFiles& files, const ImportOptions& options)
      : files_(files), geometry_(model_, files, options), includes_(model_, files, options) {}

  Model read(XmlElement root) {
    model_.format = "SDF";
    includes_.expand(root);
    read_world(root);
    for (const XmlElement& world : root.children)
      if (world.name == "world") {
        model_.name = world.attribute_or("name");
        read_world(world);
      }
    if (model_.links.empty() && !has_content_)
      files_.wrong(root, "must hold a <world>, a <model> or a <link>");
    connect_links(model_, links_, joints_, files_);
    model_.hash = files_.hash_text();
    geometry_.hand_over_meshes();
    return std::move(model_);
  }

 private:
  /// Place of a model, and its name there.
  struct Placing {
    Affine<double> outer;  ///< of what it is in
    std::string prefix = {};
    int depth = 0;
    Affine<double> pose = {};  ///< in `outer`
  };

  void read_world(const XmlElement& world) {
    frames_.push_back(std::make_unique<SdfFrames>(world, files_));
    SdfFrames& frames = *frames_.back();
    for (const XmlElement& child : world.children) {
      if (child.name == "model" || child.name == "actor") {
        if (model_.name.empty()) model_.name = child.attribute_or("name");
        read_model(child, {{}, "", 0, frames.pose_in_model(child)});
      } else if (child.name == "include") {
        read_include(child, {}, frames);
      } else if (child.name == "world") {
        has_content_ = true;
      } else if (world.name == "world" && child.name != "physics" && child.name != "gravity" &&
                 child.name != "frame") {
        model_.pass_over("<" + printable(child.name, 40) + ">", "not a geometry");
        has_content_ = true;
      }
    }
  }

  void read_model(const XmlElement& model, const Placing& at) {
    has_content_ = true;
    if (at.depth > deepest_sdf_model)
      return files_.wrong(model, "models are nested too deeply, or in a cycle");
    frames_.push_back(std::make_unique<SdfFrames>(model, files_));
    SdfFrames& frames = *frames_.back();
    Affine<double> pose = at.outer * at.pose;
    // The pose may be that of one of the model's own frames.
    const std::string placed = model.attribute_or("placement_frame");
    if (!placed.empty()) pose = pose * frames.pose_of(placed, model).inverse();
    const std::string name = model.attribute_or("name");
    const std::string inner = at.prefix + (name.empty() ? "" : name + "::");
    // Each link and joint carries it.
    if (const auto complaint = complaint_of_length(inner))
      return files_.wrong(model, "name: with the names of the enclosing models, " + *complaint);

    for (const XmlElement& child : model.children) {
      const std::string own = child.attribute_or("name");
      if (child.name == "link") {
        add_link(child, pose, frames, inner);
      } else if (child.name == "joint") {
        joints_.push_back({&child, sdf_text(child, "parent"), sdf_text(child, "child"), inner + own,
                           &frames, pose, inner, includes_.version_of(child) < 1.45});
      } else if (child.name == "model") {
        read_model(child, {pose, inner, at.depth + 1, frames.pose_in_model(child)});
      } else if (child.name == "include") {
        read_include(child, pose, frames);
      } else if (child.name == "plugin" || child.name == "gripper") {
        model_.pass_over("<" + child.name + ">", "not a geometry");
      }
    }
  }

  /// An include that could not be resolved is a mistake that was reported, or one of Gazebo's own.
  void read_include(const XmlElement& include, const Affine<double>& outer, SdfFrames& frames) {
    has_content_ = true;
    if (sdf_text(include, "uri") == "model://ground_plane")
      add_ground_plane(outer * frames.pose_in_model(include));
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
    if (!links_.index.emplace(name, index).second) files_.wrong(link, "name: duplicate link");
    model_.links.push_back({name, -1, model_in_world * in_model});
    links_.elements.push_back(&link);
    for (const XmlElement& child : link.children) {
      if (child.name == "visual" || child.name == "collision")
        geometry_.add(child, index,
                      frames.is_relative(child) ? in_model.inverse() * frames.pose_in_model(child)
                                                : sdf_pose(child, files_));
      else if (child.name == "light" || child.name == "sensor" || child.name == "projector" ||
               child.name == "particle_emitter")
        model_.pass_over("<" + child.name + ">", "not a geometry");
    }
  }

  XmlFiles& files_;
  Model model_;
  SdfGeometry geometry_;
  SdfIncludes includes_;
  bool has_content_ = false;
  std::vector<std::unique_ptr<SdfFrames>> frames_;  ///< of each model
  std::vector<SdfJoint> joints_;
  SdfLinks links_;
};

}  // namespace

Model read_sdf(XmlElement root, XmlFiles& files, const ImportOptions& options) {
  return SdfReader(files, options).read(std::move(root));
}

}  // namespace minkray
