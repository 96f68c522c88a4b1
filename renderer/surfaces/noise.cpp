// SPDX-License-Identifier: MIT
#include "renderer/surfaces/noise.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "renderer/rays/sampler.h"

namespace minkray {
namespace {

constexpr int octaves = 6;

/// One of twelve directions to the middles of a cube's edges, by a hash of the corner.
double towards_edge(int x, int y, int z, const Vec3<double>& offset) {
  const auto bits = [](int i) { return static_cast<std::uint64_t>(static_cast<std::uint32_t>(i)); };
  const std::uint64_t hash =
      detail::mixed(detail::mixed(bits(x) << 32 | bits(y)) ^ bits(z) * 0x9e3779b97f4a7c15u);
  const auto edge = static_cast<unsigned>(hash % 12);
  const int zero = static_cast<int>(edge / 4);
  const double first = offset[(zero + 1) % 3], second = offset[(zero + 2) % 3];
  return (edge & 1 ? -first : first) + (edge & 2 ? -second : second);
}

double smooth(double t) {
  return t * t * t * (t * (6 * t - 15) + 10);
}

}  // namespace

double gradient_noise(const Vec3<double>& at) {
  const Vec3<double> floor(std::floor(at.x()), std::floor(at.y()), std::floor(at.z()));
  const Vec3<double> f = at - floor;
  // Beyond the whole numbers of an int there is no detail left.
  if (!(floor.cwiseAbs().maxCoeff() < 1e9)) return 0;
  const Eigen::Vector3i cell = floor.cast<int>();
  const Vec3<double> s(smooth(f.x()), smooth(f.y()), smooth(f.z()));
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int dx = corner & 1, dy = corner >> 1 & 1, dz = corner >> 2;
    const double weight =
        (dx ? s.x() : 1 - s.x()) * (dy ? s.y() : 1 - s.y()) * (dz ? s.z() : 1 - s.z());
    sum += weight *
           towards_edge(cell.x() + dx, cell.y() + dy, cell.z() + dz, f - Vec3<double>(dx, dy, dz));
  }
  return sum;
}

double faded(double width) {
  // Factor nearest to the mean over squares of that width, measured for widths of 0.1 to 4 cells;
  // a hundredth of it is not visible.
  constexpr double steepness = 0.53, least = 0.01;
  const double left = std::exp(-steepness * width * width);
  return left > least ? left : 0;
}

double fractal_noise(const Vec3<double>& at, double width) {
  double sum = 0, strength = 1, fineness = 1;
  for (int i = 0; i < octaves; ++i, strength /= 2, fineness *= 2) {
    const double left = faded(fineness * width);
    if (!(left > 0)) break;
    sum += strength * left * gradient_noise(fineness * at + Vec3<double>::Constant(0.37 * i));
  }
  return sum;
}

double fractal_range(double width) {
  // All octaves are equally steep, about 1, and no more than strong; they are independent.
  double squares = 0, strength = 1;
  for (int i = 0; i < octaves; ++i, strength /= 2) {
    const double range = std::min(width, strength);
    squares += range * range;
  }
  return std::sqrt(squares);
}

}  // namespace minkray
