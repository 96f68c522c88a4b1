// SPDX-License-Identifier: MIT
// A scene as plain data: the contents of a scene file with defaults filled in and names resolved.
// Lengths are in the scene's unit. Directions need not have unit length. Colours are linear RGB.
// `fields()` describes the keys of a file, as for shapes (core/support/field.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/math/affine.h"
#include "core/math/vec.h"
#include "core/shape/shape.h"
#include "core/support/field.h"
#include "core/world/half_space.h"
#include "renderer/scene/camera_description.h"
#include "renderer/scene/light_descriptions.h"
#include "renderer/scene/materials.h"
#include "renderer/scene/member_keys.h"
#include "renderer/scene/motion.h"
#include "renderer/scene/particles.h"

namespace minkray {

class Compound;
class ShapeDefinition;
class TriangleMesh;
struct MeshAttributes;

/// Attributes of an object's mesh in pictures; rays and contacts need none.
struct MeshLook {
  std::shared_ptr<const MeshAttributes> attributes;
  /// Indices into Scene::materials by the attributes' numbers; triangles without a number have the
  /// object's material.
  std::vector<std::uint32_t> materials = {};
};

struct Object {
  std::string name;
  Shape shape = Point();
  Affine<double> pose;                ///< from the shape's frame to the world
  std::uint32_t material = 0;         ///< index into Scene::materials
  std::optional<Motion> motion = {};  ///< `pose` is what it is at the scene's time
  Movement<double> movement = {};     ///< motion while the shutter is open
  std::optional<HalfSpaceBody<double>> half_space =
      {};                                         ///< if there is one it is that, not `shape`
  std::shared_ptr<const TriangleMesh> mesh = {};  ///< the same
  std::shared_ptr<const Compound> compound = {};  ///< the same; only a library's scenes have them
  RayKinds visible_to = all_ray_kinds;  ///< and to no rays that its material is not visible to
  std::shared_ptr<const ShapeDefinition> definition = {};  ///< of the shape, if shared
  std::shared_ptr<const MeshLook> look = {};               ///< of the mesh, if it has one

  /// Not a half-space, mesh or compound.
  bool has_shape() const { return !half_space && !mesh && !compound; }
};

/// "type" of a half-space, used like a shape's name.
inline constexpr std::string_view half_space_name = "plane";

/// Name of a mesh, used like a shape's name.
inline constexpr std::string_view mesh_name = "mesh";

/// Colour of rays that hit nothing: a vertical gradient.
struct Background {
  Colour zenith = Colour::Constant(1);
  Colour nadir = Colour::Constant(1);

  static constexpr std::string_view doc = "Colour of rays that hit nothing.";
  static constexpr auto fields() {
    using B = Background;
    return std::tuple{
        Field{"zenith", &B::zenith, Unit::none, Range::brightness,
              "the radiance (linear RGB) straight up"},
        Field{"nadir", &B::nadir, Unit::none, Range::brightness, "the radiance straight down"}};
  }
};

struct Scene {
  std::string description;
  CameraDescription camera;
  std::vector<Light> lights;
  std::vector<Material> materials;
  std::vector<Object> objects;
  std::vector<ParticleSet> particles;
  Background background;
  /// True if cameras see the environment light instead: the scene has a picture of the sky and no
  /// background.
  bool background_is_sky = false;
  bool labels = false;  ///< true to draw the objects' names into the picture
  std::string hash;     ///< of the file it came from and of all files it names; or empty
  double time = 0;      ///< when the shutter opens, in seconds
  /// Cameras, lights and materials with keys: those above are what they are at the scene's time.
  std::optional<MemberKeys<CameraDescription>> camera_keys;
  std::vector<KeysOf<Light>> light_keys;
  std::vector<KeysOf<MaterialKind>> material_keys;
  bool camera_is_framed = false;    ///< true if placed by framing, not by a file
  bool lights_are_default = false;  ///< true if no file has lights
  /// The files of its textures and skies: no picture of it may take the place of one.
  std::vector<std::filesystem::path> pictures;
};

/// True if any object has keys.
bool moves(const Scene& scene);

/// Makes the scene what it is at that time, in seconds. While the shutter is open the camera, the
/// lights and the materials stay as they are. Throws BadInput if the camera then has no direction.
void set_time(Scene& scene, double time);

}  // namespace minkray
