// SPDX-License-Identifier: MIT
// What the formats' shapes have in common: sizes that must be positive, meshes that become hulls.
#pragma once

#include "renderer/import/import_options.h"
#include "renderer/import/mesh_library.h"
#include "renderer/import/model.h"
#include "renderer/import/xml.h"

namespace minkray {

/// "1 number", "2 numbers".
std::string counted_numbers(std::size_t count);

Shape<double> box_of(const Vec3<double>& half_extents);
Shape<double> sphere_of(double radius);
Shape<double> cylinder_of(double radius, double half_height);
/// A half height of zero makes a sphere.
Shape<double> capsule_of(double radius, double half_height);
Shape<double> ellipsoid_of(const Vec3<double>& radii);

/// Reads the sizes of one shape from its attributes; what is missing or wrong is told.
class ShapeNumbers {
 public:
  ShapeNumbers(XmlFiles& files, const XmlElement& element) : files_(files), element_(element) {}

  /// 1 where it is wrong.
  double positive(std::string_view key);
  Vec3<double> positive_vector(std::string_view key);
  bool all_good() const { return all_good_; }

 private:
  XmlFiles& files_;
  const XmlElement& element_;
  bool all_good_ = true;
};

/// Adds a mesh's hulls as geoms like the one given. If the model would have more than most_geoms
/// then, it adds none and answers with what is wrong.
[[nodiscard]] std::optional<std::string> add_hulls(Model& model, const MeshLibrary::Answer& answer,
                                                   ModelGeom geom);

/// Adds a mesh's hulls as geoms like the one given; or tells what is wrong with it, or passes it
/// over if it is missing and that is allowed.
void add_mesh(Model& model, XmlFiles& files, const XmlElement& element,
              const MeshLibrary::Answer& answer, ModelGeom geom, const ImportOptions& options);

}  // namespace minkray
