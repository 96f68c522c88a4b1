// SPDX-License-Identifier: MIT
#include "renderer/scene_json/read_objects.h"

#include <utility>

#include "renderer/json/values.h"
#include "renderer/member_json/member_codec.h"
#include "renderer/member_json/shape_json.h"
#include "renderer/scene_json/half_space_json.h"
#include "renderer/scene_json/height_field_json.h"
#include "renderer/scene_json/mesh_json.h"
#include "renderer/scene_json/mesh_look.h"
#include "renderer/scene_json/read_split.h"
#include "renderer/scene_json/read_visible_to.h"

namespace minkray {
namespace {

Affine<double> read_transform(ObjectReader& object) {
  const Json* written = object.find("transform");
  if (!written) return {};
  ObjectReader transform(*written, object.path("transform"), object.mistakes());
  const Affine<double> pose = read_affine(transform).value_or(Affine<double>());
  transform.finish();
  return pose;
}

/// Base of the name of an object without a name.
std::string kind_of(const Json& object) {
  for (const char* key : {"mesh", "height_field"})
    if (object.contains(key)) return key;
  const Json* shape = object.find("shape");
  const Json* type = shape ? shape->find("type") : nullptr;
  return type && type->is_string() ? type->text() : "object";
}

bool is_group(const Json& item) {
  return item.contains("objects") || item.contains("include");
}

}  // namespace

void ObjectsReader::read(const SceneFile& file) {
  file_ = &file;
  if (const Json* objects = file.json.find("objects"))
    read_list(*objects, JsonPath() / "objects", {});
}

void ObjectsReader::read_list(const Json& objects, const JsonPath& path, const Frame& frame) {
  if (!objects.is_array()) {
    mistakes_.add(path, "must be a list (" + found(objects) + ")");
    return;
  }
  for (std::size_t i = 0; i < objects.size() && !is_full_; ++i)
    read_item(objects[i], path / i, frame);
}

void ObjectsReader::read_item(const Json& json, const JsonPath& path, const Frame& frame) {
  if (!json.is_object() || !is_group(json))
    read_object(json, path, frame);
  else if (!is_version_one())  // groups in version 1 are reported already
    read_group(json, path, frame);
}

void ObjectsReader::read_group(const Json& json, const JsonPath& path, const Frame& frame) {
  ObjectReader group(json, path, mistakes_);
  if (++groups_ > most_groups || scene_.objects.size() > most_objects_of_groups) {
    mistakes_.add(path, "must not bring the number of groups above " + std::to_string(most_groups) +
                            ", or that of their objects above " +
                            std::to_string(most_objects_of_groups));
    is_full_ = true;
    return;
  }
  Frame inner = frame;
  if (const Json* name = group.find("name"))
    if (const auto text = read_string(*name, group.path("name"), mistakes_); text && !text->empty())
      inner.name += *text + "/";
  const Affine<double> pose = read_transform(group);
  if (!(pose == Affine<double>())) {
    inner.pose = frame.is_posed ? frame.pose * pose : pose;
    inner.is_posed = true;
  }
  if (const Json* name = group.find("include")) {
    const auto included = file_->included.find(name);
    std::set<const SceneFile*> read;
    if (included != file_->included.end() && included->second)
      read_included(*included->second, inner, read);
  }
  if (const Json* objects = group.find("objects"))
    read_list(*objects, group.path("objects"), inner);
  group.finish();
}

void ObjectsReader::read_included(const SceneFile& file, const Frame& frame,
                                  std::set<const SceneFile*>& read) {
  if (!read.insert(&file).second) return;
  for (const SceneFile* included : file.included_by_file) read_included(*included, frame, read);
  const SceneFile* const outer = std::exchange(file_, &file);
  {
    const MistakesIn naming(mistakes_, file.shown);
    meshes_.set_folder_of_names(file.folder);
    if (file.json.find("particles"))
      mistakes_.add(JsonPath() / "particles",
                    "must not be in a file that a group includes: include it at the top of the "
                    "scene");
    if (const Json* objects = file.json.find("objects"))
      read_list(*objects, JsonPath() / "objects", frame);
  }
  file_ = outer;
  meshes_.set_folder_of_names(file_->folder);
}

std::string ObjectsReader::read_name_of(ObjectReader& object, const Json& json,
                                        const Frame& frame) {
  const Json* written =
      is_version_one() ? object.require("name", "the object's name") : object.find("name");
  if (!written) return frame.name + kind_of(json) + " " + std::to_string(scene_.objects.size() + 1);
  const auto name = read_string(*written, object.path("name"), mistakes_);
  if (name && name->empty()) mistakes_.add(object.path("name"), "must not be empty");
  return frame.name + name.value_or("");
}

std::uint32_t ObjectsReader::read_material_of(ObjectReader& object) {
  if (is_version_one()) {
    const Json* written = object.require("material", "the name of a material");
    return written ? materials_.named(*written, object.path("material"), mistakes_) : 0;
  }
  const Json *material = object.find("material"), *colour = object.find("color");
  if (material && colour)
    mistakes_.add(object.path("color"), "not allowed together with \"material\"");
  if (material) return materials_.named(*material, object.path("material"), mistakes_);
  if (colour)
    return materials_.of_colour(*colour, object.path("color"), mistakes_, meshes_, file_->shown);
  return materials_.default_one();
}

std::optional<Motion> ObjectsReader::read_motion(ObjectReader& object, const Affine<double>& pose,
                                                 const Frame& frame) {
  const Json* written = object.find("keys");
  Vec3<double> pivot = is_version_one() ? Vec3<double>(Vec3<double>::Zero()) : pose.translation;
  if (const Json* point = is_version_one() ? nullptr : object.find("pivot")) {
    pivot = read_vector(*point, object.path("pivot"), mistakes_).value_or(pivot);
    if (!written) mistakes_.add(object.path("pivot"), "not allowed without \"keys\"");
  }
  if (!written) return std::nullopt;
  Motion motion{read_keys(*written, object.path("keys"), mistakes_, pivot), pose};
  if (!pivot.isZero(0)) motion.rest.translation -= pivot;
  if (motion.keys.empty() || !frame.is_posed) return motion;
  auto posed = motion.posed(frame.pose);
  if (!posed)
    mistakes_.add(object.path("keys"),
                  "must not turn the object in a group that is scaled unevenly or sheared");
  return posed;
}

void ObjectsReader::read_object(const Json& json, const JsonPath& path, const Frame& frame) {
  ObjectReader object(json, path, mistakes_);
  if (!object.is_object()) return;
  const std::string name = read_name_of(object, json, frame);
  std::vector<Shape> shapes;
  std::optional<HalfSpaceBody<double>> half_space;
  const Json* const split = object.find("split");
  SceneMesh mesh;
  const Json *const triangles = object.find("mesh"), *const heights = object.find("height_field");
  if (triangles || heights) {
    const std::string given = triangles ? "mesh" : "height_field";
    for (const char* other : {"shape", "split", "height_field"})
      if (given != other && object.find(other))
        mistakes_.add(object.path(other), "not allowed together with \"" + given + "\"");
    if (triangles)
      mesh = read_mesh(*triangles, object.path(given), mistakes_, meshes_);
    else
      mesh.mesh = read_height_field(*heights, object.path(given), mistakes_, meshes_);
  } else if (const Json* written =
                 object.require("shape", "a shape, \"mesh\" or \"height_field\"")) {
    if (split) {
      if (auto hulls = read_split_hulls(object, *split, *written, meshes_))
        shapes = std::move(*hulls);
    } else if (is_half_space(*written)) {
      half_space = read_half_space(*written, object.path("shape"), mistakes_, meshes_);
    } else if (auto shape = read_shape(*written, object.path("shape"), mistakes_, meshes_)) {
      shapes.push_back(std::move(*shape));
    }
  }
  const std::uint32_t material = read_material_of(object);
  const Affine<double> own = read_transform(object);
  std::optional<Motion> motion = read_motion(object, own, frame);
  const RayKinds visible_to = read_visible_to(object);
  check_visible(scene_, material, visible_to, object);
  object.finish();
  const Affine<double> pose = frame.is_posed ? frame.pose * own : own;
  if (frame.is_posed && (!pose.translation.allFinite() || !pose.linear.allFinite() ||
                         !inverse_of(pose.linear).allFinite()))
    mistakes_.add(path, "must have size and position within the range of numbers");
  Object made{name, Point(), pose, material, std::move(motion)};
  made.half_space = half_space;
  made.visible_to = visible_to;
  made.mesh = mesh.mesh;
  const bool takes_file = !is_version_one() && !object.find("material") && !object.find("color");
  if (made.mesh)
    made.look =
        look_of(mesh, takes_file, scene_, materials_, meshes_, object.path("mesh"), mistakes_);
  check_look(scene_, made, path, mistakes_);
  if (!made.has_shape()) scene_.objects.push_back(made);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (split) made.name = name + "[" + std::to_string(i) + "]";
    made.shape = std::move(shapes[i]);
    scene_.objects.push_back(made);
  }
}

}  // namespace minkray
