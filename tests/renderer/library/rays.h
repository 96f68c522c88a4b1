// SPDX-License-Identifier: MIT
// Rays for the tests of the library, which see nothing but its public headers.
#pragma once

#include <minkray/minkray.h>

#include <cmath>
#include <random>
#include <vector>

/// From all around a ball, towards points within it: about half of them meet what fills it half.
inline std::vector<minkray::Ray> rays_around(const minkray::Vec3& centre, double radius,
                                             std::size_t count, unsigned seed = 1) {
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return double(random() >> 11) * 0x1p-52 - 1; };
  const auto in_ball = [&]() -> minkray::Vec3 {
    for (;;) {
      const minkray::Vec3 p = {uniform(), uniform(), uniform()};
      if (p.x * p.x + p.y * p.y + p.z * p.z <= 1) return p;
    }
  };
  std::vector<minkray::Ray> rays;
  while (rays.size() < count) {
    const minkray::Vec3 from = in_ball(), to = in_ball();
    const double length = std::sqrt(from.x * from.x + from.y * from.y + from.z * from.z);
    const double far = 4 * radius / length;
    const minkray::Vec3 origin = {centre.x + far * from.x, centre.y + far * from.y,
                                  centre.z + far * from.z};
    const double scale = 0.2 + 0.1 * double(rays.size() % 20);
    rays.push_back({origin,
                    {scale * (centre.x + 0.7 * radius * to.x - origin.x),
                     scale * (centre.y + 0.7 * radius * to.y - origin.y),
                     scale * (centre.z + 0.7 * radius * to.z - origin.z)}});
  }
  return rays;
}
