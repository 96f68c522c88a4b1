// SPDX-License-Identifier: MIT
#include "rays.h"

#include <numbers>
#include <utility>

#include "random.h"

namespace bench {
namespace {

Vec as_floats(const Vec& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

mk::Ray ray_of(const Vec& origin, const Vec& direction) {
  return {as_floats(origin), as_floats(direction)};
}

/// Above the surface by more than any mesh is below it, and by far less than the objects' size.
Vec above(const Subject& subject, const mk::Hit& hit) {
  return Vec(hit.point) + 1e-3 * subject.least_radius() * Vec(hit.normal);
}

}  // namespace

std::vector<mk::Ray> camera_rays(const Subject& subject, int side) {
  const double away = subject.half_size + 1;
  const Vec eye = away * Vec(1.9, -3.3, 2.2), target = away * Vec(0, 0, -0.1);
  const Vec ahead = normalized(target - eye), right = normalized(cross(ahead, {0, 0, 1})),
            up = cross(right, ahead);
  const double reach = std::tan(18 * std::numbers::pi / 180);  // half the angle of view
  Random random(2);
  std::vector<mk::Ray> rays;
  for (int y = 0; y < side; y += 8)
    for (int x = 0; x < side; x += 8)
      for (int i = 0; i < 64; ++i) {
        const int column = x + i % 4 + i / 8 % 2 * 4, row = y + i / 4 % 2 + i / 16 * 2;
        const double u = 2 * (column + random.within(0, 1)) / side - 1,
                     v = 1 - 2 * (row + random.within(0, 1)) / side;
        rays.push_back(ray_of(eye, normalized(ahead + reach * u * right + reach * v * up)));
      }
  return rays;
}

std::vector<mk::Ray> scattered_rays(const Subject& subject, const std::vector<mk::Ray>& rays,
                                    const std::vector<mk::Hit>& hits, std::size_t count) {
  Random random(1);
  std::vector<mk::Ray> scattered;
  std::size_t found = 1;
  while (scattered.size() < count && found > 0) {
    found = 0;
    for (std::size_t i = 0; i < rays.size() && scattered.size() < count; ++i) {
      if (hits[i].status != mk::hit) continue;
      ++found;
      // A point of the unit sphere that touches the surface; the factor keeps it from the origin.
      const Vec direction = normalized(Vec(hits[i].normal) + 0.9999 * random.direction());
      scattered.push_back(ray_of(above(subject, hits[i]), direction));
    }
  }
  for (std::size_t i = scattered.size(); i > 1; --i)
    std::swap(scattered[i - 1], scattered[random.bits() % i]);
  return scattered;
}

std::vector<mk::Ray> light_rays(const Subject& subject, const std::vector<mk::Ray>& rays,
                                const std::vector<mk::Hit>& hits) {
  const Vec light = normalized(Vec(0.3, -1, 1.4));
  std::vector<mk::Ray> towards;
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (hits[i].status == mk::hit && dot(hits[i].normal, light) > 0)
      towards.push_back(ray_of(above(subject, hits[i]), light));
  return towards;
}

}  // namespace bench
