// SPDX-License-Identifier: MIT
// MJCF's <asset>: the materials' colours and the meshes, which geoms name.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>

#include "renderer/import/import_options.h"
#include "renderer/import/mesh_library.h"
#include "renderer/import/mjcf_defaults.h"
#include "renderer/import/model.h"

namespace minkray {

class MjcfAssets {
 public:
  using Rgba = std::array<double, 4>;

  MjcfAssets(Model& model, XmlFiles& files, const ImportOptions& options)
      : model_(model),
        files_(files),
        options_(options),
        meshes_(std::filesystem::path(), options) {}

  /// Says where mesh files are, and that their own folders in the file count for nothing.
  void look_in(const std::filesystem::path& folder, bool strips_path);

  /// Reads an <asset>.
  void read(const XmlElement& assets, const MjcfDefaults& defaults);

  /// A geom has its own colour, if it says one, or its material's.
  Rgba colour_of(const XmlElement& geom) const;

  /// Adds the hulls of the mesh that a geom names; `e` is the geom with its defaults.
  void add_mesh_geom(const XmlElement& written, const XmlElement& e, ModelGeom geom);

  /// Gives the model the meshes that were read, and their hashes.
  void hand_over_meshes();

 private:
  std::optional<Rgba> read_rgba(const XmlElement& element) const;
  MeshLibrary::Answer hulls_of(const std::string& name, const XmlElement& asset);

  Model& model_;
  XmlFiles& files_;
  const ImportOptions& options_;
  MeshLibrary meshes_;
  bool strips_path_ = false;
  std::map<std::string, XmlElement> mesh_assets_;    ///< with their defaults
  std::map<std::string, MeshLibrary::Answer> made_;  ///< of these, for each geom of one
  std::map<std::string, Rgba> materials_;
};

}  // namespace minkray
