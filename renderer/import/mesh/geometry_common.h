// SPDX-License-Identifier: MIT
// Geometry shared by the formats: meshes, and sizes, where zero makes points, segments and disks.
#pragma once

#include <functional>

#include "renderer/import/mesh/mesh_library.h"
#include "renderer/import/model/import_options.h"
#include "renderer/import/model/model.h"
#include "renderer/import/model/xml.h"

namespace minkray {

/// "1 number", "2 numbers".
std::string counted_numbers(std::size_t count);

Shape box_of(const Vec3<double>& half_extents);
Shape sphere_of(double radius);
Shape cylinder_of(double radius, double half_height);
Shape capsule_of(double radius, double half_height);
/// The apex is at z = +half_height.
Shape cone_of(double radius, double half_height);
Shape ellipsoid_of(const Vec3<double>& radii);

/// The geom is a plane z = 0 that ends at these half sizes for rays, which meet it from above, and
/// has no end for contact. 0: it has no end that way; if both are 0 not for rays either.
void make_plane(ModelGeom& geom, double half_x, double half_y);

/// Reads the sizes of one shape from its attributes; reports missing and wrong ones.
class ShapeNumbers {
 public:
  ShapeNumbers(XmlFiles& files, const XmlElement& element) : files_(files), element_(element) {}

  /// At least 0; 1 where it is wrong.
  double size(std::string_view key);
  Vec3<double> sizes(std::string_view key);
  bool has(std::string_view key) const { return element_.attribute(key) != nullptr; }
  bool all_good() const { return all_good_; }

 private:
  XmlFiles& files_;
  const XmlElement& element_;
  bool all_good_ = true;
};

/// Runs `read`, which adds shapes of an element to the model. With --lenient what is wrong with
/// them leaves them out, and is listed with what is passed over.
void read_shapes(Model& model, XmlFiles& files, const ImportOptions& options,
                 const std::function<void()>& read);

/// Adds one mistake for all required meshes that are missing, or one for each with --verbose.
void tell_missing_meshes(Model& model, XmlFiles& files, const ImportOptions& options);

/// Source of a mesh's colour: the robot's file, or the mesh's own file if that has one.
enum class Colouring : unsigned char { of_robot, of_mesh };

/// Adds a mesh's parts as geoms like the one given. If the model would have more than most_geoms
/// then, it adds none and answers with what is wrong.
[[nodiscard]] std::optional<std::string> add_parts(Model& model, const MeshLibrary::Answer& answer,
                                                   ModelGeom geom,
                                                   Colouring colouring = Colouring::of_robot);

/// Adds a mesh's parts as geoms like the one given; reports a mistake in the mesh, or skips a
/// missing mesh if that is allowed.
void add_mesh(Model& model, XmlFiles& files, const XmlElement& element,
              const MeshLibrary::Answer& answer, ModelGeom geom, const ImportOptions& options,
              Colouring colouring = Colouring::of_robot);

}  // namespace minkray
