// SPDX-License-Identifier: MIT
// A scene as plain data: what a scene file says, with defaults filled in and names resolved.
// Lengths are in the scene's unit, directions need not be of unit length, colours are linear RGB.
// What a file may say is described by the `fields()`, as for shapes (core/shape/field.h).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/math/affine.h"
#include "core/math/vec.h"
#include "core/shape/field.h"
#include "core/shape/shape.h"
#include "core/world/half_space.h"
#include "renderer/scene/materials.h"
#include "renderer/scene/motion.h"
#include "renderer/scene/particles.h"

namespace minkray {

/// The largest width and height of a picture, so that its number of pixels fits an int.
inline constexpr int most_pixels_a_side = 32768;

struct Resolution {
  int width = 960;
  int height = 540;
};

struct CameraDescription {
  Vec3<double> position = {0, -5, 0};
  Vec3<double> look_at = {0, 0, 0};
  Vec3<double> up = {0, 0, 1};
  double fov_y_degrees = 40;
  Resolution resolution;
  double shutter = 0;  ///< in seconds

  static constexpr std::string_view doc = "Where the picture is taken from.";
  static constexpr auto fields() {
    using C = CameraDescription;
    return std::tuple{
        Field{"position", &C::position, Unit::length, Range::any, "where the camera is"},
        Field{"look_at", &C::look_at, Unit::length, Range::any, "what it points at"},
        Field{"up", &C::up, Unit::none, Range::any, "the direction that is up in the picture",
              true},
        Field{"fov_y_degrees", &C::fov_y_degrees, Unit::degrees, Range::zero_to_180,
              "the angle of view from the picture's lower to its upper edge", true},
        Field{"resolution", &C::resolution, Unit::none, Range::any,
              "the picture's width and height in pixels", true},
        Field{"shutter", &C::shutter, Unit::none, Range::not_negative,
              "how many seconds the shutter is open: what moves meanwhile is blurred", true}};
  }
};

/// Light that travels along `direction`, as from the sun; `colour` is the irradiance on a surface
/// that faces it.
struct DirectionalLight {
  Vec3<double> direction = {0, 0, -1};
  Colour colour = Colour::Ones();

  void scale(double intensity) { colour *= intensity; }

  static constexpr std::string_view name = "directional";
  static constexpr std::string_view doc = "Parallel light, as from the sun.";
  static constexpr auto fields() {
    using L = DirectionalLight;
    return std::tuple{
        Field{"direction", &L::direction, Unit::none, Range::any, "where the light travels to"},
        Field{"color", &L::colour, Unit::none, Range::not_negative,
              "the irradiance (linear RGB) on a surface that faces it", true}};
  }
};

/// Light from a point; `colour` is its radiant intensity, so that the irradiance falls off as
/// colour / distance^2.
struct PointLight {
  Vec3<double> position = Vec3<double>::Zero();
  Colour colour = Colour::Ones();

  void scale(double intensity) { colour *= intensity; }

  static constexpr std::string_view name = "point";
  static constexpr std::string_view doc = "Light from a point.";
  static constexpr auto fields() {
    using L = PointLight;
    return std::tuple{
        Field{"position", &L::position, Unit::length, Range::any, "where the light is"},
        Field{"color", &L::colour, Unit::none, Range::not_negative,
              "its radiant intensity (linear RGB): the irradiance at distance 1", true}};
  }
};

/// Light from all around: the radiance from straight up and from straight down, blended by height.
struct EnvironmentLight {
  Colour zenith = Colour::Ones();
  Colour nadir = Colour::Ones();

  void scale(double intensity) {
    zenith *= intensity;
    nadir *= intensity;
  }

  static constexpr std::string_view name = "environment";
  static constexpr std::string_view doc = "Light from all around, as from the sky.";
  static constexpr auto fields() {
    using L = EnvironmentLight;
    return std::tuple{Field{"zenith", &L::zenith, Unit::none, Range::not_negative,
                            "the radiance (linear RGB) from straight up"},
                      Field{"nadir", &L::nadir, Unit::none, Range::not_negative,
                            "the radiance from straight down"}};
  }
};

using Light = std::variant<DirectionalLight, PointLight, EnvironmentLight>;

struct Object {
  std::string name;
  Shape<double> shape = Point<double>();
  Affine<double> pose;                        ///< from the shape's frame to the world
  std::uint32_t material = 0;                 ///< index into Scene::materials
  std::optional<Motion> motion = {};          ///< `pose` is what it is at the scene's time
  Vec3<double> shift = Vec3<double>::Zero();  ///< how far it goes while the shutter is open
  std::optional<HalfSpaceBody<double>> half_space =
      {};  ///< if there is one it is that, not `shape`
};

/// What "type" says in the place of a shape's name for a half-space, which is none.
inline constexpr std::string_view half_space_name = "plane";

/// What a ray sees that meets nothing: a vertical gradient.
struct Background {
  Colour zenith = Colour::Constant(1);
  Colour nadir = Colour::Constant(1);

  static constexpr std::string_view doc = "What a ray sees that meets nothing.";
  static constexpr auto fields() {
    using B = Background;
    return std::tuple{
        Field{"zenith", &B::zenith, Unit::none, Range::not_negative,
              "the radiance (linear RGB) straight up"},
        Field{"nadir", &B::nadir, Unit::none, Range::not_negative, "the radiance straight down"}};
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
  bool labels = false;  ///< whether the objects' names are drawn into the picture
  std::string hash;     ///< of the file it came from and of all files it names; or empty
  double time = 0;      ///< when the shutter opens, in seconds
};

/// Whether any object has keys.
bool moves(const Scene& scene);

/// Puts all objects where they are at that time, in seconds. While the shutter is open objects go
/// straight on and do not turn.
void set_time(Scene& scene, double time);

}  // namespace minkray
