// SPDX-License-Identifier: MIT
#include "renderer/import/sdf/sdf_geometry.h"

#include <algorithm>

#include "core/mesh/height_field.h"
#include "renderer/base/of_file.h"
#include "renderer/import/mesh/geometry_common.h"
#include "renderer/import/model/orientation.h"
#include "renderer/import/model/prism.h"
#include "renderer/import/sdf/sdf_frames.h"
#include "renderer/io/height_grid.h"

namespace minkray {

void SdfGeometry::add(const XmlElement& element, int link, const Affine<double>& pose) {
  read_shapes(model_, files_, options_, [&] { read(element, link, pose); });
}

void SdfGeometry::read(const XmlElement& element, int link, const Affine<double>& pose) {
  ModelGeom geom;
  geom.link = link;
  geom.name = element.attribute_or("name");
  if (!geom.name.empty())
    geom.name = model_.links[static_cast<std::size_t>(link)].name + "::" + geom.name;
  geom.is_seen = element.name == "visual";
  geom.collides = !geom.is_seen;
  geom.pose = pose;
  Colouring colouring = Colouring::of_mesh;
  if (const XmlElement* material = element.child("material"))
    if (const XmlElement* diffuse = material->child("diffuse"))
      if (const auto v = files_.numbers_in(*diffuse, diffuse->text, "diffuse", 3, 4)) {
        geom.rgba = {(*v)[0], (*v)[1], (*v)[2], v->size() > 3 ? (*v)[3] : 1};
        colouring = Colouring::of_robot;
      }
  const XmlElement* geometry = element.child("geometry");
  if (!geometry || geometry->children.empty())
    return model_.pass_over("<" + element.name + ">", "has no geometry");
  for (const XmlElement& shape : geometry->children)
    if (shape.name != "polyline") add_shape(shape, geom, colouring);
  if (geometry->child("polyline")) add_polylines(*geometry, geom);
}

/// All outlines of a geometry are of one body: those within others are its holes.
void SdfGeometry::add_polylines(const XmlElement& geometry, ModelGeom geom) {
  std::vector<Outline> outlines;
  const XmlElement& first = *geometry.child("polyline");
  double height = 1;
  for (const XmlElement& polyline : geometry.children) {
    if (polyline.name != "polyline") continue;
    Outline& outline = outlines.emplace_back();
    for (const XmlElement& child : polyline.children) {
      if (child.name == "point") {
        const auto v = files_.numbers_in(child, child.text, "point", 2, 2);
        if (!v) return;
        outline.push_back({(*v)[0], (*v)[1]});
      } else if (child.name == "height" && &polyline == &first) {
        const auto v = files_.numbers_in(child, child.text, "height", 1, 1);
        if (!v) return;
        height = (*v)[0];
      }
    }
  }
  if (!(height >= 0))
    return files_.wrong(first, "height: must be >= 0 (got " + std::to_string(height) + ")");
  geom.kind = "polyline";
  try {
    const std::vector<Shape> prisms = prisms_of(outlines, height);
    for (std::size_t i = 0; i < prisms.size(); ++i) {
      ModelGeom one = geom;
      if (prisms.size() > 1 && !geom.name.empty())
        one.name = geom.name + "[" + std::to_string(i) + "]";
      one.shape = prisms[i];
      model_.geoms.push_back(std::move(one));
    }
  } catch (const std::runtime_error& error) {
    files_.wrong(first, error.what());
  }
}

/// The sizes are elements of their own.
void SdfGeometry::add_shape(const XmlElement& shape, ModelGeom geom, Colouring colouring) {
  geom.kind = shape.name;
  bool is_good = true;
  const auto numbers = [&](const char* key, std::size_t count) {
    const XmlElement* child = shape.child(key);
    std::optional<std::vector<double>> v;
    if (!child)
      files_.wrong(shape, std::string(key) + ": missing");
    else
      v = files_.numbers_in(*child, child->text, key, count, count);
    if (v && std::ranges::any_of(*v, [](double x) { return !(x >= 0); })) {
      files_.wrong(*child, "must be >= 0 (got \"" + printable(child->text, 60) + "\")");
      v.reset();
    }
    is_good &= v.has_value();
    return v.value_or(std::vector<double>(count, 1));
  };
  const auto one = [&](const char* key) { return numbers(key, 1)[0]; };
  if (shape.name == "box") {
    const auto s = numbers("size", 3);
    geom.shape = box_of({s[0] / 2, s[1] / 2, s[2] / 2});
  } else if (shape.name == "sphere") {
    geom.shape = sphere_of(one("radius"));
  } else if (shape.name == "cylinder") {
    const double radius = one("radius");
    geom.shape = cylinder_of(radius, one("length") / 2);
  } else if (shape.name == "capsule") {
    const double radius = one("radius");
    geom.shape = capsule_of(radius, one("length") / 2);
  } else if (shape.name == "cone") {
    const double radius = one("radius");
    geom.shape = cone_of(radius, one("length") / 2);
  } else if (shape.name == "ellipsoid") {
    // Drake's has three elements.
    const auto r =
        shape.child("a") ? std::vector{one("a"), one("b"), one("c")} : numbers("radii", 3);
    geom.shape = ellipsoid_of({r[0], r[1], r[2]});
  } else if (shape.name == "plane") {
    Vec3<double> normal(0, 0, 1);
    if (const XmlElement* child = shape.child("normal"))
      if (const auto v = files_.numbers_in(*child, child->text, "normal", 3, 3))
        normal = {(*v)[0], (*v)[1], (*v)[2]};
    if (unit(normal).isZero(0)) return files_.wrong(shape, "normal: must not be zero");
    geom.pose.linear = geom.pose.linear * rotation_of_z_to(normal);
    // A collision plane is unbounded.
    if (shape.child("size") && !geom.collides) {
      const auto size = numbers("size", 2);
      make_plane(geom, size[0] / 2, size[1] / 2);
    }
  } else if (shape.name == "mesh") {
    const std::string uri = sdf_text(shape, "uri");
    if (uri.empty()) return files_.wrong(shape, "uri: missing");
    Vec3<double> scale = Vec3<double>::Ones();
    if (const XmlElement* child = shape.child("scale"))
      if (const auto v = files_.numbers_in(*child, child->text, "scale", 3, 3))
        scale = {(*v)[0], (*v)[1], (*v)[2]};
    Submesh submesh;
    if (const XmlElement* child = shape.child("submesh")) {
      submesh.name = sdf_text(*child, "name");
      const std::string centre = sdf_text(*child, "center");
      submesh.is_centred = centre == "true" || centre == "1";
    }
    return add_mesh(model_, files_, shape, library_of(shape).parts_of(uri, scale, submesh),
                    std::move(geom), options_, colouring);
  } else if (shape.name == "empty") {
    return;
  } else if (shape.name == "heightmap") {
    return add_height_map(shape, std::move(geom));
  } else if (shape.name == "image") {
    return model_.pass_over("<" + shape.name + ">", "not a convex shape");
  } else {
    return files_.wrong(shape, "not a geometry of SDF");
  }
  if (is_good) model_.geoms.push_back(std::move(geom));
}

/// The lightest pixel is the size's z above black, and the first row of the picture has the
/// greatest y.
void SdfGeometry::add_height_map(const XmlElement& shape, ModelGeom geom) {
  const std::string uri = sdf_text(shape, "uri");
  if (uri.empty()) return files_.wrong(shape, "uri: missing");
  const auto three = [&](const char* key, const Vec3<double>& otherwise) {
    const XmlElement* child = shape.child(key);
    if (!child) return std::optional(otherwise);
    const auto v = files_.numbers_in(*child, child->text, key, 3, 3);
    return v ? std::optional(Vec3<double>((*v)[0], (*v)[1], (*v)[2])) : std::nullopt;
  };
  const auto size = three("size", {1, 1, 1}), at = three("pos", {0, 0, 0});
  if (!size || !at) return;
  const auto file = library_of(shape).find_also_in(uri, {});
  if (!file) {
    if (options_.skip_missing_meshes) return model_.pass_over("<heightmap>", "its file is missing");
    return files_.wrong(shape, "uri: \"" + printable(uri, 100) + "\" not found");
  }
  try {
    HeightGrid grid = read_height_picture(*file);
    // As in Gazebo, the lightest pixel has the size's height.
    const double lightest = std::ranges::max(grid.heights);
    for (double& height : grid.heights) height *= size->z() / (lightest > 0 ? lightest : 1);
    geom.mesh = mesh_of({grid.heights, grid.rows, grid.columns, size->x(), size->y(), {}});
  } catch (const std::exception& error) {
    return files_.wrong(shape, printable(file->string(), 160) + ": " + what_of(error));
  }
  geom.pose = geom.pose * Affine<double>{Mat3<double>::Identity(), *at};
  model_.geoms.push_back(std::move(geom));
}

/// Each file searches for meshes next to itself; a world may include one file a thousand times.
/// All of them share one list of meshes' facts.
MeshLibrary& SdfGeometry::library_of(const XmlElement& element) {
  const std::filesystem::path folder = files_.files()[element.file].parent_path();
  const std::uint32_t first = first_in_folder_.try_emplace(folder, element.file).first->second;
  auto& library = libraries_[first];
  if (!library) library = std::make_unique<MeshLibrary>(folder, options_);
  return *library;
}

void SdfGeometry::hand_over_meshes() {
  for (const auto& [file, library] : libraries_) library->hand_over(model_);
}

}  // namespace minkray
