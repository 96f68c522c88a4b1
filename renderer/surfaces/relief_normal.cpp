// SPDX-License-Identifier: MIT
#include "renderer/surfaces/relief_normal.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/image/colour.h"
#include "renderer/rays/frame.h"

namespace minkray {
namespace {

/// Heights are compared so far apart, as a part of the texture's scale: finer detail is not seen.
constexpr double least_step = 2e-3;

PaintIfAny in_numbers(const PaintIfAny& paint) {
  const auto* texture =
      paint && paint->texture() ? std::get_if<ImageTexture>(paint->texture()) : nullptr;
  if (!texture || !texture->picture.image || texture->picture.is_linear()) return paint;
  Image codes = *texture->picture.image;
  for (Vec3<float>& pixel : codes.pixels)
    for (float& value : pixel) value = static_cast<float>(to_srgb(double{value}));
  ImageTexture of_codes = *texture;
  of_codes.picture.image = std::make_shared<const Image>(std::move(codes));
  return Paint(TextureKind(std::move(of_codes)));
}

/// The length of the texture's finest detail around a place.
double step_of(const TextureKind& texture, const TexturePoint& at) {
  return std::visit(
      [&]<class T>(const T& kind) -> double {
        const double by_uv = std::max(at.uv_slopes[0].norm(), at.uv_slopes[1].norm());
        if (kind.mapping.name == "uv" && !(by_uv > 0)) return 0;
        const bool is_turn = kind.mapping.name == "radial" || kind.mapping.name == "normal";
        const double repeat = kind.scale * (is_turn ? 2 * std::numbers::pi * at.position.norm()
                                            : kind.mapping.name == "uv" ? 1 / by_uv
                                                                        : 1.0);
        double part = least_step;
        if constexpr (std::is_same_v<T, ImageTexture>)
          if (kind.picture.image) part = std::max(part, 0.5 / kind.picture.image->width);
        return part * repeat;
      },
      texture);
}

/// Slope of the height along the surface.
Vec3<double> slope(const Paint& bump, const TexturePoint& at) {
  if (!bump.texture()) return Vec3<double>::Zero();
  const double finest = step_of(*bump.texture(), at);
  if (!(finest > 0)) return Vec3<double>::Zero();
  const Frame frame(at.normal);
  const auto height = [&](const Vec3<double>& offset) {
    return paint_at(bump, at.moved(offset)).mean();
  };
  Vec3<double> rise = Vec3<double>::Zero();
  for (const Vec3<double>& along : {frame.x, frame.y}) {
    const double footprint =
        std::abs(at.footprint[0].dot(along)) + std::abs(at.footprint[1].dot(along));
    const double step = std::max(finest, footprint / 2);
    rise += (height(step * along) - height(-step * along)) / (2 * step) * along;
  }
  return rise;
}

}  // namespace

Relief in_numbers(const Relief& relief) {
  return {in_numbers(relief.bump), relief.bump_height, in_numbers(relief.normal_map)};
}

Vec3<double> relief_normal(const Relief& relief, const TexturePoint& at) {
  Vec3<double> normal = at.normal;
  if (relief.normal_map && relief.normal_map->texture())
    if (const auto* image = std::get_if<ImageTexture>(relief.normal_map->texture())) {
      const Vec3<double> towards = picture_right(at, image->mapping);
      const Vec3<double> right = unit<double>(towards - normal.dot(towards) * normal);
      const Colour code = paint_at(*relief.normal_map, at);
      const Vec3<double> local = 2 * code - Colour::Ones();
      const Vec3<double> up = normal.cross(right);
      const Vec3<double> bent = local.x() * right + local.y() * up + local.z() * normal;
      if (bent.dot(normal) > 0) normal = unit(bent);
    }
  if (relief.bump) normal = unit<double>(normal - relief.bump_height * slope(*relief.bump, at));
  return normal;
}

}  // namespace minkray
