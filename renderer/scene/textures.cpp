// SPDX-License-Identifier: MIT
#include "renderer/scene/textures.h"

#include "renderer/image/pyramid.h"

namespace minkray {
namespace {

Colour mean_of(const TextureKind& texture) {
  return std::visit(
      []<class T>(const T& kind) -> Colour {
        if constexpr (std::is_base_of_v<TwoColours, T>) {
          return 0.5 * (kind.a + kind.b);
        } else {
          Colour sum = Colour::Zero();
          if (!kind.picture.image || kind.picture.image->pixels.empty()) return sum;
          for (const Vec3<float>& pixel : kind.picture.image->pixels)
            sum += pixel.template cast<double>();
          return (sum / static_cast<double>(kind.picture.image->pixels.size()))
              .cwiseProduct(kind.tint);
        }
      },
      texture);
}

std::vector<Image> smaller_pictures(const TextureKind& texture) {
  const auto* image = std::get_if<ImageTexture>(&texture);
  return image && image->picture.image ? smaller_images(*image->picture.image)
                                       : std::vector<Image>();
}

}  // namespace

Paint::Paint(TextureKind texture) : colour_(mean_of(texture)) {
  std::vector<Image> smaller = smaller_pictures(texture);
  texture_ = std::make_shared<const Texture>(Texture{std::move(texture), std::move(smaller)});
}

}  // namespace minkray
