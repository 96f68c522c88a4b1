// SPDX-License-Identifier: MIT
#include "renderer/surfaces/texture.h"

#include <algorithm>
#include <cmath>

#include "renderer/surfaces/box_filter.h"
#include "renderer/surfaces/noise.h"

namespace minkray {
namespace {

Colour blend(const TwoColours& colours, double part_of_b) {
  return colours.a + std::clamp(part_of_b, 0.0, 1.0) * (colours.b - colours.a);
}

/// An upright box around a place.
struct TextureBox {
  Vec3<double> middle, width;
};

/// More boxes than this are not laid along a footprint, however long it is.
constexpr int most_boxes = 16;

/// Means over a parallelogram: over boxes along its longer side, each about as long as the shorter
/// side is; none need be shorter than `detail`.
template <class MeanOver>
Colour mean_along(const TexturePlace& place, double detail, const MeanOver& mean_over) {
  double lengths[] = {place.sides[0].norm(), place.sides[1].norm()};
  const auto longer = static_cast<std::size_t>(lengths[1] > lengths[0]);
  const double boxes = std::ceil(lengths[longer] / std::max(lengths[1 - longer], detail));
  const int count =
      std::clamp(static_cast<int>(std::min<double>(boxes, most_boxes)), 1, most_boxes);
  const Vec3<double> step = place.sides[longer] / count;
  const Vec3<double> width = step.cwiseAbs() + place.sides[1 - longer].cwiseAbs();
  if (count == 1) return mean_over(TextureBox{place.middle, width});
  Colour sum = Colour::Zero();
  for (int i = 0; i < count; ++i)
    sum += mean_over(TextureBox{place.middle + (i - 0.5 * (count - 1)) * step, width});
  return sum / count;
}

/// Between the pixels of a picture that is repeated; the place is a part of it.
Colour interpolated(const Image& image, const Vec3<double>& at) {
  const double x = (at.x() - std::floor(at.x())) * image.width - 0.5;
  const double y = (at.y() - std::floor(at.y())) * image.height - 0.5;
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

/// Interpolates a picture at all sizes, between the two whose pixels are about `pixels` times as
/// wide as the largest one's.
Colour interpolated(const Image& image, const std::vector<Image>& smaller, const Vec3<double>& at,
                    double pixels) {
  if (!(pixels > 1) || smaller.empty()) return interpolated(image, at);
  const double size = std::min(std::log2(pixels), static_cast<double>(smaller.size()));
  const auto larger = std::min(static_cast<std::size_t>(size), smaller.size() - 1);
  const double part = size - static_cast<double>(larger);
  return (1 - part) * interpolated(larger == 0 ? image : smaller[larger - 1], at) +
         part * interpolated(smaller[larger], at);
}

/// Mean of a texture over a box.
struct MeanOver {
  const TextureBox& box;

  /// The cells of solid noise are as large as repeats.
  double widest() const { return box.width.maxCoeff(); }

  Colour operator()(const CheckerTexture& texture) const {
    double alike = 1;
    for (int axis = 0; axis < 3; ++axis) alike *= mean_of_fields(box.middle[axis], box.width[axis]);
    return blend(texture, 0.5 - 0.5 * alike);
  }
  Colour operator()(const GridTexture& texture) const {
    const int axes = texture.mapping.name.empty() ? 3 : 2;
    double between = 1;
    for (int axis = 0; axis < axes; ++axis)
      between *= 1 - mean_of_lines(box.middle[axis], box.width[axis], texture.width);
    return between * texture.a + (1 - between) * texture.b;
  }
  Colour operator()(const GradientTexture& texture) const {
    const Vec3<double> along = unit(texture.direction);
    return blend(texture,
                 mean_of_ramp(box.middle.dot(along) + 0.5, box.width.dot(along.cwiseAbs())));
  }
  Colour operator()(const NoiseTexture& texture) const {
    return blend(texture, 0.5 + 0.9 * fractal_noise(box.middle, widest()));
  }
  Colour operator()(const MarbleTexture& texture) const {
    constexpr double turbulence = 1.3;
    const double x = box.middle.x() + turbulence * fractal_noise(box.middle, widest());
    const double range = std::hypot(box.width.x(), turbulence * fractal_range(widest()));
    return blend(texture, mean_of_veins(x, range));
  }
  Colour operator()(const WoodTexture& texture) const {
    constexpr double turbulence = 0.6;
    const Vec3<double>& p = box.middle;
    const auto stretched = [](const Vec3<double>& v, double across, double along) {
      return Vec3<double>(across * v.x(), across * v.y(), along * v.z());
    };
    const double radius = std::hypot(p.x(), p.y());
    const double uneven = stretched(box.width, 0.7, 0.15).maxCoeff();
    const double ring = radius + turbulence * fractal_noise(stretched(p, 0.7, 0.15), uneven);
    const double outwards =
        radius > 0 ? (std::abs(p.x()) * box.width.x() + std::abs(p.y()) * box.width.y()) / radius
                   : std::max(box.width.x(), box.width.y());
    const double rings =
        mean_of_cubes(ring, std::hypot(outwards, turbulence * fractal_range(uneven)));
    const double left = faded(stretched(box.width, 9, 0.7).maxCoeff());
    const double fibre = left > 0 ? left * 0.15 * gradient_noise(stretched(p, 9, 0.7)) : 0.0;
    return blend(texture, rings + fibre);
  }
};

/// The finest detail of textures, in repeats.
double detail_of(const TextureKind& texture) {
  constexpr double of_fields = 0.1, of_noise = 1.0 / 32;
  const bool is_smooth = std::holds_alternative<GradientTexture>(texture);
  const bool has_fields = std::holds_alternative<CheckerTexture>(texture) ||
                          std::holds_alternative<GridTexture>(texture);
  return is_smooth || has_fields ? of_fields : of_noise;
}

Colour picture_at(const Paint& paint, const ImageTexture& texture, const TexturePoint& at) {
  if (!texture.picture.image) return Colour::Zero();
  const Image& image = *texture.picture.image;
  const Vec3<double> size(image.width, image.height, 1);
  const TexturePlace place = texture_place(at, texture.mapping, texture.scale);
  // In pixels, so that boxes are as large as one at least.
  const Colour mean = mean_along(place.times(size), 1, [&](const TextureBox& box) {
    return interpolated(image, paint.smaller(), box.middle.cwiseQuotient(size),
                        box.width.maxCoeff());
  });
  return mean.cwiseProduct(texture.tint);
}

}  // namespace

Colour paint_at(const Paint& paint, const TexturePoint& at) {
  if (!paint.texture()) return paint.colour();
  const TextureKind& kind = *paint.texture();
  return std::visit(
      [&]<class T>(const T& texture) -> Colour {
        // Triangles without coordinates have the mean.
        if (texture.mapping.name == "uv" && !at.has_uv) return paint.colour();
        if constexpr (std::is_same_v<T, ImageTexture>) {
          return picture_at(paint, texture, at);
        } else {
          return mean_along(texture_place(at, texture.mapping, texture.scale), detail_of(kind),
                            [&](const TextureBox& box) { return MeanOver{box}(texture); });
        }
      },
      kind);
}

}  // namespace minkray
