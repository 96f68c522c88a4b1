// SPDX-License-Identifier: MIT
// Reads the camera of a scene file, and places it if the file does not.
#pragma once

#include "renderer/json/json.h"
#include "renderer/json/mistakes.h"
#include "renderer/member_json/mesh_files.h"
#include "renderer/scene/scene.h"

namespace minkray {

class CameraReader {
 public:
  CameraReader(Scene& scene, MeshFiles& files, Mistakes& mistakes)
      : scene_(scene), files_(files), mistakes_(mistakes) {}

  /// Version 1 requires a camera's position.
  void read(const Json& json, const JsonPath& path, int version);
  /// Frames all objects, unless the file places the camera, and finds its focus. Call after all
  /// objects are read. Reads keys last, since they start with the final camera.
  void settle(const JsonPath& path);

 private:
  void read_keys();

  Scene& scene_;
  MeshFiles& files_;
  Mistakes& mistakes_;
  const Json* json_ = nullptr;
  JsonPath path_;
  bool has_position_ = false, has_look_at_ = false, has_up_ = false, is_good_ = true;
  bool is_version_one_ = false;
};

}  // namespace minkray
