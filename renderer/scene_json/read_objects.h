// SPDX-License-Identifier: MIT
// The objects of a scene file, in groups or not, with those of the files that it includes.
#pragma once

#include <set>
#include <string>

#include "renderer/json/object_reader.h"
#include "renderer/member_json/mesh_files.h"
#include "renderer/scene/scene.h"
#include "renderer/scene_json/material_names.h"
#include "renderer/scene_json/scene_files.h"

namespace minkray {

/// Limit of objects from files that are included repeatedly.
inline constexpr std::size_t most_objects_of_groups = std::size_t{1} << 22;
inline constexpr std::size_t most_groups = 100'000;

class ObjectsReader {
 public:
  ObjectsReader(Scene& scene, MaterialNames& materials, MeshFiles& meshes, Mistakes& mistakes)
      : scene_(scene), materials_(materials), meshes_(meshes), mistakes_(mistakes) {}

  /// Adds a file's own objects to the scene's.
  void read(const SceneFile& file);

 private:
  /// Frame of the groups around an object.
  struct Frame {
    Affine<double> pose;
    bool is_posed = false;
    std::string name;  ///< before the objects' own: "left/"
  };

  void read_list(const Json& objects, const JsonPath& path, const Frame& frame);
  void read_item(const Json& json, const JsonPath& path, const Frame& frame);
  void read_group(const Json& json, const JsonPath& path, const Frame& frame);
  void read_included(const SceneFile& file, const Frame& frame, std::set<const SceneFile*>& read);
  void read_object(const Json& json, const JsonPath& path, const Frame& frame);
  std::string read_name_of(ObjectReader& object, const Json& json, const Frame& frame);
  std::uint32_t read_material_of(ObjectReader& object);
  std::optional<Motion> read_motion(ObjectReader& object, const Affine<double>& pose,
                                    const Frame& frame);
  bool is_version_one() const { return file_->version == 1; }

  Scene& scene_;
  MaterialNames& materials_;
  MeshFiles& meshes_;
  Mistakes& mistakes_;
  const SceneFile* file_ = nullptr;  ///< that is read now
  std::size_t groups_ = 0;
  bool is_full_ = false;
};

}  // namespace minkray
