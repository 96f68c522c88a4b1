// SPDX-License-Identifier: MIT
#include "renderer/info/scene_info.h"
#include "renderer/member_json/shape_json.h"
#include "renderer/scene_json/scene_json.h"
#include "tests/fuzz/messages.h"
#include "tests/fuzz/target.h"

namespace minkray::fuzz {
namespace {

/// No mesh file is found there, and none is read.
constexpr const char* no_folder = "no-such-folder";

/// A shape that is written and read again is the same shape.
std::string check_written(const Shape& shape) {
  const Json written = write_shape(shape);
  Mistakes mistakes("written");
  MeshFiles meshes(no_folder);
  const auto again = read_shape(written, JsonPath(), mistakes, meshes);
  if (!again) return "a written shape is not read: " + mistakes.text() + "\n" + written.dump();
  if (write_shape(*again) != written)
    return "a shape changes when it is written: " + written.dump();
  return "";
}

}  // namespace

std::string check_scene(std::string_view bytes) {
  Mistakes mistakes("scene");
  const std::optional<Scene> scene = parse_scene(bytes, no_folder, mistakes);
  if (scene.has_value() != mistakes.none())
    return scene ? "a scene, and mistakes: " + mistakes.text() : "neither a scene nor a mistake";
  if (const std::string bad = check_messages(mistakes); !bad.empty()) return bad;
  if (!scene) return "";
  if (info_as_text(*scene).empty() || info_as_json(*scene).empty()) return "nothing to say of it";
  for (const Object& object : scene->objects) {
    if (object.material >= scene->materials.size()) return "an object has no material";
    if (const std::string bad = check_written(object.shape); !bad.empty()) return bad;
  }
  return "";
}

}  // namespace minkray::fuzz
