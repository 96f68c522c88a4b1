// SPDX-License-Identifier: MIT
#include "renderer/import/geometry_common.h"

namespace minkray {

std::string counted_numbers(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " number" : " numbers");
}

Shape<double> box_of(const Vec3<double>& half_extents) {
  return Box<double>{half_extents};
}

Shape<double> sphere_of(double radius) {
  Sphere<double> sphere;
  sphere.radius = radius;
  return sphere;
}

Shape<double> cylinder_of(double radius, double half_height) {
  return Cylinder<double>{radius, half_height};
}

Shape<double> capsule_of(double radius, double half_height) {
  if (half_height == 0) return sphere_of(radius);
  return Capsule<double>{radius, half_height};
}

Shape<double> ellipsoid_of(const Vec3<double>& radii) {
  return Ellipsoid<double>{radii};
}

double ShapeNumbers::positive(std::string_view key) {
  if (!element_.attribute(key)) {
    files_.wrong(element_, std::string(key) + ": must be there");
    all_good_ = false;
    return 1;
  }
  const auto value = files_.number(element_, key);
  if (value && *value > 0) return *value;
  if (value)
    files_.wrong(element_, std::string(key) + ": must be > 0 (got " +
                               printable(*element_.attribute(key), 40) + ")");
  all_good_ = false;
  return 1;
}

Vec3<double> ShapeNumbers::positive_vector(std::string_view key) {
  if (!element_.attribute(key)) {
    files_.wrong(element_, std::string(key) + ": must be there");
    all_good_ = false;
    return Vec3<double>::Ones();
  }
  const auto value = files_.vector(element_, key);
  if (value && (value->array() > 0).all()) return *value;
  if (value)
    files_.wrong(element_, std::string(key) + ": must be three numbers > 0 (got " +
                               printable(*element_.attribute(key), 40) + ")");
  all_good_ = false;
  return Vec3<double>::Ones();
}

void add_mesh(Model& model, XmlFiles& files, const XmlElement& element,
              const MeshLibrary::Answer& answer, ModelGeom geom, const ImportOptions& options) {
  if (answer.is_missing && options.skip_missing_meshes) {
    model.pass_over("<mesh>", "its file is missing");
    return;
  }
  if (!answer.complaint.empty()) return files.wrong(element, answer.complaint);
  if (const auto complaint = add_hulls(model, answer, std::move(geom)))
    files.wrong(element, *complaint);
}

std::optional<std::string> add_hulls(Model& model, const MeshLibrary::Answer& answer,
                                     ModelGeom geom) {
  const std::size_t count = model.geoms.size() + answer.hulls.size();
  if (count > most_geoms)
    return "shows " + std::to_string(answer.hulls.size()) + " hulls: with the shapes before, a " +
           "model must have at most " + std::to_string(most_geoms) + " shapes (got " +
           std::to_string(count) + ")";
  geom.kind = "mesh";
  const std::string name = geom.name;
  for (std::size_t i = 0; i < answer.hulls.size(); ++i) {
    geom.shape = answer.hulls[i];
    if (answer.hulls.size() > 1) geom.name = name + "[" + std::to_string(i) + "]";
    model.geoms.push_back(geom);
  }
  return std::nullopt;
}

}  // namespace minkray
