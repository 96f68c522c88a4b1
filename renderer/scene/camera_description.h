// SPDX-License-Identifier: MIT
// The camera of a scene file.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "core/math/vec.h"
#include "core/support/field.h"
#include "renderer/scene/named.h"

namespace minkray {

class CalibratedCamera;

/// The largest width and height of a picture, so that its number of pixels fits an int.
inline constexpr int most_pixels_a_side = 32768;

struct Resolution {
  int width = 960;
  int height = 540;
};

struct CameraTypes {
  static constexpr std::string_view what = "a camera";
  static constexpr std::array<std::string_view, 5> names = {"perspective", "orthographic",
                                                            "fisheye", "equisolid", "panorama"};
};
using CameraType = NameOf<CameraTypes>;

struct CameraDescription {
  Vec3<double> position = {0, -5, 0};
  Vec3<double> look_at = {0, 0, 0};
  Vec3<double> up = {0, 0, 1};
  double fov_y_degrees = 40;
  Resolution resolution;
  double shutter = 0;  ///< in seconds
  CameraType type = {"perspective"};
  double aperture = 0;
  std::optional<double> focus_distance = {};
  std::string focus_on = {};
  double blades = 0;  ///< a whole number: 0 or at least 3
  /// Not a key: the lens of a camera file, instead of type and fov_y_degrees.
  std::shared_ptr<const CalibratedCamera> calibration = {};
  /// Not a key: how far away it is sharp, along the camera's axis; 0: at look_at.
  double focus = 0;

  static constexpr std::string_view doc = "The camera of the picture.";
  static constexpr auto fields() {
    using C = CameraDescription;
    return std::tuple{
        Field{"position", &C::position, Unit::length, Range::any, "the camera's position"},
        Field{"look_at", &C::look_at, Unit::length, Range::any, "the point that it looks at"},
        Field{"up", &C::up, Unit::none, Range::any, "the direction that is up in the picture",
              true},
        Field{"fov_y_degrees", &C::fov_y_degrees, Unit::degrees, Range::positive,
              "the vertical angle of view: below 180, for fisheyes up to 360", true},
        Field{"resolution", &C::resolution, Unit::none, Range::any,
              "the picture's width and height in pixels", true},
        Field{"shutter", &C::shutter, Unit::none, Range::not_negative,
              "the exposure time in seconds; moving objects are blurred", true},
        Field{"type", &C::type, Unit::none, Range::any,
              "perspective by default; orthographic: with perspective's scale at look_at; fisheye: "
              "equidistant; equisolid: equal solid angles; panorama: the whole sphere",
              true},
        Field{"aperture", &C::aperture, Unit::length, Range::not_negative,
              "the lens's diameter; objects out of focus are blurred", true},
        Field{"focus_distance", &C::focus_distance, Unit::length, Range::positive,
              "the distance in focus, along the camera's axis; by default that of look_at", true},
        Field{"focus_on", &C::focus_on, Unit::none, Range::any,
              "or the name of the object in focus", true},
        Field{"blades", &C::blades, Unit::none, Range::not_negative,
              "the number of aperture blades, at least 3: highlights out of focus are polygons "
              "with this many corners; 0: round",
              true}};
  }
};

}  // namespace minkray
