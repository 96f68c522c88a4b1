// SPDX-License-Identifier: MIT
#include "renderer/light/relief_normal.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/image/colour.h"
#include "renderer/light/frame.h"

namespace minkray {
namespace {

/// Heights are compared so far apart, as a part of the texture's scale: finer detail is not seen.
constexpr double least_step = 2e-3;

/// Pictures of heights and normals hold numbers, not light: what was read from sRGB codes becomes
/// the codes again.
Colour numbers_at(const Paint& paint, const TexturePoint& at) {
  const Colour colour = paint_at(paint, at);
  const auto* image = paint.texture() ? std::get_if<ImageTexture>(paint.texture()) : nullptr;
  if (!image || image->picture.is_linear()) return colour;
  return {to_srgb(colour.x()), to_srgb(colour.y()), to_srgb(colour.z())};
}

/// The length of the texture's finest detail around a place.
double step_of(const TextureKind& texture, const TexturePoint& at) {
  return std::visit(
      [&]<class T>(const T& kind) {
        const bool is_turn = kind.mapping.name == "radial" || kind.mapping.name == "normal";
        const double repeat =
            kind.scale * (is_turn ? 2 * std::numbers::pi * at.position.norm() : 1.0);
        double part = least_step;
        if constexpr (std::is_same_v<T, ImageTexture>)
          if (kind.picture.image) part = std::max(part, 0.5 / kind.picture.image->width);
        return part * repeat;
      },
      texture);
}

/// How the height rises along the surface.
Vec3<double> slope(const Paint& bump, const TexturePoint& at) {
  if (!bump.texture()) return Vec3<double>::Zero();
  const double step = step_of(*bump.texture(), at);
  if (!(step > 0)) return Vec3<double>::Zero();
  const Frame frame(at.normal);
  const auto height = [&](const Vec3<double>& offset) {
    return numbers_at(bump, {at.position + offset, at.normal}).mean();
  };
  Vec3<double> rise = Vec3<double>::Zero();
  for (const Vec3<double>& along : {frame.x, frame.y})
    rise += (height(step * along) - height(-step * along)) / (2 * step) * along;
  return rise;
}

}  // namespace

Vec3<double> relief_normal(const Relief& relief, const TexturePoint& at) {
  Vec3<double> normal = at.normal;
  if (relief.normal_map && relief.normal_map->texture())
    if (const auto* image = std::get_if<ImageTexture>(relief.normal_map->texture())) {
      const Vec3<double> towards = picture_right(at, image->mapping);
      const Vec3<double> right = unit<double>(towards - normal.dot(towards) * normal);
      const Colour code = numbers_at(*relief.normal_map, at);
      const Vec3<double> local = 2 * code - Colour::Ones();
      const Vec3<double> up = normal.cross(right);
      const Vec3<double> bent = local.x() * right + local.y() * up + local.z() * normal;
      if (bent.dot(normal) > 0) normal = unit(bent);
    }
  if (relief.bump) normal = unit<double>(normal - relief.bump_height * slope(*relief.bump, at));
  return normal;
}

}  // namespace minkray
