// SPDX-License-Identifier: MIT
// The files of meshes and pictures that a scene or a query names, each read once.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/files/mesh_parts.h"
#include "core/geometry/point_cloud.h"
#include "core/mesh/triangle_mesh.h"
#include "renderer/base/hash.h"
#include "renderer/image/image.h"
#include "renderer/io/height_grid.h"
#include "renderer/json/json.h"
#include "renderer/json/mistakes.h"
#include "renderer/scene/named.h"

namespace minkray {

/// A material of a mesh file.
struct FileMaterial {
  std::string name;
  std::optional<std::array<double, 3>> colour = {};  ///< sRGB
  PictureFile picture = {};                          ///< instead of the colour, if it has one
};

/// A mesh as a scene names it.
struct SceneMesh {
  std::shared_ptr<const TriangleMesh> mesh = {};
  std::shared_ptr<const MeshAttributes> attributes = {};  ///< null: none
  std::string file = {};        ///< relative to the scene's folder; empty: none
  const Json* named = nullptr;  ///< names in the scene instead of these, if any
};

/// Source of a mesh's normals.
struct MeshShading {
  enum Kind : unsigned char { as_given, flat, smooth } kind = as_given;
  double crease = 0;  ///< of smooth ones: the largest angle that is smooth, in radians

  auto operator<=>(const MeshShading&) const = default;
};

/// "; fetch it with: scenes/fetch-meshes" if the file is missing and there is such a script, which
/// an installed Minkray has not.
std::string advice_on_mesh(const std::filesystem::path& folder, const std::filesystem::path& file);

class MeshFiles {
 public:
  /// File names are relative to `folder`: that of the scene or query file.
  explicit MeshFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Files that are named from now on are relative to this folder, which is relative to the
  /// scene's: that of an include.
  void set_folder_of_names(std::filesystem::path folder) { of_names_ = std::move(folder); }

  /// A file's name relative to the scene's folder.
  std::string from_scene(const std::string& name) const {
    return of_names_.empty() ? name : (of_names_ / name).string();
  }

  /// The vertices of a mesh file; nothing, and a mistake at `path`, if it cannot be used.
  std::optional<PointCloud> read(const std::string& name, const JsonPath& path, Mistakes& mistakes);

  /// Hulls of a mesh file's parts. A file without parts gives one hull of all vertices.
  std::optional<std::vector<PointCloud>> read_parts(const std::string& name, MeshSplit split,
                                                    const JsonPath& path, Mistakes& mistakes);

  /// The triangles of a mesh file, its coordinates times the scale; no mesh, and a mistake, if it
  /// cannot be used. Vertices at the same place become one.
  SceneMesh read_mesh(const std::string& name, double scale, const MeshShading& shading,
                      const JsonPath& path, Mistakes& mistakes);
  /// Materials of a mesh file by its attributes' numbers, read once; null if it has none.
  std::shared_ptr<const std::vector<FileMaterial>> materials_of(const SceneMesh& mesh,
                                                                const JsonPath& path,
                                                                Mistakes& mistakes);

  /// The heights of a picture's pixels, black 0 and white 1; nothing, and a mistake, if it cannot
  /// be used.
  std::optional<HeightGrid> read_heights(const std::string& name, const JsonPath& path,
                                         Mistakes& mistakes);
  /// Place for the mesh of a terrain by its text in the scene and its file, to be made once.
  std::shared_ptr<const TriangleMesh>& terrain(const std::string& name, const std::string& text) {
    return terrains_[{from_scene(name), text}];
  }

  /// Adds what was read: the names, and all vertices.
  void add_to(Hash& hash) const;

  /// The files that were read: of pictures, and of meshes.
  std::vector<std::filesystem::path> pictures() const;
  std::vector<std::filesystem::path> meshes() const;

  /// The picture of a file; null, and a mistake at `path`, if it cannot be used.
  std::shared_ptr<const Image> read_picture(const std::string& name, const JsonPath& path,
                                            Mistakes& mistakes) {
    return read_picture_of_scene(from_scene(name), path, mistakes);
  }
  /// Takes a name that is relative to the scene's folder.
  std::shared_ptr<const Image> read_picture_of_scene(const std::string& name, const JsonPath& path,
                                                     Mistakes& mistakes);

 private:
  struct Mesh {
    PointCloud points;
    std::string hash;  ///< of all vertices, in the file's order
  };
  std::filesystem::path folder_, of_names_;
  std::map<std::string, Mesh> read_;
  struct Parts {
    std::vector<PointCloud> hulls;
    std::string hash;  ///< of all vertices, and of how they are split
  };
  std::map<std::pair<std::string, MeshSplit>, Parts> parts_;
  struct Surface {
    SceneMesh mesh;
    std::string hash;  ///< of vertices and triangles, and of attributes if there are some
  };
  using SurfaceKey = std::tuple<std::string, double, MeshShading>;
  std::map<SurfaceKey, Surface> surfaces_;
  std::vector<std::filesystem::path> libraries_;  ///< files of meshes' materials
  struct Materials {
    std::shared_ptr<const std::vector<FileMaterial>> all;
    std::string hash;
  };
  std::map<std::string, Materials> materials_;  ///< by mesh file
  std::vector<FileMaterial> read_libraries(const std::filesystem::path& mesh,
                                           const MeshAttributes& attributes, const JsonPath& path,
                                           Mistakes& mistakes);
  std::map<std::string, std::string> heights_;  ///< hashes
  std::map<std::pair<std::string, std::string>, std::shared_ptr<const TriangleMesh>> terrains_;
  struct Picture {
    std::shared_ptr<const Image> image;
    std::string hash;  ///< of all pixels
  };
  std::map<std::string, Picture> pictures_;
  std::int64_t pixels_ = 0;  ///< of all pictures
};

}  // namespace minkray
