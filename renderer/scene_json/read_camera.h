// SPDX-License-Identifier: MIT
// The camera of a scene file, and where it is if the file does not say it.
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

  /// In version 1 a camera must say where it is.
  void read(const Json& json, const JsonPath& path, int version);
  /// Once all objects are read: frames them, unless the file says where the camera is, and finds
  /// its focus. Reads keys last, which begin with what the camera is then.
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
