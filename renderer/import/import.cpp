// SPDX-License-Identifier: MIT
#include "renderer/import/import.h"

#include <algorithm>
#include <cctype>
#include <span>
#include <stdexcept>

#include "core/files/regular_file.h"
#include "renderer/import/gltf.h"
#include "renderer/import/mjcf.h"
#include "renderer/import/scene_of_model.h"
#include "renderer/import/sdf.h"
#include "renderer/import/urdf.h"
#include "renderer/import/xml.h"
#include "renderer/scene/scene_instances.h"
#include "renderer/scene/scene_json.h"

namespace minkray {
namespace {

/// A format is known by its root element.
struct ForeignFormat {
  std::string_view root;
  Model (*read)(XmlElement&& root, XmlFiles& files, const ImportOptions& options);
};
constexpr ForeignFormat formats[] = {
    {"mujoco",
     [](XmlElement&& root, XmlFiles& files, const ImportOptions& options) {
       return read_mjcf(std::move(root), files, options);
     }},
    {"mujocoinclude",
     [](XmlElement&& root, XmlFiles& files, const ImportOptions& options) {
       return read_mjcf(std::move(root), files, options);
     }},
    {"robot", [](XmlElement&& root, XmlFiles& files,
                 const ImportOptions& options) { return read_urdf(root, files, options); }},
    {"sdf", [](XmlElement&& root, XmlFiles& files,
               const ImportOptions& options) { return read_sdf(std::move(root), files, options); }},
    // So it was called up to version 1.2.
    {"gazebo",
     [](XmlElement&& root, XmlFiles& files, const ImportOptions& options) {
       return read_sdf(std::move(root), files, options);
     }},
};

constexpr std::string_view xml_endings[] = {".xml", ".mjcf", ".urdf", ".sdf", ".world", ".model"};
constexpr std::string_view gltf_endings[] = {".gltf", ".glb"};

bool has_ending(const std::filesystem::path& file, std::span<const std::string_view> endings) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return std::ranges::find(endings, ending) != endings.end();
}

std::optional<Model> model_of_gltf(std::string bytes, const std::filesystem::path& file,
                                   const ImportOptions& options, Mistakes& mistakes) {
  Model model = read_gltf(std::move(bytes), file, options, mistakes);
  if (!mistakes.none()) return std::nullopt;
  return model;
}

std::optional<Model> model_of(std::optional<XmlElement> root, XmlFiles& files,
                              const ImportOptions& options, Mistakes& mistakes) {
  if (!root) return std::nullopt;
  for (const ForeignFormat& format : formats) {
    if (format.root != root->name) continue;
    Model model = format.read(std::move(*root), files, options);
    if (!mistakes.none()) return std::nullopt;
    return model;
  }
  files.wrong(*root, "must be <mujoco>, <robot> (URDF) or <sdf>");
  return std::nullopt;
}

}  // namespace

bool is_foreign(const std::filesystem::path& file) {
  return has_ending(file, xml_endings) || has_ending(file, gltf_endings);
}

std::optional<Model> parse_model(const std::string& text, const std::filesystem::path& file,
                                 const ImportOptions& options, Mistakes& mistakes) {
  if (has_ending(file, gltf_endings)) return model_of_gltf(text, file, options, mistakes);
  XmlFiles files(mistakes);
  return model_of(files.parse(text, file), files, options, mistakes);
}

std::optional<Model> load_model(const std::filesystem::path& file, const ImportOptions& options,
                                Mistakes& mistakes) {
  if (has_ending(file, gltf_endings)) {
    try {
      return model_of_gltf(read_regular_file(file, most_gltf_bytes), file, options, mistakes);
    } catch (const std::runtime_error& error) {
      mistakes.add(error.what());
      return std::nullopt;
    }
  }
  XmlFiles files(mistakes);
  return model_of(files.read(file), files, options, mistakes);
}

Imported import_scene(const std::filesystem::path& file, const ImportOptions& options) {
  if (!is_foreign(file)) {
    if (options.any())
      throw WrongUsage("--geometry, --keyframe, --joint and the like are for robots' files (" +
                       printable(file.string(), 100) + " is none)");
    return {load_scene(file), std::nullopt, {}};
  }
  Mistakes mistakes(file.string());
  Imported imported;
  imported.model = load_model(file, options, mistakes);
  throw_if_any(mistakes);
  Model& model = *imported.model;
  pose_model(model, options, mistakes);
  if (!options.joint_rows.empty())
    imported.rows = read_joint_rows(options.joint_rows, model, mistakes);
  throw_if_any(mistakes);
  imported.scene = scene_of(model, options, imported.rows);
  if (imported.scene.objects.size() > most_instances) mistakes.add("has too many shapes");
  for (const Object& object : imported.scene.objects)
    if (!object.pose.linear.allFinite() || !object.pose.translation.allFinite()) {
      mistakes.add("the shape " + printable(object.name, 100) +
                   " stands at no place that numbers can tell");
      break;
    }
  throw_if_any(mistakes);
  return imported;
}

}  // namespace minkray
