// SPDX-License-Identifier: MIT
// Shapes of SDF: the contents of <visual> and <collision>.
#pragma once

#include <cstdint>
#include <map>
#include <memory>

#include "renderer/import/mesh/geometry_common.h"
#include "renderer/import/mesh/mesh_library.h"
#include "renderer/import/model/import_options.h"
#include "renderer/import/model/model.h"
#include "renderer/import/model/xml.h"

namespace minkray {

class SdfGeometry {
 public:
  SdfGeometry(Model& model, XmlFiles& files, const ImportOptions& options)
      : model_(model), files_(files), options_(options) {}

  /// Adds the shapes of a <visual> or <collision> to a link, at a pose in its frame.
  void add(const XmlElement& element, int link, const Affine<double>& pose);

  /// Gives the model the meshes that were read, and their hashes.
  void hand_over_meshes();

 private:
  void read(const XmlElement& element, int link, const Affine<double>& pose);
  void add_shape(const XmlElement& shape, ModelGeom geom, Colouring colouring);
  void add_polylines(const XmlElement& geometry, ModelGeom geom);
  void add_height_map(const XmlElement& shape, ModelGeom geom);
  MeshLibrary& library_of(const XmlElement& element);

  Model& model_;
  XmlFiles& files_;
  const ImportOptions& options_;
  std::map<std::filesystem::path, std::uint32_t> first_in_folder_;   ///< file
  std::map<std::uint32_t, std::unique_ptr<MeshLibrary>> libraries_;  ///< by it
};

}  // namespace minkray
