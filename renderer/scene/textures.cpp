// SPDX-License-Identifier: MIT
#include "renderer/scene/textures.h"

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
          return sum / static_cast<double>(kind.picture.image->pixels.size());
        }
      },
      texture);
}

}  // namespace

Paint::Paint(TextureKind texture)
    : colour_(mean_of(texture)),
      texture_(std::make_shared<const TextureKind>(std::move(texture))) {}

}  // namespace minkray
