// SPDX-License-Identifier: MIT
// Sweeps of a sensor over a scene.
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

/// Result of one ray; `object` is the number of the instance, -1 for none.
struct Echo {
  double t = std::numeric_limits<double>::infinity();  ///< in units of the direction's length
  double distance = std::numeric_limits<double>::infinity();
  Vec3<double> point = Vec3<double>::Constant(std::numeric_limits<double>::quiet_NaN());
  Vec3<double> normal = Vec3<double>::Zero();
  std::int32_t object = -1;
  double t_lo = std::numeric_limits<double>::infinity();
  double t_hi = std::numeric_limits<double>::infinity();
  std::uint8_t status = 1;  ///< 0 hit, 1 miss, 2 inside, 3 dropped out, 4 too near, 5 no ray
  double incidence = std::numeric_limits<double>::quiet_NaN();  ///< angle in radians from the
                                                                ///< normal
  double intensity = 0;  ///< reflectance cos(incidence) / distance^2, times the share of the beam
};

/// Order of a ray's echoes: nearest, brightest or farthest first.
enum class EchoOrder : unsigned char { first, strongest, last };

struct ScanOptions {
  Affine<double> pose;                ///< pose of the sensor, in its path's frame
  MovingFrame path;                   ///< path in the frame that the sensor is mounted on
  MovingFrame mount;                  ///< mount in the world
  double start = 0;                   ///< start of the sweep in seconds
  double range_noise = 0;             ///< standard deviation of distances
  double range_noise_per_length = 0;  ///< growth of range_noise with the distance
  double angle_noise = 0;             ///< standard deviation in radians
  double dropout = 0;                 ///< probability that a ray returns nothing
  std::uint64_t seed = 0;             ///< seed of noise and dropout, which depend on the ray's
                                      ///< number
  int returns = 1;                    ///< echoes per ray
  EchoOrder order = EchoOrder::first;
  double nearest = 0;  ///< nearer hits are not reported
  double farthest = std::numeric_limits<double>::infinity();
  /// Full angle of each beam, in radians. If 0, echoes are the bodies that a ray enters one after
  /// another. Otherwise they are the first hits of the beam's rays, joined where nearer than
  /// `resolution`.
  double divergence = 0;
  int beam_rays = 37;
  double resolution = 0.5;
};

struct Scan {
  std::vector<Echo> echoes;  ///< ray by ray, `returns` per ray
  QueryCounts counts;
  bool complete = true;
};

/// Returns the same bits for any number of threads and any split of the rays. If the scene or the
/// sensor moves, each ray is cast at its own time. `progress` returns false to stop.
Scan scan(const Scene& scene, const SensorRays& rays, const ScanOptions& options,
          const std::function<bool(double fraction, std::uint64_t rays)>& progress = {});

/// Pose of the object of that name; nothing if there is none.
std::optional<MovingFrame> frame_of_object(const Scene& scene, const std::string& name);

}  // namespace minkray
