// SPDX-License-Identifier: MIT
// Meshes that a robot's file names: finds them, reads each once, and makes bodies of them. Only
// mesh_formats lists the formats.
#pragma once

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/shape/shape.h"
#include "renderer/import/mesh/mesh_places.h"
#include "renderer/import/model/import_options.h"
#include "renderer/import/model/mesh_looks.h"
#include "renderer/import/model/mesh_pictures.h"
#include "renderer/import/model/model.h"

namespace minkray {

/// Contents of a mesh file.
struct MeshContent {
  MeshParts mesh;
  MeshLooks looks = {};  ///< of its parts, if it is split into groups, or of it as a whole
  std::vector<MeshMaterial> materials = {};  ///< by the numbers of the mesh's attributes
};

/// A part of a mesh file that is shown alone, its middle at the origin if requested (SDF).
struct Submesh {
  std::string name = {};  ///< empty: the whole mesh
  bool is_centred = false;
};

/// A reader throws std::runtime_error with the mistake, without the file's name.
struct MeshFormatReader {
  std::string_view ending;
  MeshContent (*read)(const std::filesystem::path& file, MeshSplit split, MeshDetail detail);
};
const std::vector<MeshFormatReader>& mesh_formats();

/// Limit of vertices that a file of meshes with this many numbers may show: instances could make
/// endless vertices of few bytes, and Qhull takes up to 50 us for each of them.
constexpr std::size_t most_shown_vertices(std::size_t numbers) {
  return std::max<std::size_t>(200'000, 8 * numbers);
}

class MeshLibrary {
 public:
  /// `folder`: that of the file that names the meshes.
  MeshLibrary(std::filesystem::path folder, const ImportOptions& options)
      : places_(std::move(folder), options), options_(&options) {}

  /// A surface, or a hull where surfaces are not requested or there are no triangles.
  struct Part {
    std::shared_ptr<const TriangleMesh> surface = {};
    std::optional<Shape> hull = {};
    std::optional<Rgba> colour = {};                        ///< if the file has one
    std::shared_ptr<const MeshAttributes> attributes = {};  ///< of the surface, if it has any
  };
  using Materials = std::shared_ptr<const std::vector<MeshMaterial>>;
  struct Answer {
    std::vector<Part> parts;
    Materials materials = {};             ///< by the numbers of the parts' attributes
    std::vector<std::string> notes = {};  ///< contents of the file that are not shown
    std::string complaint;                ///< description of the mistake; empty if there is none
    bool is_missing = false;
    bool is_flattened = false;  ///< by a scale of zero
  };
  /// The parts of a mesh file, its vertices scaled. Names may be paths, or begin with package://,
  /// model:// or file://. `also_in` are folders where it may lie as well.
  const Answer& parts_of(const std::string& uri, const Vec3<double>& scale,
                         const Submesh& submesh = {},
                         const std::vector<std::filesystem::path>& also_in = {});

  /// The vertices are in the file itself.
  Answer made_of(const MeshParts& mesh, const Vec3<double>& scale, const std::string& name);

  /// Reads the pictures of materials; what cannot be read is noted, and has the colour alone.
  Materials read_pictures(std::vector<MeshMaterial> materials, std::vector<std::string>& notes);

  /// The file that a name refers to, if there is one; `looked_for` gets all places.
  std::optional<std::filesystem::path> find(const std::string& uri,
                                            std::vector<std::filesystem::path>& looked_for) const {
    return places_.find(uri, looked_for);
  }

  /// Searches other folders as well. A file that is found is added to the model's files.
  std::optional<std::filesystem::path> find_also_in(
      const std::string& uri, const std::vector<std::filesystem::path>& also_in);

  /// Gives the model the meshes' facts, the names of their files and their hashes.
  void hand_over(Model& model);

 private:
  Answer add(const MeshParts& mesh, const Vec3<double>& scale, const std::string& name);

  MeshPlaces places_;
  const ImportOptions* options_;
  const MeshContent& read(const std::filesystem::path& file, const MeshFormatReader& format,
                          MeshSplit split);
  std::map<std::pair<std::string, MeshSplit>, MeshContent> read_;
  std::map<std::string, Answer> made_;
  MeshPictures pictures_;
  std::size_t read_vertices_ = 0;   ///< of files
  std::size_t shown_vertices_ = 0;  ///< of files, again for each scale
  std::vector<ModelMesh> meshes_;
  std::vector<std::filesystem::path> files_;
  std::string hash_text_;
};

}  // namespace minkray
