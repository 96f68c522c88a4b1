// SPDX-License-Identifier: MIT
#include "renderer/scene_json/scene_json.h"

#include <algorithm>

#include "renderer/json/parse.h"
#include "renderer/json/values.h"
#include "renderer/member_json/read_colour.h"
#include "renderer/member_json/read_member_keys.h"
#include "renderer/member_json/tagged_json.h"
#include "renderer/scene/default_light.h"
#include "renderer/scene/fitting_keys.h"
#include "renderer/scene/scene_instances.h"
#include "renderer/scene_json/material_names.h"
#include "renderer/scene_json/read_camera.h"
#include "renderer/scene_json/read_objects.h"
#include "renderer/scene_json/read_particles.h"
#include "renderer/scene_json/read_visible_to.h"
#include "renderer/scene_json/scene_files.h"

namespace minkray {
namespace {

/// Reads the parts of a scene's files into `scene`.
class SceneReader {
 public:
  SceneReader(Scene& scene, const std::filesystem::path& folder, Mistakes& mistakes)
      : scene_(scene),
        folder_(folder),
        meshes_(folder),
        mistakes_(mistakes),
        materials_(scene),
        camera_(scene, meshes_, mistakes) {}

  std::vector<std::filesystem::path> pictures() const { return meshes_.pictures(); }
  std::vector<std::filesystem::path> other_files() const {
    std::vector<std::filesystem::path> files = meshes_.meshes();
    files.insert(files.end(), pose_files_.begin(), pose_files_.end());
    return files;
  }

  void add_files_to(Hash& hash) const {
    meshes_.add_to(hash);
    if (!scene_.particles.empty()) hash.add(particle_files_.text());
  }

  void read(const SceneFiles& files, ScenePurpose purpose) {
    purpose_ = purpose;
    const SceneFile& main = *files.main();
    std::vector<const SceneFile*> whole;
    add_whole(main, whole);
    // Materials may be named by all files, and mixed of those of files that are included.
    for (const auto& file : files.all()) {
      const bool is_whole = std::ranges::find(whole, file.get()) != whole.end();
      in(*file, [&] { read_head(*file, file.get() == &main, is_whole); });
    }
    ObjectsReader objects(scene_, materials_, meshes_, mistakes_);
    for (const SceneFile* file : whole)
      in(*file, [&] {
        objects.read(*file);
        read_particles_of(*file);
      });
    for (const auto& file : files.all())
      in(*file, [&] {
        read_rest(*file, file.get() == &main, std::ranges::find(whole, file.get()) != whole.end());
      });
    settle(main);
  }

 private:
  static constexpr std::string_view keys_of_files[] = {
      "version",   "$schema", "description", "labels",     "camera", "lights",
      "materials", "objects", "particles",   "background", "include"};

  /// Adds the files that are read with all that is in them: those that are included at the top of
  /// each other. Each comes after those that it includes.
  static void add_whole(const SceneFile& file, std::vector<const SceneFile*>& whole) {
    for (const SceneFile* included : file.included_by_file)
      if (std::ranges::find(whole, included) == whole.end()) add_whole(*included, whole);
    whole.push_back(&file);
  }

  /// Reads something of a file: mistakes are its own, and names of files relative to it.
  template <class Read>
  void in(const SceneFile& file, Read&& read) {
    const MistakesIn naming(mistakes_, file.shown);
    meshes_.set_folder_of_names(file.folder);
    read();
  }

  void read_head(const SceneFile& scene_file, bool is_main, bool is_whole) {
    ObjectReader file(scene_file.json, JsonPath(), mistakes_);
    if (!file.is_object()) return;
    const bool is_version_one = scene_file.version == 1;
    if (const Json* schema = file.find("$schema")) {  // for editors
      read_string(*schema, file.path("$schema"), mistakes_);
    }
    if (const Json* description = file.find("description")) {
      const auto text = read_string(*description, file.path("description"), mistakes_);
      if (text && is_main) scene_.description = *text;
    }
    if (const Json* labels = file.find("labels")) {
      const auto drawn = read_bool(*labels, file.path("labels"), mistakes_);
      if (is_main) scene_.labels = drawn.value_or(false);
    }
    const bool needs_light = is_version_one && purpose_ == ScenePurpose::picture;
    const Json* camera = needs_light ? file.require("camera", "an object") : file.find("camera");
    if (camera && is_whole && (is_main || !has_camera_)) {
      // The scene's own comes last, and takes the place of an included one.
      camera_.read(*camera, file.path("camera"), scene_file.version);
      camera_file_ = &scene_file;
      has_camera_ = true;
    }
    const bool has_lights = file.find("lights");
    if (is_whole && (needs_light || has_lights)) {
      has_lights_ = true;
      for_each_item(file, "lights", [&](const Json& light, const JsonPath& path) {
        read_light(light, path, is_version_one);
      });
    }
    if (is_version_one || file.find("materials"))
      for_each_item(file, "materials", [&](const Json& material, const JsonPath& path) {
        read_material(material, path, is_version_one);
      });
    if (is_version_one || (is_main && !file.find("include") && !file.find("particles")))
      file.require("objects", "a list");
  }

  void read_particles_of(const SceneFile& scene_file) {
    ObjectReader file(scene_file.json, JsonPath(), mistakes_);
    if (!file.find("particles")) return;
    for_each_item(file, "particles", [&](const Json& block, const JsonPath& path) {
      read_particle_block(block, path);
    });
  }

  /// Reads the keys after the objects; reports unknown keys last.
  void read_rest(const SceneFile& scene_file, bool is_main, bool is_whole) {
    ObjectReader file(scene_file.json, JsonPath(), mistakes_);
    if (!file.is_object()) return;
    const Json* background = file.find("background");
    if (background && is_whole && (is_main || !has_background_)) {
      read_background(*background, file.path("background"));
      has_background_ = true;
    }
    for (const std::string_view key : keys_of_files)
      if (key != "include" || scene_file.version != 1) file.allow({key});
    file.finish();
  }

  /// Fills in what no file has given, once all are read.
  void settle(const SceneFile& main) {
    if (!has_lights_)
      scene_.lights_are_default = true;
    else if (!has_background_)
      choose_background(main.version);
    const MistakesIn naming(mistakes_, (camera_file_ ? camera_file_ : &main)->shown);
    camera_.settle(JsonPath() / "camera");
    if (scene_.lights_are_default && mistakes_.none()) {
      const Background written = scene_.background;
      light_everything(scene_);
      if (has_background_) scene_.background = written;
    }
  }

  /// Cameras see the environment light. Without one, the background of version 1 is white.
  void choose_background(int version) {
    for (const Light& light : scene_.lights)
      if (std::holds_alternative<ImageSkyLight>(light) ||
          std::holds_alternative<SunSkyLight>(light))
        scene_.background_is_sky = true;
    if (version == 1) return;
    scene_.background = default_background;
    for (const Light& light : scene_.lights)
      if (const auto* sky = std::get_if<EnvironmentLight>(&light))
        scene_.background = {sky->zenith, sky->nadir};
  }

  template <class Read>
  void for_each_item(ObjectReader& file, std::string_view key, Read&& read) {
    const Json* list = file.require(key, "a list");
    if (!list) return;
    if (!list->is_array()) {
      mistakes_.add(file.path(key), "must be a list (" + found(*list) + ")");
      return;
    }
    const JsonPath path = file.path(key);
    for (std::size_t i = 0; i < list->size(); ++i) read((*list)[i], path / i);
  }

  void read_light(const Json& json, const JsonPath& path, bool is_version_one) {
    ObjectReader object(json, path, mistakes_);
    double intensity = 1;
    if (const Json* factor = object.find("intensity")) {
      intensity =
          read_number(*factor, object.path("intensity"), mistakes_, Range::brightness).value_or(1);
    }
    const Json* keys = is_version_one ? nullptr : object.find("keys");
    auto light = read_tagged<Light>(
        object, "a light", [&](auto& kind) { return read_members(object, kind, meshes_); });
    if (!light) return;
    const auto* directional = std::get_if<DirectionalLight>(&*light);
    if (directional && directional->direction.isZero(0)) {
      mistakes_.add(path / "direction", "must not be zero");
    }
    if (auto* day = std::get_if<SunSkyLight>(&*light)) find_sun(*day, json, path, mistakes_);
    if (keys) {
      auto read = read_member_keys(*keys, path / "keys", mistakes_, meshes_, *light, intensity);
      check_suns(read, path / "keys", mistakes_);
      scene_.light_keys.push_back(
          {static_cast<std::uint32_t>(scene_.lights.size()), std::move(read)});
    }
    std::visit([&](auto& kind) { kind.scale(intensity); }, *light);
    scene_.lights.push_back(std::move(*light));
  }

  void read_material(const Json& json, const JsonPath& path, bool is_version_one) {
    ObjectReader object(json, path, mistakes_);
    std::string name;
    if (const Json* written = object.require("name", "the material's name")) {
      const auto text = read_string(*written, object.path("name"), mistakes_);
      if (text && text->empty()) mistakes_.add(object.path("name"), "must not be empty");
      name = text.value_or("");
    }
    Relief relief;
    if (read_members(object, relief, meshes_)) check_relief(relief, path, mistakes_);
    const RayKinds visible_to = read_visible_to(object);
    const Json* keys = is_version_one ? nullptr : object.find("keys");
    auto kind = read_tagged<MaterialKind>(
        object, "a material", [&](auto& made) { return read_members(object, made, meshes_); });
    if (kind) check_metal(*kind, path, mistakes_);
    if (kind) find_mixed(*kind, path);
    if (name.empty()) return;
    // A material with mistakes still takes its name and place, so that objects of it are no
    // mistakes, too.
    const auto index = static_cast<std::uint32_t>(scene_.materials.size());
    if (!materials_.add({name, kind.value_or(LambertMaterial()), relief, visible_to}, path,
                        mistakes_))
      return;
    if (kind && keys)
      scene_.material_keys.push_back(
          {index, read_member_keys(*keys, path / "keys", mistakes_, meshes_, *kind)});
    check_visible(scene_, index, all_ray_kinds, object);
  }

  void find_mixed(MaterialKind& kind, const JsonPath& path) {
    auto* mix = std::get_if<MixMaterial>(&kind);
    for (std::size_t i = 0; mix && i < 2; ++i)
      mix->materials.indices[i] =
          materials_.named(Json((*mix->materials.names)[i]), path / "materials" / i, mistakes_);
  }

  void read_particle_block(const Json& json, const JsonPath& path) {
    auto set = read_particles(
        json, path, mistakes_,
        {scene_, folder_, meshes_, particle_files_, pose_files_,
         most_instances - instance_count(scene_), [&](const Json& name, const JsonPath& at) {
           return materials_.named(name, at, mistakes_);
         }});
    if (set) scene_.particles.push_back(std::move(*set));
  }

  /// One colour, or two.
  void read_background(const Json& json, const JsonPath& path) {
    if (json.is_object()) {
      ObjectReader object(json, path, mistakes_);
      read_members(object, scene_.background, meshes_);
      object.finish();
    } else if (!json.is_array() && !json.is_string()) {
      mistakes_.add(path,
                    "must be a colour (a list of 3 numbers) or an object with \"zenith\" "
                    "and \"nadir\" (" +
                        found(json) + ")");
    } else if (const auto colour = read_colour(json, path, mistakes_, Range::brightness)) {
      scene_.background = {*colour, *colour};
    }
  }

  Scene& scene_;
  std::filesystem::path folder_;
  Hash particle_files_;
  std::vector<std::filesystem::path> pose_files_;
  MeshFiles meshes_;
  Mistakes& mistakes_;
  MaterialNames materials_;
  CameraReader camera_;
  const SceneFile* camera_file_ = nullptr;
  bool has_camera_ = false, has_lights_ = false, has_background_ = false;
  ScenePurpose purpose_ = ScenePurpose::picture;
};

}  // namespace

std::optional<Scene> parse_scene(std::string_view text, const std::filesystem::path& folder,
                                 Mistakes& mistakes,
                                 std::vector<std::filesystem::path>* other_files,
                                 ScenePurpose purpose) {
  const SceneFiles files(text, folder, mistakes);
  if (!files.main()) return std::nullopt;
  Scene scene;
  SceneReader reader(scene, folder, mistakes);
  reader.read(files, purpose);
  if (!mistakes.none()) return std::nullopt;
  try {
    set_time(scene, 0);
  } catch (const BadInput& bad) {
    mistakes.add(bad.what());
    return std::nullopt;
  }
  Hash hash;
  hash.add(text);
  files.add_to(hash);
  reader.add_files_to(hash);
  scene.hash = hash.text();
  scene.pictures = reader.pictures();
  if (!other_files) return scene;
  *other_files = reader.other_files();
  other_files->insert(other_files->end(), files.paths().begin(), files.paths().end());
  return scene;
}

Scene load_scene(const std::filesystem::path& file, std::vector<std::filesystem::path>* other_files,
                 ScenePurpose purpose) {
  Mistakes mistakes(file.string());
  std::optional<Scene> scene;
  if (const auto text = read_text_file(file, mistakes)) {
    scene = parse_scene(*text, file.parent_path(), mistakes, other_files, purpose);
  }
  throw_if_any(mistakes);
  return std::move(*scene);
}

}  // namespace minkray
