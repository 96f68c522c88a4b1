// SPDX-License-Identifier: MIT
#include "renderer/light/texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "renderer/light/sampler.h"

namespace minkray {
namespace {

using std::numbers::pi;

/// Textures in space are asked so deep below the surface, in repeats: a face that lies just where
/// two fields meet is not speckled by rounding.
constexpr double below_surface = 1e-6;

Colour blend(const TwoColours& colours, double part_of_b) {
  return colours.a + std::clamp(part_of_b, 0.0, 1.0) * (colours.b - colours.a);
}

/// Where the surface faces x, y or z most, the other two; upright sides have z downwards.
Vec3<double> of_box(const TexturePoint& at) {
  const Vec3<double>& p = at.position;
  int axis = 0;
  at.normal.cwiseAbs().maxCoeff(&axis);
  const double side = at.normal[axis] < 0 ? -1 : 1;
  if (axis == 0) return {side * p.y(), -p.z(), 0};
  if (axis == 1) return {-side * p.x(), -p.z(), 0};
  return {p.x(), -side * p.y(), 0};
}

/// The place in repeats: in the plane of a mapping, or without one in space.
Vec3<double> place(const TexturePoint& at, const Mapping& mapping, double scale) {
  if (mapping.name == "radial") return radial_place(at.position) / scale;
  if (mapping.name == "normal") return radial_place(at.normal) / scale;
  if (mapping.name == "box") return of_box(at) / scale;
  if (mapping.name == "planar") return Vec3<double>(at.position.x(), -at.position.y(), 0) / scale;
  return at.position / scale - below_surface * at.normal;
}

Vec3<double> place(const TexturePoint& at, const TwoColours& of) {
  return place(at, of.mapping, of.scale);
}

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

struct Evaluate {
  const TexturePoint& at;

  Colour operator()(const ImageTexture& texture) const {
    if (!texture.picture.image) return Colour::Zero();
    const Image& image = *texture.picture.image;
    const Vec3<double> p = place(at, texture.mapping, texture.scale);
    const double x = (p.x() - std::floor(p.x())) * image.width - 0.5;
    const double y = (p.y() - std::floor(p.y())) * image.height - 0.5;
    const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
    const double fx = x - x0, fy = y - y0;
    const auto texel = [&](int column, int row) -> Colour {
      return image.at((column + image.width) % image.width, (row + image.height) % image.height)
          .cast<double>();
    };
    const Colour upper = (1 - fx) * texel(x0, y0) + fx * texel(x0 + 1, y0);
    const Colour lower = (1 - fx) * texel(x0, y0 + 1) + fx * texel(x0 + 1, y0 + 1);
    return ((1 - fy) * upper + fy * lower).cwiseMin(1.0);
  }
  Colour operator()(const CheckerTexture& texture) const {
    const Vec3<double> p = place(at, texture);
    const double sum = std::floor(p.x()) + std::floor(p.y()) + std::floor(p.z());
    return blend(texture, std::abs(std::remainder(sum, 2)));
  }
  Colour operator()(const GridTexture& texture) const {
    const Vec3<double> p = place(at, texture);
    const int axes = texture.mapping.name.empty() ? 3 : 2;
    bool is_line = false;
    for (int axis = 0; axis < axes; ++axis)
      is_line = is_line || std::abs(std::remainder(p[axis], 1)) < texture.width / 2;
    return is_line ? texture.b : texture.a;
  }
  Colour operator()(const GradientTexture& texture) const {
    return blend(texture, place(at, texture).dot(unit(texture.direction)) + 0.5);
  }
  Colour operator()(const NoiseTexture& texture) const {
    return blend(texture, 0.5 + 0.9 * fractal_noise(place(at, texture)));
  }
  Colour operator()(const MarbleTexture& texture) const {
    const Vec3<double> p = place(at, texture);
    const double wave = std::sin(2 * pi * (p.x() + 1.3 * fractal_noise(p)));
    return blend(texture, std::pow(0.5 + 0.5 * wave, 4));
  }
  Colour operator()(const WoodTexture& texture) const {
    const Vec3<double> p = place(at, texture);
    const Vec3<double> along(0.7 * p.x(), 0.7 * p.y(), 0.15 * p.z());
    const double ring = std::hypot(p.x(), p.y()) + 0.6 * fractal_noise(along);
    const double part = ring - std::floor(ring);
    const double fibre = 0.15 * gradient_noise({9 * p.x(), 9 * p.y(), 0.7 * p.z()});
    return blend(texture, part * part * part + fibre);
  }
};

}  // namespace

Vec3<double> radial_place(const Vec3<double>& direction) {
  const double length = direction.norm();
  if (!(length > 0)) return Vec3<double>::Zero();
  return {0.5 + std::atan2(direction.y(), direction.x()) / (2 * pi),
          std::acos(std::clamp(direction.z() / length, -1.0, 1.0)) / pi, 0};
}

Vec3<double> picture_right(const TexturePoint& at, const Mapping& mapping) {
  if (mapping.name == "box") {
    int axis = 0;
    at.normal.cwiseAbs().maxCoeff(&axis);
    const double side = at.normal[axis] < 0 ? -1 : 1;
    if (axis == 0) return {0, side, 0};
    if (axis == 1) return {-side, 0, 0};
    return Vec3<double>::UnitX();
  }
  if (mapping.name == "planar") return Vec3<double>::UnitX();
  const Vec3<double>& outwards = mapping.name == "normal" ? at.normal : at.position;
  const Vec3<double> around(-outwards.y(), outwards.x(), 0);
  return around.isZero(0) ? Vec3<double>(Vec3<double>::UnitY()) : around;
}

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

double fractal_noise(const Vec3<double>& at) {
  constexpr int octaves = 6;
  double sum = 0, strength = 1, fineness = 1;
  for (int i = 0; i < octaves; ++i, strength /= 2, fineness *= 2)
    sum += strength * gradient_noise(fineness * at + Vec3<double>::Constant(0.37 * i));
  return sum;
}

Colour paint_at(const Paint& paint, const TexturePoint& at) {
  return paint.texture() ? std::visit(Evaluate{at}, *paint.texture()) : paint.colour();
}

}  // namespace minkray
