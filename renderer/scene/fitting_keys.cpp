// SPDX-License-Identifier: MIT
#include "renderer/scene/fitting_keys.h"

#include <cmath>

#include "renderer/json/values.h"
#include "renderer/scene/sun_position.h"

namespace minkray {
namespace {

/// A round aperture looks the same as one with more blades.
constexpr int most_blades = 100;

/// A view direction and "up" are taken for parallel if the sine of their angle is below this: the
/// picture would turn by noise.
constexpr double parallel_sine = 1e-9;

bool is_along_view(const CameraDescription& camera) {
  const Vec3<double> view = unit<double>(camera.look_at - camera.position);
  return !(view.cross(unit(camera.up)).norm() > parallel_sine);
}

}  // namespace

void check_lens(const CameraDescription& camera, const Json& json, const JsonPath& path,
                Mistakes& mistakes) {
  const bool is_fisheye = camera.type.name == "fisheye" || camera.type.name == "equisolid";
  const Json* field = json.find("fov_y_degrees");
  if (field && (is_fisheye ? camera.fov_y_degrees > 360 : camera.fov_y_degrees >= 180))
    mistakes.add(path / "fov_y_degrees", std::string("must be > 0 and ") +
                                             (is_fisheye ? "<= 360" : "< 180") + " (" +
                                             found(*field) + ")");
  const bool is_whole = camera.blades == std::floor(camera.blades);
  if (!is_whole || (camera.blades > 0 && camera.blades < 3) || camera.blades > most_blades)
    mistakes.add(path / "blades", "must be 0 or a whole number from 3 to " +
                                      std::to_string(most_blades) + " (" +
                                      found(*json.find("blades")) + ")");
}

void choose_up(CameraDescription& camera) {
  if (!is_along_view(camera)) return;
  camera.up = {0, 1, 0};
  if (is_along_view(camera)) camera.up = {0, 0, 1};
}

void check_view(const CameraDescription& camera, const JsonPath& path, Mistakes& mistakes) {
  if (unit<double>(camera.look_at - camera.position).isZero())
    mistakes.add(path / "look_at", "must not be the camera's position");
  else if (unit(camera.up).isZero())
    mistakes.add(path / "up", "must not be zero");
  else if (is_along_view(camera))
    mistakes.add(path / "up",
                 "must not be parallel to the direction of view: choose another, such as " +
                     std::string(camera.up.y() == 0 ? "[0, 1, 0]" : "[0, 0, 1]"));
}

void find_sun(SunSkyLight& day, const Json& json, const JsonPath& path, Mistakes& mistakes) {
  const bool has_place = day.latitude_degrees && day.longitude_degrees;
  const bool has_any = !day.time.empty() || day.latitude_degrees || day.longitude_degrees;
  if ((json.find("sun") != nullptr) == has_any || (has_any && (day.time.empty() || !has_place))) {
    mistakes.add(path,
                 "must have either \"sun\" or all of \"time\", \"latitude_degrees\" and "
                 "\"longitude_degrees\"");
    return;
  }
  if (!has_any) {
    if (!(day.sun.z() > 0))
      mistakes.add(path / "sun", "must be above the horizon: its third number > 0");
    return;
  }
  if (std::abs(*day.latitude_degrees) > 90)
    mistakes.add(path / "latitude_degrees",
                 "must be from -90 to 90 (" + found(*json.find("latitude_degrees")) + ")");
  const std::optional<double> days = days_since_2000(day.time);
  if (!days) {
    mistakes.add(path / "time", "must be a time with its zone, such as 2026-06-21T09:30+02:00 (" +
                                    found(*json.find("time")) + ")");
    return;
  }
  day.sun = direction_of_sun(*days, *day.latitude_degrees, *day.longitude_degrees);
  if (!(day.sun.z() > 0))
    mistakes.add(path / "time", "must be in daytime: the sun is below the horizon (" +
                                    found(*json.find("time")) + ")");
  // Written as a direction, not as time and location.
  day.time.clear();
  day.latitude_degrees = day.longitude_degrees = std::nullopt;
}

void check_suns(const MemberKeys<Light>& keys, const JsonPath& path, Mistakes& mistakes) {
  for (std::size_t i = 0; i < keys.keys.size(); ++i) {
    const auto* day = std::get_if<SunSkyLight>(&keys.keys[i].values);
    if (day && !(day->sun.z() > 0))
      mistakes.add(path / i / "sun", "must be above the horizon: its third number > 0");
  }
}

void check_relief(const Relief& relief, const JsonPath& path, Mistakes& mistakes) {
  const auto is_picture = [](const Paint& paint) {
    return paint.texture() && std::holds_alternative<ImageTexture>(*paint.texture());
  };
  if (relief.bump && !relief.bump->texture())
    mistakes.add(path / "bump", "must be a texture (a constant colour has no bumps)");
  if (relief.normal_map && !is_picture(*relief.normal_map))
    mistakes.add(path / "normal_map", "must be a texture of type \"image\"");
}

void check_metal(const MaterialKind& kind, const JsonPath& path, Mistakes& mistakes) {
  const auto* conductor = std::get_if<ConductorMaterial>(&kind);
  if (conductor && conductor->metal.name.empty() != conductor->colour.has_value())
    mistakes.add(path, std::string("must have either \"metal\" or \"color\" (got ") +
                           (conductor->colour ? "both)" : "neither)"));
}

}  // namespace minkray
