// SPDX-License-Identifier: MIT
// The camera of a scene file.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "core/math/vec.h"
#include "core/shape/field.h"
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

  static constexpr std::string_view doc = "Where the picture is taken from.";
  static constexpr auto fields() {
    using C = CameraDescription;
    return std::tuple{
        Field{"position", &C::position, Unit::length, Range::any, "where the camera is"},
        Field{"look_at", &C::look_at, Unit::length, Range::any, "what it points at"},
        Field{"up", &C::up, Unit::none, Range::any, "the direction that is up in the picture",
              true},
        Field{
            "fov_y_degrees", &C::fov_y_degrees, Unit::degrees, Range::positive,
            "the angle of view from the picture's lower to its upper edge: below 180, of fisheyes "
            "up to 360",
            true},
        Field{"resolution", &C::resolution, Unit::none, Range::any,
              "the picture's width and height in pixels", true},
        Field{"shutter", &C::shutter, Unit::none, Range::not_negative,
              "how many seconds the shutter is open: what moves meanwhile is blurred", true},
        Field{
            "type", &C::type, Unit::none, Range::any,
            "perspective if left out; orthographic: as large as perspective shows look_at; "
            "fisheye: angles as distances; equisolid: solid angles as areas; panorama: all around",
            true},
        Field{"aperture", &C::aperture, Unit::length, Range::not_negative,
              "the lens's diameter: what is not in focus is blurred", true},
        Field{"focus_distance", &C::focus_distance, Unit::length, Range::positive,
              "how far away it is sharp, along the camera's axis; at look_at if left out", true},
        Field{"focus_on", &C::focus_on, Unit::none, Range::any,
              "or the name of the object that is sharp", true},
        Field{"blades", &C::blades, Unit::none, Range::not_negative,
              "of the aperture, a whole number of at least 3: what is not in focus shows a polygon "
              "of "
              "so many corners; 0 for a round one",
              true}};
  }
};

}  // namespace minkray
