// SPDX-License-Identifier: MIT
#include "renderer/import/sdf_geometry.h"

#include <algorithm>

#include "renderer/import/geometry_common.h"
#include "renderer/import/orientation.h"
#include "renderer/import/sdf_frames.h"

namespace minkray {

void SdfGeometry::add(const XmlElement& element, int link, const Affine<double>& pose) {
  ModelGeom geom;
  geom.link = link;
  geom.name = element.attribute_or("name");
  if (!geom.name.empty())
    geom.name = model_.links[static_cast<std::size_t>(link)].name + "::" + geom.name;
  geom.is_seen = element.name == "visual";
  geom.collides = !geom.is_seen;
  geom.pose = pose;
  if (const XmlElement* material = element.child("material"))
    if (const XmlElement* diffuse = material->child("diffuse"))
      if (const auto v = files_.numbers_in(*diffuse, diffuse->text, "diffuse", 3, 4))
        geom.rgba = {(*v)[0], (*v)[1], (*v)[2], v->size() > 3 ? (*v)[3] : 1};
  const XmlElement* geometry = element.child("geometry");
  if (!geometry) return files_.wrong(element, "geometry: must be there");
  for (const XmlElement& shape : geometry->children) add_shape(shape, geom);
}

/// The sizes are elements of their own.
void SdfGeometry::add_shape(const XmlElement& shape, ModelGeom geom) {
  geom.kind = shape.name;
  bool is_good = true;
  const auto numbers = [&](const char* key, std::size_t count) {
    const XmlElement* child = shape.child(key);
    std::optional<std::vector<double>> v;
    if (!child)
      files_.wrong(shape, std::string(key) + ": must be there");
    else
      v = files_.numbers_in(*child, child->text, key, count, count);
    if (v && std::ranges::any_of(*v, [](double x) { return !(x > 0); })) {
      files_.wrong(*child, "must be > 0 (got \"" + printable(child->text, 60) + "\")");
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
  } else if (shape.name == "ellipsoid") {
    const auto r = numbers("radii", 3);
    geom.shape = ellipsoid_of({r[0], r[1], r[2]});
  } else if (shape.name == "plane") {
    Vec3<double> normal(0, 0, 1);
    if (const XmlElement* child = shape.child("normal"))
      if (const auto v = files_.numbers_in(*child, child->text, "normal", 3, 3))
        normal = {(*v)[0], (*v)[1], (*v)[2]};
    if (unit(normal).isZero(0)) return files_.wrong(shape, "normal: must not be zero");
    geom.pose.linear = geom.pose.linear * rotation_of_z_to(normal);
  } else if (shape.name == "mesh") {
    const std::string uri = sdf_text(shape, "uri");
    if (uri.empty()) return files_.wrong(shape, "uri: must be there");
    Vec3<double> scale = Vec3<double>::Ones();
    if (const XmlElement* child = shape.child("scale"))
      if (const auto v = files_.numbers_in(*child, child->text, "scale", 3, 3))
        scale = {(*v)[0], (*v)[1], (*v)[2]};
    if (shape.child("submesh"))
      model_.pass_over("<submesh>",
                       "the hull is that of the whole mesh (--split tells parts apart)");
    return add_mesh(model_, files_, shape, library_of(shape).hulls_of(uri, scale), std::move(geom),
                    options_);
  } else if (shape.name == "empty") {
    return;
  } else if (shape.name == "heightmap" || shape.name == "image" || shape.name == "polyline") {
    return model_.pass_over("<" + shape.name + ">", "is no convex shape");
  } else {
    return files_.wrong(shape, "is no geometry of SDF");
  }
  if (is_good) model_.geoms.push_back(std::move(geom));
}

/// Each file looks for meshes beside itself; a world may include one file a thousand times. All of
/// them share one list of meshes' facts.
MeshLibrary& SdfGeometry::library_of(const XmlElement& element) {
  const std::filesystem::path folder = files_.files()[element.file].parent_path();
  const std::uint32_t first = first_in_folder_.try_emplace(folder, element.file).first->second;
  auto& library = libraries_[first];
  if (!library) library = std::make_unique<MeshLibrary>(folder, options_);
  return *library;
}

void SdfGeometry::hand_over_meshes() {
  for (const auto& [file, library] : libraries_) {
    model_.hash += library->hash_text();
    for (ModelMesh& mesh : library->take_meshes()) model_.meshes.push_back(std::move(mesh));
  }
}

}  // namespace minkray
