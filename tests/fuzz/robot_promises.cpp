// SPDX-License-Identifier: MIT
#include "tests/fuzz/robot_promises.h"

#include "renderer/import/import.h"
#include "renderer/import/model_info.h"
#include "renderer/import/scene_of_model.h"
#include "renderer/scene_json/write_scene.h"
#include "tests/fuzz/messages.h"

namespace minkray::fuzz {

std::string check_robot(const std::string& text, const std::string& file) {
  Mistakes mistakes("robot");
  ImportOptions options;
  options.geometry = GeometryChoice::all;
  // No mesh and no included file is found there.
  std::optional<Model> model = parse_model(text, "no-such-folder/" + file, options, mistakes);
  if (model.has_value() != mistakes.none())
    return model ? "a model, and mistakes: " + mistakes.text() : "neither a model nor a mistake";
  if (const std::string bad = check_messages(mistakes); !bad.empty()) return bad;
  if (!model) return "";
  if (model_as_text(*model).empty()) return "nothing to say of it";
  model_as_json(*model).dump();  // throws if anything is no text
  for (std::size_t i = 0; i < model->links.size(); ++i)
    if (model->links[i].parent >= static_cast<int>(i)) return "a link in front of its parent";
  for (const ModelGeom& geom : model->geoms)
    if (geom.link >= static_cast<int>(model->links.size())) return "a shape on no link";
  const Scene scene = scene_of(*model, options, {});
  if (scene.objects.size() != model->geoms.size()) return "a shape that is no object";
  for (const Object& object : scene.objects)
    if (object.material >= scene.materials.size()) return "an object has no material";
  if (scene_text(scene).empty()) return "no text of the scene";
  return "";
}

std::string check_robot_within(std::string_view root, std::string_view bytes,
                               const std::string& file) {
  const std::string begin = "<" + std::string(root);
  if (bytes.starts_with(begin)) return check_robot(std::string(bytes), file);
  return check_robot(begin + ">" + std::string(bytes) + "</" + std::string(root) + ">", file);
}

}  // namespace minkray::fuzz
