// SPDX-License-Identifier: MIT
#include "renderer/import/mesh/geometry_common.h"

#include <algorithm>

namespace minkray {

std::string counted_numbers(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " number" : " numbers");
}

namespace {

/// Along z.
Shape segment_of(double half_length) {
  if (half_length == 0) return Point();
  return Segment{{Vec3<double>(0, 0, -half_length), Vec3<double>(0, 0, half_length)}};
}

}  // namespace

Shape box_of(const Vec3<double>& half_extents) {
  return Box{half_extents};
}

Shape sphere_of(double radius) {
  if (radius == 0) return Point();
  Sphere sphere;
  sphere.radius = radius;
  return sphere;
}

Shape cylinder_of(double radius, double half_height) {
  if (radius == 0) return segment_of(half_height);
  return Cylinder{radius, half_height};
}

Shape capsule_of(double radius, double half_height) {
  if (radius == 0) return segment_of(half_height);
  if (half_height == 0) return sphere_of(radius);
  return Capsule{radius, half_height};
}

Shape cone_of(double radius, double half_height) {
  if (radius == 0) return segment_of(half_height);
  return Cone{radius, half_height};
}

Shape ellipsoid_of(const Vec3<double>& radii) {
  if ((radii.array() > 0).all()) return Ellipsoid{radii};
  // A flat ellipsoid is a disk or a segment along z, turned.
  int flat = 0, longest = 0;
  for (int i = 1; i < 3; ++i) {
    if (radii[i] < radii[flat]) flat = i;
    if (radii[i] > radii[longest]) longest = i;
  }
  const int along = (flat + 1) % 3, across = (flat + 2) % 3;
  Affine<double> turn;
  if (radii[along] > 0 && radii[across] > 0) {
    turn.linear.col(0) = radii[along] * Vec3<double>::Unit(along);
    turn.linear.col(1) = radii[across] * Vec3<double>::Unit(across);
    turn.linear.col(2) = Vec3<double>::Unit(flat);
    return Transform{Shape(Disk{1}), turn};
  }
  if (radii[longest] == 0) return Point();
  return Segment{{-radii[longest] * Vec3<double>::Unit(longest),
                  radii[longest] * Vec3<double>::Unit(longest)}};
}

void make_plane(ModelGeom& geom, double half_x, double half_y) {
  geom.kind = "plane";
  if (!(half_x > 0) && !(half_y > 0)) return;
  constexpr double endless = 0x1p20;  // metres
  const double x = half_x > 0 ? half_x : endless, y = half_y > 0 ? half_y : endless;
  geom.mesh = std::make_shared<const TriangleMesh>(
      std::vector<Vec3<double>>{{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}},
      std::vector<Corners>{{0, 1, 2}, {0, 2, 3}}, MeshSides::front);
  geom.touches = Touch::as_half_space;
}

double ShapeNumbers::size(std::string_view key) {
  if (!element_.attribute(key)) {
    files_.wrong(element_, std::string(key) + ": missing");
    all_good_ = false;
    return 1;
  }
  const auto value = files_.number(element_, key);
  if (value && *value >= 0) return *value;
  if (value)
    files_.wrong(element_, std::string(key) + ": must be >= 0 (got " +
                               printable(*element_.attribute(key), 40) + ")");
  all_good_ = false;
  return 1;
}

Vec3<double> ShapeNumbers::sizes(std::string_view key) {
  if (!element_.attribute(key)) {
    files_.wrong(element_, std::string(key) + ": missing");
    all_good_ = false;
    return Vec3<double>::Ones();
  }
  const auto value = files_.vector(element_, key);
  if (value && (value->array() >= 0).all()) return *value;
  if (value)
    files_.wrong(element_, std::string(key) + ": must be three numbers >= 0 (got " +
                               printable(*element_.attribute(key), 40) + ")");
  all_good_ = false;
  return Vec3<double>::Ones();
}

void read_shapes(Model& model, XmlFiles& files, const ImportOptions& options,
                 const std::function<void()>& read) {
  if (!options.lenient) return read();
  const std::size_t before = model.geoms.size();
  const std::vector<std::string> complaints = files.complaints_of(read);
  if (complaints.empty()) return;
  model.geoms.resize(before);
  const std::string& first = complaints.front();
  const std::size_t end = first.find(": ");
  model.pass_over(first.substr(0, end), first.substr(end + 2));
}

void tell_missing_meshes(Model& model, XmlFiles& files, const ImportOptions& options) {
  std::vector<XmlFiles::MissingMesh> missing = files.take_missing_meshes();
  const bool any_is_seen = std::ranges::any_of(model.geoms, &ModelGeom::is_seen) ||
                           std::ranges::any_of(missing, &XmlFiles::MissingMesh::is_seen);
  std::erase_if(missing, [&](const XmlFiles::MissingMesh& mesh) {
    const bool is_asked = options.geometry == GeometryChoice::all ? true
                          : options.geometry == GeometryChoice::collision
                              ? mesh.collides
                              : mesh.is_seen || !any_is_seen;
    if (!is_asked) model.pass_over("<mesh>", "file missing (not needed with this --geometry)");
    return !is_asked;
  });
  if (missing.empty()) return;
  if (options.verbose || missing.size() == 1)
    for (const XmlFiles::MissingMesh& mesh : missing) files.wrong(mesh.element, mesh.complaint);
  else
    files.wrong(missing.front().element, missing.front().complaint + "; " +
                                             std::to_string(missing.size() - 1) +
                                             " other meshes not found (--verbose lists them)");
  files.mistakes().add("missing meshes: " + std::to_string(missing.size()) +
                       "; set --package-dir, or use --skip-missing-meshes");
}

void add_mesh(Model& model, XmlFiles& files, const XmlElement& element,
              const MeshLibrary::Answer& answer, ModelGeom geom, const ImportOptions& options,
              Colouring colouring) {
  if (answer.is_missing && options.skip_missing_meshes) {
    model.pass_over("<mesh>", "its file is missing");
    return;
  }
  if (answer.is_missing)
    return files.missing_mesh({element, answer.complaint, geom.is_seen, geom.collides});
  if (!answer.complaint.empty()) return files.wrong(element, answer.complaint);
  for (const std::string& note : answer.notes) model.pass_over("<mesh>", note);
  if (answer.is_flattened)
    model.pass_over("extent of a <mesh>", "ignored in directions in which the scale is zero");
  if (const auto complaint = add_parts(model, answer, std::move(geom), colouring))
    files.wrong(element, *complaint);
}

std::optional<std::string> add_parts(Model& model, const MeshLibrary::Answer& answer,
                                     ModelGeom geom, Colouring colouring) {
  const std::size_t count = model.geoms.size() + answer.parts.size();
  if (count > most_geoms)
    return "shows " + std::to_string(answer.parts.size()) + " parts: with the shapes before, a " +
           "model must have at most " + std::to_string(most_geoms) + " shapes (got " +
           std::to_string(count) + ")";
  geom.kind = "mesh";
  const std::string name = geom.name;
  for (std::size_t i = 0; i < answer.parts.size(); ++i) {
    const MeshLibrary::Part& part = answer.parts[i];
    geom.shape = part.hull;
    geom.mesh = part.surface;
    geom.attributes = part.attributes;
    if (colouring == Colouring::of_mesh) geom.materials = answer.materials;
    if (colouring == Colouring::of_mesh && part.colour) geom.rgba = *part.colour;
    if (answer.parts.size() > 1) geom.name = name + "[" + std::to_string(i) + "]";
    model.geoms.push_back(geom);
  }
  return std::nullopt;
}

}  // namespace minkray
