// SPDX-License-Identifier: MIT
#include "renderer/import/import.h"

#include <algorithm>
#include <array>
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

/// What is XML is known by its root element, whatever its file is called; what is none by the
/// ending.
struct ForeignFormat {
  std::string_view name;
  std::array<std::string_view, 3> endings;
  std::array<std::string_view, 2> roots = {};  ///< of XML
  Model (*read_element)(XmlElement&& root, XmlFiles& files, const ImportOptions& options) = nullptr;
  Model (*read_bytes)(std::string&& bytes, const std::filesystem::path& file,
                      const ImportOptions& options, Mistakes& mistakes) = nullptr;
  std::size_t most_bytes = 0;
};
constexpr ForeignFormat formats[] = {
    {.name = "MJCF",
     .endings = {".xml", ".mjcf"},
     .roots = {"mujoco", "mujocoinclude"},
     .read_element =
         [](XmlElement&& root, XmlFiles& files, const ImportOptions& options) {
           return read_mjcf(std::move(root), files, options);
         }},
    {.name = "URDF",
     .endings = {".urdf"},
     .roots = {"robot"},
     .read_element = [](XmlElement&& root, XmlFiles& files,
                        const ImportOptions& options) { return read_urdf(root, files, options); }},
    {.name = "SDF",
     .endings = {".sdf", ".world", ".model"},
     .roots = {"sdf", "gazebo"},  // the latter up to version 1.2
     .read_element =
         [](XmlElement&& root, XmlFiles& files, const ImportOptions& options) {
           return read_sdf(std::move(root), files, options);
         }},
    {.name = "glTF",
     .endings = {".gltf", ".glb"},
     .read_bytes =
         [](std::string&& bytes, const std::filesystem::path& file, const ImportOptions& options,
            Mistakes& mistakes) { return read_gltf(std::move(bytes), file, options, mistakes); },
     .most_bytes = most_gltf_bytes},
};

/// Names that are not there are empty.
bool has(std::span<const std::string_view> names, std::string_view name) {
  return !name.empty() && std::ranges::find(names, name) != names.end();
}

/// The format that has the file's ending; null if none has.
const ForeignFormat* told_by_ending(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto found = std::ranges::find_if(
      formats, [&](const ForeignFormat& format) { return has(format.endings, ending); });
  return found == std::end(formats) ? nullptr : found;
}

bool is_xml(const ForeignFormat* format) {
  return !format || !format->read_bytes;
}

std::optional<Model> unless_wrong(Model model, const Mistakes& mistakes) {
  if (!mistakes.none()) return std::nullopt;
  return model;
}

std::optional<Model> model_of(std::optional<XmlElement> root, XmlFiles& files,
                              const ImportOptions& options, Mistakes& mistakes) {
  if (!root) return std::nullopt;
  for (const ForeignFormat& format : formats)
    if (has(format.roots, root->name))
      return unless_wrong(format.read_element(std::move(*root), files, options), mistakes);
  std::string expected;
  for (const ForeignFormat& format : formats) {
    if (!is_xml(&format)) continue;
    if (!expected.empty()) expected += " or ";
    expected += "<" + std::string(format.roots.front()) + "> (" + std::string(format.name) + ")";
  }
  files.wrong(*root, "must be " + expected);
  return std::nullopt;
}

}  // namespace

std::string foreign_formats() {
  std::string all;
  for (const ForeignFormat& format : formats) {
    all += (all.empty() ? "" : ", ") + std::string(format.name);
    std::string endings;
    for (const std::string_view ending : format.endings)
      if (!ending.empty()) endings += (endings.empty() ? "" : ", ") + std::string(ending);
    all += " (" + endings + ")";
  }
  return all;
}

bool is_foreign(const std::filesystem::path& file) {
  return told_by_ending(file) != nullptr;
}

std::optional<Model> parse_model(const std::string& text, const std::filesystem::path& file,
                                 const ImportOptions& options, Mistakes& mistakes) {
  if (const ForeignFormat* format = told_by_ending(file); !is_xml(format))
    return unless_wrong(format->read_bytes(std::string(text), file, options, mistakes), mistakes);
  XmlFiles files(mistakes);
  return model_of(files.parse(text, file), files, options, mistakes);
}

std::optional<Model> load_model(const std::filesystem::path& file, const ImportOptions& options,
                                Mistakes& mistakes) {
  if (const ForeignFormat* format = told_by_ending(file); !is_xml(format)) {
    try {
      return unless_wrong(
          format->read_bytes(read_regular_file(file, format->most_bytes), file, options, mistakes),
          mistakes);
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
