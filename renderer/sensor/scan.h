// SPDX-License-Identifier: MIT
// Sweeps of a sensor over a scene: rays in, numbers out.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/math/affine.h"
#include "core/world/world.h"
#include "renderer/scene/moving_frame.h"
#include "renderer/scene/scene.h"
#include "renderer/sensor/sensor_rays.h"

namespace minkray {

/// What one ray met; `object` is the number of the instance, -1 for none.
struct Echo {
  double t = std::numeric_limits<double>::infinity();  ///< in lengths of the direction
  double distance = std::numeric_limits<double>::infinity();
  Vec3<double> point = Vec3<double>::Constant(std::numeric_limits<double>::quiet_NaN());
  Vec3<double> normal = Vec3<double>::Zero();
  std::int32_t object = -1;
  double t_lo = std::numeric_limits<double>::infinity();
  double t_hi = std::numeric_limits<double>::infinity();
  std::uint8_t status = 1;  ///< 0 hit, 1 miss, 2 inside, 3 dropped out, 4 too near, 5 no ray
  double incidence = std::numeric_limits<double>::quiet_NaN();  ///< radians from the normal
  double intensity = 0;  ///< reflectance cos(incidence) / distance^2, times the share of the beam
};

/// In which order the echoes of a ray are told: the nearest, the brightest, the farthest first.
enum class EchoOrder : unsigned char { first, strongest, last };

struct ScanOptions {
  Affine<double> pose;                ///< of the sensor, in its path's frame
  MovingFrame path;                   ///< in the frame that it is mounted on
  MovingFrame mount;                  ///< in the world
  double start = 0;                   ///< when the sweep begins, in seconds
  double range_noise = 0;             ///< standard deviation, of distances
  double range_noise_per_length = 0;  ///< what it grows by with the distance
  double angle_noise = 0;             ///< standard deviation, in radians
  double dropout = 0;                 ///< the chance that a ray answers nothing
  std::uint64_t seed = 0;             ///< of noise and dropout, which belong to the ray's number
  int returns = 1;                    ///< echoes of a ray
  EchoOrder order = EchoOrder::first;
  double nearest = 0;  ///< what is nearer is not reported
  double farthest = std::numeric_limits<double>::infinity();
  /// Full angle of each beam, in radians. Without it, echoes are the bodies behind each other that
  /// a ray enters; with it, what its rays meet first, joined where nearer than the resolution.
  double divergence = 0;
  int beam_rays = 37;
  double resolution = 0.5;
};

struct Scan {
  std::vector<Echo> echoes;  ///< ray by ray, `returns` of each
  QueryCounts counts;
  bool complete = true;
};

/// Gives the same bits for any number of threads and any cut of the rays. If the scene moves, each
/// ray is cast at its own time, and so it is if the sensor moves. `progress` may answer false to
/// stop.
Scan scan(const Scene& scene, const SensorRays& rays, const ScanOptions& options,
          const std::function<bool(double fraction, std::uint64_t rays)>& progress = {});

/// Where an object's shape stands, by its name; nothing if there is none of that name.
std::optional<MovingFrame> frame_of_object(const Scene& scene, const std::string& name);

}  // namespace minkray
