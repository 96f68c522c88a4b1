// SPDX-License-Identifier: MIT
#include "renderer/scene/scene_json.h"

#include <algorithm>
#include <map>

#include "renderer/json/parse.h"
#include "renderer/json/values.h"
#include "renderer/scene/find_focus.h"
#include "renderer/scene/fitting_keys.h"
#include "renderer/scene/half_space_json.h"
#include "renderer/scene/height_field_json.h"
#include "renderer/scene/mesh_json.h"
#include "renderer/scene/read_particles.h"
#include "renderer/scene/read_split.h"
#include "renderer/scene/read_visible_to.h"
#include "renderer/scene/scene_instances.h"
#include "renderer/scene/shape_json.h"
#include "renderer/scene/tagged_json.h"

namespace minkray {
namespace {

/// A view direction and "up" are taken for parallel if the sine of their angle is below this: the
/// picture would turn by noise.
constexpr double parallel_sine = 1e-9;

/// Reads the parts of one scene file into `scene`.
class SceneReader {
 public:
  SceneReader(Scene& scene, const std::filesystem::path& folder, Mistakes& mistakes)
      : scene_(scene), folder_(folder), meshes_(folder), mistakes_(mistakes) {}

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

  void read(const Json& json, ScenePurpose purpose) {
    ObjectReader file(json, JsonPath(), mistakes_);
    if (!file.is_object()) return;
    if (const Json* version = file.require("version", std::to_string(scene_version))) {
      read_integer(*version, file.path("version"), mistakes_, scene_version, scene_version);
    }
    if (const Json* schema = file.find("$schema")) {  // for editors
      read_string(*schema, file.path("$schema"), mistakes_);
    }
    if (const Json* description = file.find("description")) {
      if (auto text = read_string(*description, file.path("description"), mistakes_)) {
        scene_.description = *text;
      }
    }
    if (const Json* labels = file.find("labels")) {
      scene_.labels = read_bool(*labels, file.path("labels"), mistakes_).value_or(false);
    }
    const bool is_picture = purpose == ScenePurpose::picture;
    if (const Json* camera =
            is_picture ? file.require("camera", "an object") : file.find("camera")) {
      read_camera(*camera, file.path("camera"));
    }
    if (is_picture || file.find("lights"))
      for_each_item(file, "lights",
                    [&](const Json& light, const JsonPath& path) { read_light(light, path); });
    for_each_item(file, "materials", [&](const Json& material, const JsonPath& path) {
      read_material(material, path);
    });
    for_each_item(file, "objects",
                  [&](const Json& object, const JsonPath& path) { read_object(object, path); });
    if (file.find("particles")) {
      for_each_item(file, "particles", [&](const Json& block, const JsonPath& path) {
        read_particle_block(block, path);
      });
    }
    if (const Json* background = file.find("background")) {
      read_background(*background, file.path("background"));
    } else {
      scene_.background_is_sky =
          std::any_of(scene_.lights.begin(), scene_.lights.end(), [](const Light& light) {
            return std::holds_alternative<ImageSkyLight>(light) ||
                   std::holds_alternative<SunSkyLight>(light);
          });
    }
    find_focus(scene_, file.path("camera"), mistakes_);
    file.finish();
  }

 private:
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

  void read_camera(const Json& json, const JsonPath& path) {
    ObjectReader object(json, path, mistakes_);
    if (!object.is_object()) return;
    CameraDescription& camera = scene_.camera;
    const bool all_read = read_members(object, camera, meshes_);
    object.finish();
    check_lens(scene_.camera, json, path, mistakes_);
    if (!all_read) return;
    const Vec3<double> view = unit<double>(camera.look_at - camera.position);
    const Vec3<double> up = unit(camera.up);
    if (view.isZero()) {
      mistakes_.add(path / "look_at", "must not be the camera's position");
    } else if (up.isZero()) {
      mistakes_.add(path / "up", "must not be zero");
    } else if (!(view.cross(up).norm() > parallel_sine)) {
      mistakes_.add(path / "up", "must not be parallel to the direction of view");
    }
  }

  void read_light(const Json& json, const JsonPath& path) {
    ObjectReader object(json, path, mistakes_);
    double intensity = 1;
    if (const Json* factor = object.find("intensity")) {
      intensity =
          read_number(*factor, object.path("intensity"), mistakes_, Range::brightness).value_or(1);
    }
    auto light = read_tagged<Light>(
        object, "a light", [&](auto& kind) { return read_members(object, kind, meshes_); });
    if (!light) return;
    std::visit([&](auto& kind) { kind.scale(intensity); }, *light);
    const auto* directional = std::get_if<DirectionalLight>(&*light);
    if (directional && directional->direction.isZero(0)) {
      mistakes_.add(path / "direction", "must not be zero");
    }
    if (auto* day = std::get_if<SunSkyLight>(&*light)) find_sun(*day, json, path, mistakes_);
    scene_.lights.push_back(std::move(*light));
  }

  void read_material(const Json& json, const JsonPath& path) {
    ObjectReader object(json, path, mistakes_);
    std::string name;
    if (const Json* written = object.require("name", "the material's name")) {
      name = read_name(*written, object.path("name"));
    }
    Relief relief;
    if (read_members(object, relief, meshes_)) check_relief(relief, path, mistakes_);
    const RayKinds visible_to = read_visible_to(object);
    auto kind = read_tagged<MaterialKind>(
        object, "a material", [&](auto& made) { return read_members(object, made, meshes_); });
    if (kind) check_metal(*kind, path, mistakes_);
    if (kind) find_mixed(*kind, path);
    if (name.empty()) return;
    // A material with mistakes still takes its name and place, so that objects of it are no
    // mistakes, too.
    const auto index = static_cast<std::uint32_t>(scene_.materials.size());
    if (!material_index_.emplace(name, index).second) {
      mistakes_.add(path / "name", "must not be the name of two materials (got \"" +
                                       printable(name, 60) + "\" again)");
      return;
    }
    scene_.materials.push_back({name, kind.value_or(LambertMaterial()), relief, visible_to});
    check_visible(scene_, index, all_ray_kinds, object);
  }

  void find_mixed(MaterialKind& kind, const JsonPath& path) {
    auto* mix = std::get_if<MixMaterial>(&kind);
    for (std::size_t i = 0; mix && i < 2; ++i)
      mix->materials.indices[i] =
          read_material_name(Json((*mix->materials.names)[i]), path / "materials" / i);
  }

  void read_object(const Json& json, const JsonPath& path) {
    ObjectReader object(json, path, mistakes_);
    if (!object.is_object()) return;
    std::string name;
    if (const Json* written = object.require("name", "the object's name")) {
      name = read_name(*written, object.path("name"));
    }
    std::vector<Shape<double>> shapes;
    std::optional<HalfSpaceBody<double>> half_space;
    const Json* const split = object.find("split");
    std::shared_ptr<const TriangleMesh> mesh;
    const Json *const triangles = object.find("mesh"), *const heights = object.find("height_field");
    if (triangles || heights) {
      const std::string given = triangles ? "mesh" : "height_field";
      for (const char* other : {"shape", "split", "height_field"})
        if (given != other && object.find(other))
          mistakes_.add(object.path(other), "must not be given beside \"" + given + "\"");
      mesh = triangles ? read_mesh(*triangles, object.path(given), mistakes_, meshes_)
                       : read_height_field(*heights, object.path(given), mistakes_, meshes_);
    } else if (const Json* written =
                   object.require("shape", "a shape, \"mesh\" or \"height_field\"")) {
      if (split) {
        if (auto hulls = read_split_hulls(object, *split, *written, meshes_))
          shapes = std::move(*hulls);
      } else if (is_half_space(*written)) {
        half_space = read_half_space(*written, object.path("shape"), mistakes_);
      } else if (auto shape = read_shape(*written, object.path("shape"), mistakes_, meshes_)) {
        shapes.push_back(std::move(*shape));
      }
    }
    std::uint32_t material = 0;
    if (const Json* written = object.require("material", "the name of a material")) {
      material = read_material_name(*written, object.path("material"));
    }
    Affine<double> pose;
    if (const Json* written = object.find("transform")) {
      ObjectReader transform(*written, object.path("transform"), mistakes_);
      pose = read_affine(transform).value_or(Affine<double>());
      transform.finish();
    }
    std::optional<Motion> motion;
    if (const Json* written = object.find("keys"))
      motion = Motion{read_keys(*written, object.path("keys"), mistakes_), pose};
    const RayKinds visible_to = read_visible_to(object);
    check_visible(scene_, material, visible_to, object);
    object.finish();
    Object made{name, Point<double>(), pose, material, std::move(motion)};
    made.half_space = half_space;
    made.visible_to = visible_to;
    made.mesh = std::move(mesh);
    if (!made.has_shape()) scene_.objects.push_back(made);
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      if (split) made.name = name + "[" + std::to_string(i) + "]";
      made.shape = std::move(shapes[i]);
      scene_.objects.push_back(made);
    }
  }

  void read_particle_block(const Json& json, const JsonPath& path) {
    auto set = read_particles(
        json, path, mistakes_,
        {scene_, folder_, meshes_, particle_files_, pose_files_,
         most_instances - instance_count(scene_),
         [&](const Json& name, const JsonPath& at) { return read_material_name(name, at); }});
    if (set) scene_.particles.push_back(std::move(*set));
  }

  std::uint32_t read_material_name(const Json& json, const JsonPath& path) {
    const auto name = read_string(json, path, mistakes_);
    if (!name) return 0;
    const auto material = material_index_.find(*name);
    if (material != material_index_.end()) return material->second;
    std::vector<std::string> names;
    for (const Material& known : scene_.materials) names.push_back(printable(known.name, 60));
    mistakes_.add(path, "must be the name of a material (" + found(json) + "; " +
                            suggestion(*name, names) + ")");
    return 0;
  }

  std::string read_name(const Json& json, const JsonPath& path) {
    const auto name = read_string(json, path, mistakes_);
    if (name && name->empty()) mistakes_.add(path, "must not be empty");
    return name.value_or("");
  }

  /// One colour, or two.
  void read_background(const Json& json, const JsonPath& path) {
    if (json.is_object()) {
      ObjectReader object(json, path, mistakes_);
      read_members(object, scene_.background, meshes_);
      object.finish();
    } else if (!json.is_array()) {
      mistakes_.add(path,
                    "must be a colour (a list of 3 numbers) or an object with \"zenith\" "
                    "and \"nadir\" (" +
                        found(json) + ")");
    } else if (const auto colour = read_vector(json, path, mistakes_, Range::brightness)) {
      scene_.background = {*colour, *colour};
    }
  }

  Scene& scene_;
  std::filesystem::path folder_;
  Hash particle_files_;
  std::vector<std::filesystem::path> pose_files_;
  MeshFiles meshes_;
  Mistakes& mistakes_;
  std::map<std::string, std::uint32_t> material_index_;
};

}  // namespace

std::optional<Scene> parse_scene(std::string_view text, const std::filesystem::path& folder,
                                 Mistakes& mistakes,
                                 std::vector<std::filesystem::path>* other_files,
                                 ScenePurpose purpose) {
  const auto json = parse_json(text, mistakes);
  if (!json) return std::nullopt;
  Scene scene;
  SceneReader reader(scene, folder, mistakes);
  reader.read(*json, purpose);
  if (!mistakes.none()) return std::nullopt;
  set_time(scene, 0);
  Hash hash;
  hash.add(text);
  reader.add_files_to(hash);
  scene.hash = hash.text();
  scene.pictures = reader.pictures();
  if (other_files) *other_files = reader.other_files();
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
