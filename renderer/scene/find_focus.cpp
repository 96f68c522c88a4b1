// SPDX-License-Identifier: MIT
#include "renderer/scene/find_focus.h"

#include "core/math/vec.h"
#include "renderer/json/object_reader.h"

namespace minkray {

void find_focus(Scene& scene, const JsonPath& path, Mistakes& mistakes) {
  CameraDescription& camera = scene.camera;
  if (camera.aperture > 0 && camera.type.name != "perspective")
    mistakes.add(path / "aperture", "must be 0 for other cameras than perspective");
  if (camera.focus_distance && !camera.focus_on.empty())
    mistakes.add(path, "must have either \"focus_distance\" or \"focus_on\" (got both)");
  camera.focus = camera.focus_distance.value_or(0);
  if (camera.focus_on.empty()) return;
  std::vector<std::string> names;
  for (const Object& object : scene.objects) {
    if (object.name != camera.focus_on) {
      names.push_back(printable(object.name, 60));
      continue;
    }
    const Vec3<double> view = unit<double>(camera.look_at - camera.position);
    camera.focus = view.dot(object.pose.translation - camera.position);
    if (!(camera.focus > 0))
      mistakes.add(path / "focus_on", "must be an object in front of the camera");
    return;
  }
  mistakes.add(path / "focus_on", "must be the name of an object (got \"" +
                                      printable(camera.focus_on, 60) + "\"; " +
                                      suggestion(camera.focus_on, names) + ")");
}

}  // namespace minkray
