// SPDX-License-Identifier: MIT
#include "renderer/import/scene_of_model.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "core/files/mesh_attributes.h"
#include "core/files/text.h"
#include "renderer/base/errors.h"
#include "renderer/base/hash.h"
#include "renderer/image/colour.h"
#include "renderer/import/model/mesh_looks.h"
#include "renderer/import/model/orientation.h"
#include "renderer/scene/default_light.h"
#include "renderer/scene/framing.h"

namespace minkray {
namespace {

class Materials {
 public:
  explicit Materials(Scene& scene) : scene_(scene) {}

  std::uint32_t of(const Rgba& rgba, const PictureFile& picture = {}) {
    const auto next = static_cast<std::uint32_t>(scene_.materials.size());
    const auto [at, is_new] = known_.emplace(std::pair(rgba, picture.image), next);
    if (is_new) {
      Colour colour;
      for (int i = 0; i < 3; ++i)
        colour[i] = from_srgb(std::clamp(rgba[static_cast<std::size_t>(i)], 0.0, 1.0));
      const bool is_picture = picture.image != nullptr;
      scene_.materials.push_back(
          {(is_picture ? "picture " : "colour ") + std::to_string(next),
           LambertMaterial{is_picture ? Paint(ImageTexture{picture, {"uv"}, 1, colour})
                                      : Paint(colour)}});
      if (!picture.file.empty()) scene_.pictures.emplace_back(picture.file);
    }
    return at->second;
  }

  /// Indices of a mesh file's materials; `none` for those it does not describe.
  const std::vector<std::uint32_t>& of(const std::vector<MeshMaterial>& materials) {
    const auto [at, is_new] = of_files_.try_emplace(&materials);
    if (is_new)
      for (const MeshMaterial& material : materials)
        at->second.push_back(material.has_any ? of(material.rgba, material.picture)
                                              : MeshAttributes::none);
    return at->second;
  }

 private:
  Scene& scene_;
  std::map<std::pair<Rgba, std::shared_ptr<const Image>>, std::uint32_t> known_;
  std::map<const std::vector<MeshMaterial>*, std::vector<std::uint32_t>> of_files_;
};

/// Makes the look of a geom's mesh; null if it has none.
std::shared_ptr<const MeshLook> look_of(const ModelGeom& geom, Materials& materials) {
  if (!geom.mesh || !geom.attributes) return nullptr;
  MeshLook look{geom.attributes};
  if (geom.materials && !geom.attributes->material_of.empty())
    look.materials = materials.of(*geom.materials);
  return std::make_shared<const MeshLook>(std::move(look));
}

void apply(Model& model, const JointsByName& joints, const JointRow& row) {
  for (const auto& [name, value] : row.values)
    if (const auto joint = joints.find(name); joint != joints.end()) joint->second->value = value;
  follow_mimics(model);
}

}  // namespace

std::vector<bool> chosen_geoms(const Model& model, GeometryChoice choice) {
  const bool any_is_seen = std::ranges::any_of(model.geoms, &ModelGeom::is_seen);
  std::vector<bool> wanted;
  for (const ModelGeom& geom : model.geoms)
    wanted.push_back(choice == GeometryChoice::all         ? true
                     : choice == GeometryChoice::collision ? geom.collides
                                                           : geom.is_seen || !any_is_seen);
  return wanted;
}

namespace {

/// A joint's value beyond its limits, and how often it was.
struct BeyondLimits {
  double value = 0;
  std::size_t count = 0;
};
using JointsBeyond = std::map<const ModelJoint*, BeyondLimits>;

/// Joints take the requested values, but values beyond their limits are reported.
void find_beyond(const Model& model, JointsBeyond& beyond) {
  for (const ModelLink& link : model.links)
    for (const ModelJoint& joint : link.joints) {
      if (!joint.limits || width_of(joint.kind) != 1) continue;
      const double value = joint.value.empty() ? joint.reference : joint.value[0];
      const auto [lower, upper] = *joint.limits;
      if (!(value < lower) && !(value > upper)) continue;
      const auto depth = [&](double x) { return std::max(lower - x, x - upper); };
      BeyondLimits& found = beyond.try_emplace(&joint, BeyondLimits{value, 0}).first->second;
      if (depth(value) > depth(found.value)) found.value = value;
      ++found.count;
    }
}

void tell_beyond(Model& model, const JointsBeyond& beyond) {
  for (const ModelLink& link : model.links)
    for (const ModelJoint& joint : link.joints) {
      const auto found = beyond.find(&joint);
      if (found == beyond.end()) continue;
      char text[120];
      std::snprintf(text, sizeof text, "at %.6g, outside %.6g to %.6g", found->second.value,
                    (*joint.limits)[0], (*joint.limits)[1]);
      model.pass_over("limit of the joint \"" + printable(joint.name, 60) + "\"", text,
                      found->second.count);
    }
}

}  // namespace

void pose_model(Model& model, const ImportOptions& options, Mistakes& mistakes) {
  if (!options.keyframe.empty()) {
    if (const ModelKeyframe* found = find_keyframe(model, options.keyframe)) {
      set_values(model, found->values);
    } else {
      const std::string names = listed(keyframe_names(model),
                                       [](const std::string& name) { return printable(name, 40); });
      mistakes.add("--keyframe: no keyframe named " + printable(options.keyframe, 60) + "; " +
                   (names.empty() ? "the file has no keyframes" : "its keyframes are " + names));
    }
  }
  for (const std::string& text : options.joints) {
    const std::size_t equals = text.rfind('=');
    const std::string name = text.substr(0, equals);
    ModelJoint* joint = equals == text.npos ? nullptr : find_joint(model, name);
    if (!joint) {
      std::string names;
      std::size_t count = 0;
      for (const ModelLink& link : model.links)
        for (const ModelJoint& one : link.joints)
          if (one.kind != JointKind::fixed && !one.name.empty() && ++count <= 40)
            names += (names.empty() ? "" : ", ") + printable(one.name, 40);
      mistakes.add("--joint: must be NAME=VALUE of a joint (got \"" + printable(text, 60) +
                   "\"; joints are " + names + (count > 40 ? ", ..." : "") + ")");
      continue;
    }
    if (joint->mimic) {
      mistakes.add("--joint: " + printable(name, 60) + " follows " +
                   printable(joint->mimic->joint, 60) + ", so it cannot be set");
      continue;
    }
    const auto values = numbers_between(text.substr(equals + 1), ',');
    if (!values || values->size() != width_of(joint->kind)) {
      mistakes.add("--joint: " + printable(name, 60) + " takes " +
                   (width_of(joint->kind) == 1
                        ? "one finite number, radians if it is an angle"
                        : std::to_string(width_of(joint->kind)) +
                              " comma-separated numbers, angles in radians") +
                   " (got \"" + printable(text.substr(equals + 1), 60) + "\")");
      continue;
    }
    joint->value = *values;
  }
  follow_mimics(model);
  JointsBeyond beyond;
  if (options.joint_rows.empty()) find_beyond(model, beyond);
  tell_beyond(model, beyond);
}

std::optional<MovingFrame> frame_of_link(Model& model, const std::vector<JointRow>& rows,
                                         const std::string& name) {
  const auto link = std::ranges::find(model.links, name, &ModelLink::name);
  if (link == model.links.end()) return std::nullopt;
  const auto index = static_cast<std::size_t>(link - model.links.begin());
  if (rows.empty()) return MovingFrame{link_poses(model)[index]};
  const JointsByName joints = joints_by_name(model);
  Motion motion;
  for (const JointRow& row : rows) {
    apply(model, joints, row);
    const Affine<double> pose = link_poses(model)[index];
    motion.keys.push_back({row.time, pose.translation, quaternion_of(pose.linear)});
  }
  return MovingFrame{{}, motion};
}

Scene scene_of(Model& model, const ImportOptions& options, const std::vector<JointRow>& rows) {
  Scene scene;
  // Text that is not UTF-8 could not be written as a scene file.
  scene.description = model.format + (model.name.empty() ? "" : " " + printable(model.name));
  Materials materials(scene);
  const std::vector<bool> wanted = chosen_geoms(model, options.geometry);
  std::size_t left_out = 0;
  std::vector<std::size_t> geom_of_object;
  std::map<std::string, int> names;
  const std::vector<Affine<double>> poses = link_poses(model);
  for (std::size_t i = 0; i < model.geoms.size(); ++i) {
    const ModelGeom& geom = model.geoms[i];
    if (!wanted[i]) {
      ++left_out;
      continue;
    }
    Object object;
    const std::string link =
        geom.link < 0 ? "world" : model.links[static_cast<std::size_t>(geom.link)].name;
    object.name = !geom.name.empty() ? geom.name
                                     : (link.empty() ? "link " + std::to_string(geom.link) : link) +
                                           "/" + geom.kind;
    object.name = printable(object.name);
    const int again = names[object.name]++;
    if (again > 0) object.name += " " + std::to_string(again + 1);
    if (geom.mesh)
      object.mesh = geom.mesh;
    else if (geom.shape)
      object.shape = *geom.shape;
    else
      object.half_space = HalfSpaceBody<double>();
    object.pose =
        geom.link < 0 ? geom.pose : poses[static_cast<std::size_t>(geom.link)] * geom.pose;
    object.material = materials.of(geom.rgba);
    object.look = look_of(geom, materials);
    // As mj_ray: what is transparent is met by no ray, unless what collides is to be seen.
    if (geom.alpha_for_rays.value_or(geom.rgba[3]) == 0 && options.geometry == GeometryChoice::all)
      object.visible_to = 0;
    scene.objects.push_back(std::move(object));
    geom_of_object.push_back(i);
  }
  if (left_out > 0) model.pass_over("shapes", "not selected; use --geometry all", left_out);
  if (scene.materials.empty()) materials.of({0.7, 0.7, 0.7, 1});

  const JointsByName joints = joints_by_name(model);
  JointsBeyond beyond;
  for (const JointRow& row : rows) {
    apply(model, joints, row);
    find_beyond(model, beyond);
    const std::vector<Affine<double>> at = link_poses(model);
    for (std::size_t k = 0; k < scene.objects.size(); ++k) {
      const ModelGeom& geom = model.geoms[geom_of_object[k]];
      if (geom.link < 0) continue;
      const Affine<double>& pose = at[static_cast<std::size_t>(geom.link)];
      Object& object = scene.objects[k];
      if (!object.motion) object.motion = Motion{{}, geom.pose};
      object.motion->keys.push_back({row.time, pose.translation, quaternion_of(pose.linear)});
    }
  }
  tell_beyond(model, beyond);
  if (!rows.empty()) set_time(scene, 0);

  frame_everything(scene, options.picture);
  light_everything(scene);

  Hash hash;
  hash.add(model.hash);
  hash.add(options.keyframe);
  for (const std::string& joint : options.joints) hash.add(joint);
  hash.add(std::to_string(static_cast<int>(options.geometry)) +
           std::to_string(static_cast<int>(options.split)));
  const auto add_number = [&](double number) {
    hash.add({reinterpret_cast<const char*>(&number), sizeof number});
  };
  for (const JointRow& row : rows) {
    add_number(row.time);
    for (const auto& [name, values] : row.values) {
      hash.add(name);
      for (const double value : values) add_number(value);
    }
  }
  scene.hash = hash.text();
  return scene;
}

}  // namespace minkray
