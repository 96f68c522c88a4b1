// SPDX-License-Identifier: MIT
#include "core/shape/custom.h"

namespace minkray {

SupportSource::~SupportSource() = default;

void SupportSource::ask(std::size_t count, Coordinates* directions, Coordinates* points) const {
  for (std::size_t i = 0; i < count; ++i) {
    Coordinates& n = directions[i];
    const Vec3<double> along = unit(Vec3<double>(n[0], n[1], n[2]));
    // Neither zero nor what is no number is handed on.
    n = {along.x(), along.y(), along.z()};
    if (!(along.squaredNorm() > 0.5)) n = {1, 0, 0};
  }
  support(count, directions, points);
}

}  // namespace minkray
