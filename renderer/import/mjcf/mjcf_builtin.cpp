// SPDX-License-Identifier: MIT
#include "renderer/import/mjcf/mjcf_builtin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace minkray {
namespace {

using Points = std::vector<Vec3<double>>;
constexpr double pi = std::numbers::pi;

/// Rings of a supersphere or supertorus: a million vertices are enough.
constexpr double most_rings = 1000;
constexpr double most_corners = 100'000;

[[noreturn]] void wrong(const std::string& name, const std::string& expected) {
  throw std::runtime_error("params: of a builtin " + name + " must be " + expected);
}

/// Powers that keep the sign.
double power_of_cosine(double angle, double exponent) {
  return std::copysign(std::pow(std::abs(std::cos(angle)), exponent), std::cos(angle));
}
double power_of_sine(double angle, double exponent) {
  return std::copysign(std::pow(std::abs(std::sin(angle)), exponent), std::sin(angle));
}

/// An icosahedron whose triangles are each cut into four, `times` times.
Points sphere(int times) {
  const double phi = (1 + std::sqrt(5.0)) / 2;
  Points points = {{-1, phi, 0}, {1, phi, 0}, {-1, -phi, 0}, {1, -phi, 0},
                   {0, -1, phi}, {0, 1, phi}, {0, -1, -phi}, {0, 1, -phi},
                   {phi, 0, -1}, {phi, 0, 1}, {-phi, 0, -1}, {-phi, 0, 1}};
  for (Vec3<double>& point : points) point = unit(point);
  std::vector<std::array<std::size_t, 3>> faces = {
      {0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int i = 0; i < times; ++i) {
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> middles;
    const auto middle = [&](std::size_t a, std::size_t b) {
      const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), points.size());
      if (is_new) points.push_back(unit<double>((points[a] + points[b]) / 2));
      return at->second;
    };
    std::vector<std::array<std::size_t, 3>> smaller;
    for (const auto& [a, b, c] : faces) {
      const std::size_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      smaller.insert(smaller.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    faces = std::move(smaller);
  }
  return points;
}

/// Rows of an octahedron's upper half, on the unit sphere.
Points hemisphere(int resolution) {
  const std::array<Vec3<double>, 4> equator = {{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}};
  const Vec3<double> pole(0, 0, 1);
  Points points = {pole};
  for (int row = 0; row <= resolution; ++row)
    for (std::size_t side = 0; side < 4; ++side) {
      const double down = double(row + 1) / (resolution + 1);
      const Vec3<double> start = pole + down * (equator[side] - pole),
                         end = pole + down * (equator[(side + 1) % 4] - pole);
      for (int i = 0; i <= row; ++i)
        points.push_back(unit<double>(start + i * ((end - start) / (row + 1))));
    }
  return points;
}

Points supersphere(int resolution, double e, double n) {
  Points points = {{0, 0, -1}, {0, 0, 1}};
  for (int i = 1; i < resolution; ++i)
    for (int j = 0; j < resolution; ++j) {
      const double v = -pi / 2 + i * pi / resolution, u = -pi + j * 2 * pi / resolution;
      points.emplace_back(power_of_cosine(v, n) * power_of_cosine(u, e),
                          power_of_cosine(v, n) * power_of_sine(u, e), power_of_sine(v, n));
    }
  return points;
}

Points supertorus(int resolution, double radius, double s, double t) {
  Points points;
  for (int i = 0; i < resolution; ++i)
    for (int j = 0; j < resolution; ++j) {
      const double u = 2 * pi * i / resolution, v = 2 * pi * j / resolution;
      const double out = 1 + radius * power_of_cosine(v, s);
      points.emplace_back(out * power_of_cosine(u, t), out * power_of_sine(u, t),
                          radius * power_of_sine(v, s));
    }
  return points;
}

/// A prism if the radius at the top is 1.
Points cone(int corners, double radius) {
  Points points;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * i * pi / corners;
    points.emplace_back(std::cos(angle), std::sin(angle), -1);
    if (radius > 0) points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 1);
  }
  if (!(radius > 0)) points.emplace_back(0, 0, 1);
  return points;
}

Points plate(int across, int along) {
  Points points;
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < along; ++j)
      points.emplace_back(-1 + (i + 0.5) * 2 / across, -1 + (j + 0.5) * 2 / along, -1);
  return points;
}

}  // namespace

std::vector<Vec3<double>> builtin_mesh(const std::string& name, std::span<const double> params) {
  const auto count = [&](std::size_t i, double least, double most) {
    return i < params.size() && params[i] >= least && params[i] <= most;
  };
  const auto whole = [&](std::size_t i) { return static_cast<int>(params[i]); };
  Points points;
  if (name == "sphere") {
    if (params.size() != 1 || !count(0, 0, 4)) wrong(name, "a subdivision from 0 to 4");
    points = sphere(whole(0));
  } else if (name == "hemisphere") {
    if (params.size() != 1 || !count(0, 0, 10)) wrong(name, "a resolution from 0 to 10");
    points = hemisphere(whole(0));
  } else if (name == "supersphere") {
    if (params.size() != 3 || !count(0, 3, most_rings) || params[1] < 0 || params[2] < 0)
      wrong(name, "a resolution from 3 to 1000 and two exponents >= 0");
    points = supersphere(whole(0), params[1], params[2]);
  } else if (name == "supertorus") {
    if (params.size() != 4 || !count(0, 3, most_rings) || !(params[1] > 0 && params[1] <= 1) ||
        !(params[2] > 0) || !(params[3] > 0))
      wrong(name, "a resolution from 3 to 1000, a radius in (0, 1] and two exponents > 0");
    points = supertorus(whole(0), params[1], params[2], params[3]);
  } else if (name == "cone") {
    if (params.size() != 2 || !count(0, 3, most_corners) || params[1] < 0)
      wrong(name, "at least 3 corners and a top radius >= 0");
    points = cone(whole(0), params[1]);
  } else if (name == "plate") {
    if (params.size() != 2 || !count(0, 1, most_rings) || !count(1, 1, most_rings))
      wrong(name, "two resolutions from 1 to 1000");
    points = plate(whole(0), whole(1));
  } else {
    throw std::runtime_error(
        "builtin: must be one of sphere, hemisphere, supersphere, supertorus, cone and plate");
  }
  for (Vec3<double>& point : points)
    for (int i = 0; i < 3; ++i) point[i] = static_cast<float>(point[i]);
  return points;
}

}  // namespace minkray
