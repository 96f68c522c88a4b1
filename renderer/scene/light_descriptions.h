// SPDX-License-Identifier: MIT
// Lights of scene files: one struct per light; the list of all is at the end.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "core/math/vec.h"
#include "core/support/field.h"
#include "renderer/scene/textures.h"

namespace minkray {

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
    return std::tuple{Field{"direction", &L::direction, Unit::none, Range::any,
                            "the direction in which the light travels"},
                      Field{"color", &L::colour, Unit::none, Range::brightness,
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
        Field{"position", &L::position, Unit::length, Range::any, "the light's position"},
        Field{"color", &L::colour, Unit::none, Range::brightness,
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
  static constexpr std::string_view doc = "Environment light, as from the sky.";
  static constexpr auto fields() {
    using L = EnvironmentLight;
    return std::tuple{Field{"zenith", &L::zenith, Unit::none, Range::brightness,
                            "the radiance (linear RGB) from straight up"},
                      Field{"nadir", &L::nadir, Unit::none, Range::brightness,
                            "the radiance from straight down"}};
  }
};

/// Environment light given by a picture of the whole sphere. Shares its "type" with the plain
/// EnvironmentLight; the key of the file distinguishes them.
struct ImageSkyLight {
  PictureFile picture;
  double rotate_degrees = 0;
  double strength = 1;  ///< not a key of its own: the light's intensity

  void scale(double intensity) { strength *= intensity; }

  static constexpr std::string_view name = "environment";
  static constexpr std::string_view told_by = "file";
  static constexpr std::string_view doc = "Environment light from a picture.";
  static constexpr auto fields() {
    using L = ImageSkyLight;
    return std::tuple{Field{"file", &L::picture, Unit::none, Range::any,
                            "a picture of the whole sphere (longitude by latitude): its middle "
                            "towards +y, +x to the right"},
                      Field{"rotate_degrees", &L::rotate_degrees, Unit::degrees, Range::any,
                            "counter-clockwise rotation seen from above", true}};
  }
};

/// Clear sky with the sun. The sun is given by its direction, or by time and location, which the
/// reader converts to a direction.
struct SunSkyLight {
  Vec3<double> sun = {0, -1, 1};
  std::string time = {};
  std::optional<double> latitude_degrees = {}, longitude_degrees = {};
  double turbidity = 3;
  Colour ground = Colour::Constant(0.1);
  double strength = 1;

  void scale(double intensity) { strength *= intensity; }

  static constexpr std::string_view name = "sun_sky";
  static constexpr std::string_view doc = "Clear sky with the sun (Preetham et al. 1999).";
  static constexpr auto fields() {
    using L = SunSkyLight;
    return std::tuple{
        Field{"sun", &L::sun, Unit::none, Range::any,
              "the direction towards the sun, above the horizon", true},
        Field{"time", &L::time, Unit::none, Range::any,
              "instead of the direction: date and time, such as 2026-06-21T09:30+02:00 or "
              "2026-06-21T07:30Z; +x is east and +y is north",
              true},
        Field{"latitude_degrees", &L::latitude_degrees, Unit::degrees, Range::any,
              "with the time: the latitude, positive in the north", true},
        Field{"longitude_degrees", &L::longitude_degrees, Unit::degrees, Range::any,
              "with the time: the longitude, positive in the east", true},
        Field{"turbidity", &L::turbidity, Unit::none, Range::at_least_one,
              "the haze: 2 very clear, 10 misty", true},
        Field{"ground", &L::ground, Unit::none, Range::brightness,
              "the radiance (linear RGB) from below the horizon", true}};
  }
};

/// Values of "type" for lights. If two share a name, the one that needs a key (`told_by`) comes
/// first.
using Light =
    std::variant<DirectionalLight, PointLight, ImageSkyLight, EnvironmentLight, SunSkyLight>;

}  // namespace minkray
