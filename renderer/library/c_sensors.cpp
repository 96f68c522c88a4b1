// SPDX-License-Identifier: MIT
// The function of the C interface that makes a lidar's rays.
#include "renderer/library/call.h"
#include "renderer/library/poses.h"
#include "renderer/sensor/sensor_rays.h"

using namespace minkray;

extern "C" int minkray_lidar_rays(const char* pattern, const minkray_pose* pose, minkray_ray* rays,
                                  size_t size, size_t* needed) {
  return call("minkray_lidar_rays", [&] {
    require(pattern, "pattern");
    if (size > 0) require(rays, "rays");
    const Affine<double> sensor = pose_of(pose, "pose");
    constexpr double turn = 0.1;  // of most lidars; times are not returned
    const std::vector<SensorRay> read = rays_of_pattern(pattern, turn).rays;
    if (needed) *needed = read.size();
    for (size_t i = 0; i < std::min(size, read.size()); ++i) {
      const Vec3<double> direction = sensor.linear * read[i].ray.direction;
      for (int k = 0; k < 3; ++k) {
        rays[i].origin[k] = sensor.translation[k];
        rays[i].direction[k] = direction[k];
      }
      rays[i].t_max = read[i].ray.t_max;
    }
  });
}
