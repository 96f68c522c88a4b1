// SPDX-License-Identifier: MIT
// C interface: rays of lidars and cameras.
#include <string>

#include "renderer/base/errors.h"
#include "renderer/library/handles/call.h"
#include "renderer/library/handles/poses.h"
#include "renderer/sensor/sensor_rays.h"

using namespace minkray;

namespace {

/// Writes as many as there is room for, in the world.
void give(const std::vector<SensorRay>& read, const Affine<double>& sensor, minkray_ray* rays,
          size_t size, size_t* needed) {
  if (needed) *needed = read.size();
  for (size_t i = 0; i < std::min(size, read.size()); ++i) {
    const Vec3<double> origin = sensor(read[i].ray.origin);
    const Vec3<double> direction = sensor.linear * read[i].ray.direction;
    for (int k = 0; k < 3; ++k) {
      rays[i].origin[k] = origin[k];
      rays[i].direction[k] = direction[k];
    }
    rays[i].t_max = read[i].ray.t_max;
  }
}

}  // namespace

extern "C" int minkray_lidar_rays(const char* pattern, const minkray_pose* pose, minkray_ray* rays,
                                  size_t size, size_t* needed) {
  return call("minkray_lidar_rays", [&] {
    require(pattern, "pattern");
    if (size > 0) require(rays, "rays");
    const Affine<double> sensor = pose_of(pose, "pose");
    constexpr double turn = 0.1;  // of most lidars; times are not returned
    try {
      give(rays_of_pattern(pattern, turn).rays, sensor, rays, size, needed);
    } catch (const WrongUsage& error) {
      const std::string text = error.what();
      wrong_use(text.starts_with("--") ? text.substr(2) : text);  // the name of an option
    }
  });
}

extern "C" int minkray_camera_rays(const char* camera, const minkray_pose* pose, minkray_ray* rays,
                                   size_t size, size_t* needed) {
  return call("minkray_camera_rays", [&] {
    require(camera, "camera");
    if (size > 0) require(rays, "rays");
    const Affine<double> sensor = pose_of(pose, "pose");
    const SensorRays made = rays_of_camera(parse_calibrated_camera(camera, "camera"), "camera");
    give(made.rays, sensor, rays, size, needed);
  });
}
