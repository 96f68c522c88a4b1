// SPDX-License-Identifier: MIT
// MJCF's <asset>: colours of materials, and meshes, by the names that geoms use.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "renderer/import/mesh/mesh_library.h"
#include "renderer/import/mjcf/mjcf_defaults.h"
#include "renderer/import/model/import_options.h"
#include "renderer/import/model/model.h"

namespace minkray {

class MjcfAssets {
 public:
  MjcfAssets(Model& model, XmlFiles& files, const ImportOptions& options)
      : model_(model),
        files_(files),
        options_(options),
        meshes_(std::filesystem::path(), options) {}

  /// Sets the search path of mesh files: a folder relative to the model's file, or to the file
  /// that names them; and if folders in their names are ignored.
  void look_in(const std::filesystem::path& file_folder, const std::filesystem::path& mesh_folder,
               bool strips_path);

  /// Reads an <asset>.
  void read(const XmlElement& assets, const MjcfDefaults& defaults);

  /// The geom's own colour, if it has one, or its material's.
  Rgba colour_of(const XmlElement& geom) const;
  /// Alpha of the geom's material if it has one, else the geom's own, as for mj_ray.
  double alpha_for_rays(const XmlElement& geom) const;

  /// Adds the terrain that a geom names; `e` is the geom with its defaults.
  void add_height_field(const XmlElement& written, const XmlElement& e, ModelGeom geom);

  /// Adds the parts of the mesh that a geom names; `e` is the geom with its defaults.
  void add_mesh_geom(const XmlElement& written, const XmlElement& e, ModelGeom geom);

  /// A primitive's sizes as MuJoCo fits them to the mesh that a geom names: by the box of the same
  /// inertia, or by the box around the mesh along its principal axes. The geom's pose gets that of
  /// the fitted primitive. Nothing, and a mistake, if there is no mesh to fit to.
  std::optional<std::vector<double>> fit(const XmlElement& written, const XmlElement& e,
                                         bool by_bounds, ModelGeom& geom);

  /// Models to attach, by name: files as they are written, with the element of each.
  const std::map<std::string, XmlElement>& models() const { return models_; }

  /// Gives the model the meshes that were read, and their hashes.
  void hand_over_meshes();

 private:
  std::optional<Rgba> read_rgba(const XmlElement& element) const;
  MeshLibrary::Answer parts_of(const std::string& name, const XmlElement& asset);
  /// File of an asset.
  std::string name_of_file(const XmlElement& asset) const;
  std::vector<std::filesystem::path> folders_of(const XmlElement& asset) const;
  /// The parts of the mesh that a geom names; null, and a mistake, if there is none.
  const MeshLibrary::Answer* mesh_of(const XmlElement& written, const XmlElement& e);

  Model& model_;
  XmlFiles& files_;
  const ImportOptions& options_;
  MeshLibrary meshes_;
  bool strips_path_ = false;
  std::map<std::string, XmlElement> mesh_assets_;    ///< with their defaults
  std::map<std::string, MeshLibrary::Answer> made_;  ///< of these, for each geom of one
  std::map<std::string, XmlElement> height_fields_;
  std::map<std::string, std::shared_ptr<const TriangleMesh>> terrains_;  ///< of these
  std::map<std::string, Rgba> materials_;
  std::map<std::string, XmlElement> models_;
  std::filesystem::path mesh_folder_;  ///< relative to a file
};

}  // namespace minkray
