// SPDX-License-Identifier: MIT
#include "renderer/plan/collision_object.h"

#include <algorithm>
#include <cmath>

#include "core/files/text.h"
#include "renderer/import/mesh/geometry_common.h"
#include "renderer/import/model/orientation.h"
#include "renderer/json/object_reader.h"
#include "renderer/json/values.h"
#include "renderer/plan/message_fields.h"
#include "renderer/plan/message_values.h"

namespace minkray {
namespace {

/// shape_msgs/SolidPrimitive: its numbers and what they mean.
struct Primitive {
  std::string_view name;
  int number;
  std::size_t dimensions;
  Shape (*make)(const std::vector<double>& d);
};
const Primitive primitives[] = {
    {"box", 1, 3,
     [](const std::vector<double>& d) { return box_of(Vec3<double>(d[0], d[1], d[2]) / 2); }},
    {"sphere", 2, 1, [](const std::vector<double>& d) { return sphere_of(d[0]); }},
    {"cylinder", 3, 2, [](const std::vector<double>& d) { return cylinder_of(d[1], d[0] / 2); }},
    {"cone", 4, 2, [](const std::vector<double>& d) { return cone_of(d[1], d[0] / 2); }},
};

const Primitive* primitive_of(const Json& type) {
  for (const Primitive& one : primitives) {
    if (type.is_number() && type.get<double>() == one.number) return &one;
    if (type.is_string() && lower_case(type.text()) == one.name) return &one;
  }
  return nullptr;
}

enum class Operation : unsigned char { add, remove, append, move };

}  // namespace

CollisionObjects::CollisionObjects(const std::string& file, const ImportOptions& options,
                                   Mistakes& mistakes)
    : meshes_(std::filesystem::path(file).parent_path(), options), mistakes_(mistakes) {}

Affine<double> CollisionObjects::pose_of(const Json& json, std::string_view key, std::size_t index,
                                         const JsonPath& path) {
  const Json& poses = list_of(json, key, path, mistakes_);
  if (index >= poses.size()) return {};
  return read_message_pose(poses[index], path / key / index, mistakes_);
}

void CollisionObjects::check_poses(const Json& json, std::string_view shapes,
                                   std::string_view poses, const JsonPath& path) {
  const std::size_t wanted = list_of(json, shapes, path, mistakes_).size(),
                    given = list_of(json, poses, path, mistakes_).size();
  if (given != 0 && given != wanted)
    mistakes_.add(path / poses, "must be one for each of the " + std::to_string(wanted) + " " +
                                    std::string(shapes) + " (got " + std::to_string(given) + ")");
}

void CollisionObjects::add_primitives(const Json& json, const JsonPath& path,
                                      PlannedObject& object) {
  const Json& list = list_of(json, "primitives", path, mistakes_);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const JsonPath at = path / "primitives" / i;
    check_fields(list[i], Message::primitive, at, mistakes_);
    const Json* type = member_of(list[i], "type");
    const Primitive* primitive = type ? primitive_of(*type) : nullptr;
    if (!primitive) {
      mistakes_.add(at / "type", "must be box (1), sphere (2), cylinder (3) or cone (4) (" +
                                     (type ? found(*type) : std::string("missing")) + ")");
      continue;
    }
    const Json* dimensions = member_of(list[i], "dimensions");
    if (!dimensions) {
      mistakes_.add(at / "dimensions",
                    "missing: must be a list of " + std::to_string(primitive->dimensions));
      continue;
    }
    const auto d = read_numbers(*dimensions, at / "dimensions", mistakes_, primitive->dimensions,
                                Range::not_negative);
    if (!d) continue;
    ModelGeom geom;
    geom.kind = primitive->name;
    geom.pose = pose_of(json, "primitive_poses", i, path);
    geom.shape = primitive->make(*d);
    object.geoms.push_back(std::move(geom));
  }
}

void CollisionObjects::add_mesh(const Json& mesh, const JsonPath& path, const Affine<double>& pose,
                                PlannedObject& object) {
  check_fields(mesh, Message::mesh, path, mistakes_);
  MeshLibrary::Answer answer;
  if (const Json* resource = member_of(mesh, "resource")) {  // key of Robowflex
    Vec3<double> scale = Vec3<double>::Ones();
    if (const Json* size = member_of(mesh, "dimensions"))
      scale = read_message_vector(*size, path / "dimensions", mistakes_);
    const auto name = read_string(*resource, path / "resource", mistakes_);
    if (!name) return;
    answer = meshes_.parts_of(*name, scale);
  } else {
    MeshParts parts;
    const Json& vertices = list_of(mesh, "vertices", path, mistakes_);
    for (std::size_t i = 0; i < vertices.size(); ++i)
      parts.vertices.push_back(read_message_vector(vertices[i], path / "vertices" / i, mistakes_));
    const Json& triangles = list_of(mesh, "triangles", path, mistakes_);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const JsonPath at = path / "triangles" / i / "vertex_indices";
      const Json* indices = member_of(triangles[i], "vertex_indices");
      const auto corners =
          read_numbers(indices ? *indices : triangles[i], at, mistakes_, 3, Range::not_negative);
      if (!corners) continue;
      std::array<std::uint32_t, 3> triangle = {};
      for (std::size_t k = 0; k < 3; ++k) {
        const double index = (*corners)[k];
        if (index != std::floor(index) || index >= double(parts.vertices.size()))
          mistakes_.add(at / k, "must be the number of a vertex, below " +
                                    std::to_string(parts.vertices.size()));
        else
          triangle[k] = static_cast<std::uint32_t>(index);
      }
      parts.triangles.push_back(triangle);
    }
    if (parts.vertices.empty()) return mistakes_.add(path / "vertices", "must not be empty");
    if (triangles.empty()) return mistakes_.add(path / "triangles", "must not be empty");
    answer = meshes_.made_of(parts, Vec3<double>::Ones(), "mesh of " + object.id);
  }
  if (!answer.complaint.empty()) return mistakes_.add(path, answer.complaint);
  Model all;
  ModelGeom geom;
  geom.kind = "mesh";
  geom.pose = pose;
  if (const auto wrong = add_parts(all, answer, geom)) return mistakes_.add(path, *wrong);
  for (ModelGeom& one : all.geoms) object.geoms.push_back(std::move(one));
}

void CollisionObjects::add_meshes(const Json& json, const JsonPath& path, PlannedObject& object) {
  const Json& list = list_of(json, "meshes", path, mistakes_);
  for (std::size_t i = 0; i < list.size(); ++i)
    add_mesh(list[i], path / "meshes" / i, pose_of(json, "mesh_poses", i, path), object);
}

void CollisionObjects::add_planes(const Json& json, const JsonPath& path, PlannedObject& object) {
  const Json& list = list_of(json, "planes", path, mistakes_);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const JsonPath at = path / "planes" / i / "coef";
    const Json* coef = member_of(list[i], "coef");
    const auto c = read_numbers(coef ? *coef : list[i], at, mistakes_, 4);
    if (!c) continue;
    const Vec3<double> normal((*c)[0], (*c)[1], (*c)[2]);
    const double length = normal.norm();
    if (!(length > 0)) {
      mistakes_.add(at, "must have a normal: not 0, 0, 0");
      continue;
    }
    // The side opposite to the normal is solid: below z = 0 of the geom.
    ModelGeom geom;
    geom.kind = "plane";
    geom.pose = pose_of(json, "plane_poses", i, path) *
                Affine<double>{rotation_of_z_to(normal), -(*c)[3] / (length * length) * normal};
    object.geoms.push_back(std::move(geom));
  }
}

void CollisionObjects::add(const Json& json, const JsonPath& path,
                           std::vector<PlannedObject>& objects) {
  PlannedObject object;
  check_fields(json, Message::collision_object, path, mistakes_);
  if (!json.is_object()) return;
  object.id = text_of(json, "id", path, mistakes_);
  if (object.id.empty()) mistakes_.add(path / "id", "missing: must be the object's name");
  if (const Json* header = member_of(json, "header")) {
    check_fields(*header, Message::header, path / "header", mistakes_);
    object.frame = text_of(*header, "frame_id", path / "header", mistakes_);
  }
  Operation operation = Operation::add;
  if (const Json* number = member_of(json, "operation")) {
    const std::vector<std::string> names = {"add", "remove", "append", "move"};
    const std::string text = number->is_string() ? number->text() : "";
    const auto named = std::ranges::find(names, text);
    if (named != names.end())
      operation = static_cast<Operation>(named - names.begin());
    else if (const auto value = read_integer(*number, path / "operation", mistakes_, 0, 3))
      operation = static_cast<Operation>(*value);
  }
  check_poses(json, "primitives", "primitive_poses", path);
  check_poses(json, "meshes", "mesh_poses", path);
  check_poses(json, "planes", "plane_poses", path);
  add_primitives(json, path, object);
  add_meshes(json, path, object);
  add_planes(json, path, object);
  if (const Json* pose = member_of(json, "pose")) {
    const Affine<double> of_object = read_message_pose(*pose, path / "pose", mistakes_);
    for (ModelGeom& geom : object.geoms) geom.pose = of_object * geom.pose;
  }
  const auto known = std::ranges::find(objects, object.id, &PlannedObject::id);
  switch (operation) {
    case Operation::remove:
      if (known != objects.end()) objects.erase(known);
      return;
    case Operation::move:
      return mistakes_.add(path / "operation",
                           "must not be 3 (move): give the object with its pose (add)");
    case Operation::append:
      if (known != objects.end()) {
        if (known->frame != object.frame)
          mistakes_.add(path / "header" / "frame_id",
                        "must be the frame of the existing object to which this one is appended");
        for (ModelGeom& geom : object.geoms) known->geoms.push_back(std::move(geom));
        return;
      }
      break;
    case Operation::add:
      break;
  }
  if (object.geoms.empty() && mistakes_.none())
    mistakes_.add(path, "must have primitives, meshes or planes");
  if (known != objects.end())
    mistakes_.add(path / "id", "duplicate: \"" + printable(object.id, 60) + "\"");
  objects.push_back(std::move(object));
}

void CollisionObjects::add_attached(const Json& state, const JsonPath& path,
                                    std::vector<PlannedObject>& objects) {
  const Json& list = list_of(state, "attached_collision_objects", path, mistakes_);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const JsonPath at = path / "attached_collision_objects" / i;
    check_fields(list[i], Message::attached_object, at, mistakes_);
    const Json* inner = member_of(list[i], "object");
    if (!inner) {
      mistakes_.add(at / "object", "missing: must be a collision object");
      continue;
    }
    const std::size_t before = objects.size();
    add(*inner, at / "object", objects);
    if (objects.size() != before + 1) continue;
    PlannedObject& object = objects.back();
    const std::string link = text_of(list[i], "link_name", at, mistakes_);
    if (link.empty()) mistakes_.add(at / "link_name", "missing: must be a link of the robot");
    object.carrier = link;
    if (object.frame.empty()) object.frame = link;
    if (const Json* links = member_of(list[i], "touch_links"))
      for (std::string& name : read_name_list(*links, at / "touch_links", mistakes_))
        object.touch_links.insert(std::move(name));
    object.touch_links.insert(link);
  }
}

}  // namespace minkray
