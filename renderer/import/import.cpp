// SPDX-License-Identifier: MIT
#include "renderer/import/import.h"

#include <algorithm>
#include <array>
#include <span>
#include <stdexcept>
#include <utility>

#include "core/files/regular_file.h"
#include "core/files/text.h"
#include "renderer/base/hash.h"
#include "renderer/base/of_file.h"
#include "renderer/import/mesh/geometry_common.h"
#include "renderer/import/mesh/gltf.h"
#include "renderer/import/mjcf/mjcf.h"
#include "renderer/import/model/file_kind.h"
#include "renderer/import/model/xml.h"
#include "renderer/import/scene_of_model.h"
#include "renderer/import/sdf/sdf.h"
#include "renderer/import/sdf/urdf.h"
#include "renderer/scene/append_materials.h"
#include "renderer/scene/default_light.h"
#include "renderer/scene/framing.h"
#include "renderer/scene/scene_instances.h"
#include "renderer/scene_json/scene_json.h"

namespace minkray {
namespace {

/// XML is recognised by its root element, whatever the file's name.
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
     .read_element =
         [](XmlElement&& root, XmlFiles& files, const ImportOptions& options) {
           return read_urdf(std::move(root), files, options);
         }},
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

/// The only format that is no XML.
const ForeignFormat& gltf_format() {
  return *std::ranges::find_if(
      formats, [](const ForeignFormat& format) { return format.read_bytes != nullptr; });
}

bool is_xml(const ForeignFormat& format) {
  return !format.read_bytes;
}

std::optional<Model> unless_wrong(Model model, const Mistakes& mistakes) {
  if (!mistakes.none()) return std::nullopt;
  return model;
}

std::optional<Model> model_of(std::optional<XmlElement> root, XmlFiles& files,
                              const ImportOptions& options, Mistakes& mistakes) {
  if (!root) return std::nullopt;
  for (const ForeignFormat& format : formats)
    if (has(format.roots, root->name)) {
      Model model = format.read_element(std::move(*root), files, options);
      model.files.insert(model.files.end(), files.files().begin(), files.files().end());
      tell_missing_meshes(model, files, options);
      return unless_wrong(std::move(model), mistakes);
    }
  std::string expected;
  for (const ForeignFormat& format : formats) {
    if (!is_xml(format)) continue;
    if (!expected.empty()) expected += " or ";
    expected += "<" + std::string(format.roots.front()) + "> (" + std::string(format.name) + ")";
  }
  files.wrong(*root, "must be " + expected);
  return std::nullopt;
}

}  // namespace

std::string foreign_formats() {
  return listed(formats, [](const ForeignFormat& format) {
    const auto given = std::ranges::find(format.endings, "");
    return std::string(format.name) + " (" +
           listed(std::ranges::subrange(format.endings.begin(), given)) + ")";
  });
}

bool is_foreign(const std::filesystem::path& file) {
  const FileKind kind = content_of(file).kind;
  return kind == FileKind::xml || kind == FileKind::gltf;
}

std::optional<Model> parse_model(const std::string& text, const std::filesystem::path& file,
                                 const ImportOptions& options, Mistakes& mistakes) {
  if (content_of(text, file).kind == FileKind::gltf)
    return unless_wrong(gltf_format().read_bytes(std::string(text), file, options, mistakes),
                        mistakes);
  XmlFiles files(mistakes);
  return model_of(files.parse(text, file), files, options, mistakes);
}

void check_can_be_scene(const std::filesystem::path& file) {
  if (const FileContent content = content_of(file); content.kind == FileKind::other)
    throw BadInput(printable(file.string(), 200) + ": is " + content.what +
                   "; a scene is a JSON file or " + foreign_formats());
}

std::optional<Model> load_model(const std::filesystem::path& file, const ImportOptions& options,
                                Mistakes& mistakes) {
  if (content_of(file).kind == FileKind::gltf) {
    const ForeignFormat& format = gltf_format();
    try {
      return unless_wrong(
          format.read_bytes(read_regular_file(file, format.most_bytes), file, options, mistakes),
          mistakes);
    } catch (const std::exception& error) {
      mistakes.add(what_of(error));
      return std::nullopt;
    }
  }
  XmlFiles files(mistakes);
  return model_of(files.read(file), files, options, mistakes);
}

namespace {

Imported import_alone(const std::filesystem::path& file, const ImportOptions& options) {
  check_can_be_scene(file);
  if (!is_foreign(file)) {
    if (options.any())
      throw WrongUsage("--geometry, --keyframe, --joint and related options need a robot file (" +
                       printable(file.string(), 100) + " is none)");
    Imported imported;
    imported.scene = load_scene(file, &imported.files, options.purpose);
    imported.files.push_back(file);
    imported.files.insert(imported.files.end(), imported.scene.pictures.begin(),
                          imported.scene.pictures.end());
    return imported;
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
  imported.files = model.files;
  imported.files.push_back(file);
  if (!options.joint_rows.empty()) imported.files.emplace_back(options.joint_rows);
  if (imported.scene.objects.size() > most_instances) mistakes.add("has too many shapes");
  for (const Object& object : imported.scene.objects)
    if (!object.pose.linear.allFinite() || !object.pose.translation.allFinite()) {
      mistakes.add("the shape " + printable(object.name, 100) +
                   " has a position beyond the range of double");
      break;
    }
  throw_if_any(mistakes);
  return imported;
}

/// Adds what is in a scene, but for its camera and lights.
void append_objects(Scene& to, Scene&& from) {
  if (instance_count(to) + instance_count(from) > most_instances)
    throw BadInput("all files together must have at most " + std::to_string(most_instances) +
                   " objects");
  append_materials(to, from);
  for (Object& object : from.objects) to.objects.push_back(std::move(object));
  for (ParticleSet& set : from.particles) to.particles.push_back(std::move(set));
  to.pictures.insert(to.pictures.end(), from.pictures.begin(), from.pictures.end());
  Hash hash;
  hash.add(to.hash);
  hash.add(from.hash);
  to.hash = hash.text();
}

void take_view(Scene& to, Scene& from) {
  to.camera = from.camera;
  to.lights = std::move(from.lights);
  to.background = from.background;
  to.background_is_sky = from.background_is_sky;
  to.camera_keys = std::move(from.camera_keys);
  to.light_keys = std::move(from.light_keys);
  to.camera_is_framed = from.camera_is_framed;
  to.lights_are_default = from.lights_are_default;
}

}  // namespace

Imported import_scene(const std::filesystem::path& file, const ImportOptions& options) {
  if (options.others.empty()) return import_alone(file, options);
  // Joints are those of the first file, the other options apply to every robot.
  ImportOptions of_robots = options;
  of_robots.keyframe.clear();
  of_robots.joints.clear();
  of_robots.joint_rows.clear();
  ImportOptions of_scenes;
  of_scenes.purpose = options.purpose;
  const bool sets_joints =
      !options.keyframe.empty() || !options.joints.empty() || !options.joint_rows.empty();
  const bool begins_with_scene =
      !is_foreign(file) && std::ranges::any_of(options.others, is_foreign);
  if (begins_with_scene && sets_joints)
    throw WrongUsage(
        "--joint, --joints and --keyframe are for a robot, which must be the first file (" +
        printable(file.string(), 100) + " is none)");
  Imported imported = import_alone(file, begins_with_scene ? of_scenes : options);
  bool has_view = !imported.model;
  for (const std::string& name : options.others) {
    Imported other = import_alone(name, is_foreign(name) ? of_robots : of_scenes);
    if (!has_view && !other.model) {
      take_view(imported.scene, other.scene);
      has_view = true;
    }
    append_objects(imported.scene, std::move(other.scene));
    imported.files.insert(imported.files.end(), other.files.begin(), other.files.end());
    if (other.model) imported.other_models.push_back(std::move(*other.model));
  }
  make_names_unique(imported.scene);
  if (!has_view) {
    imported.scene.lights.clear();
    frame_everything(imported.scene, options.picture);
    light_everything(imported.scene);
  }
  if (imported.scene.camera_is_framed) frame_with_own_lens(imported.scene);
  return imported;
}

}  // namespace minkray
