// SPDX-License-Identifier: MIT
#include "sections.h"

namespace bench {

std::vector<Section> all_sections() {
  std::vector<Section> all;
  for (const auto& some :
       {scene_sections(), distance_sections(), impact_sections(), batch_sections(), mesh_sections(),
        shape_sections(), python_sections(), memory_sections()})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace bench
