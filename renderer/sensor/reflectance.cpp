// SPDX-License-Identifier: MIT
#include "renderer/sensor/reflectance.h"

#include "renderer/surfaces/scene_surfaces.h"

namespace minkray {

std::vector<float> reflectances_of(const Scene& scene) {
  const SceneSurfaces surfaces(scene);
  const std::vector<std::uint32_t> materials = material_of_instance(scene);
  std::vector<float> reflectances;
  reflectances.reserve(materials.size());
  for (std::uint32_t i = 0; i < materials.size(); ++i) {
    const bool is_glass =
        std::holds_alternative<DielectricMaterial>(scene.materials[materials[i]].kind);
    reflectances.push_back(is_glass ? 0
                                    : static_cast<float>(surfaces.of(i).colour.colour().mean()));
  }
  return reflectances;
}

}  // namespace minkray
