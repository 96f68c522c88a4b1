// SPDX-License-Identifier: MIT
#include "renderer/sensor/beam.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "renderer/sensor/ray_directions.h"

namespace minkray {
namespace {

/// Joins the hits of one echo.
Met joined(std::span<const Met> hits) {
  Met echo = *std::ranges::max_element(hits, {}, &Met::intensity);
  double intensity = 0, weights = 0, t = 0, distance = 0;
  for (const Met& hit : hits) intensity += hit.intensity;
  for (const Met& hit : hits) {
    const double weight = intensity > 0 ? hit.intensity : 1;  // if all hits are black, they count
                                                              // equally
    weights += weight;
    t += weight * hit.t;
    distance += weight * hit.distance;
    echo.t_lo = std::min(echo.t_lo, hit.t_lo);
    echo.t_hi = std::max(echo.t_hi, hit.t_hi);
  }
  echo.intensity = intensity;
  echo.t = t / weights;
  echo.distance = distance / weights;
  return echo;
}

}  // namespace

std::vector<Vec3<double>> directions_of_beam(const Vec3<double>& direction, double full_angle,
                                             int count) {
  if (count == 1 || full_angle == 0) return {direction};
  const Vec3<double> along = unit(direction);
  const auto [u, v] = across(along);
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  std::vector<Vec3<double>> directions;
  for (int k = 0; k < count; ++k) {
    const double radius = std::tan(full_angle / 2) * std::sqrt((k + 0.5) / count);
    const double angle = k * golden_angle;
    directions.push_back(direction.norm() * unit<double>(along + radius * std::cos(angle) * u +
                                                         radius * std::sin(angle) * v));
  }
  return directions;
}

std::vector<Met> echoes_of(std::vector<Met> met, double resolution) {
  std::ranges::stable_sort(met, {}, &Met::distance);
  std::vector<Met> echoes;
  for (std::size_t begin = 0, end = 0; begin < met.size(); begin = end) {
    for (end = begin + 1;
         end < met.size() && met[end].distance - met[end - 1].distance < resolution; ++end) {
    }
    echoes.push_back(joined(std::span(met).subspan(begin, end - begin)));
  }
  return echoes;
}

}  // namespace minkray
