// SPDX-License-Identifier: MIT
#include "core/shape/custom.h"

#include <algorithm>

namespace minkray {

SupportSource::~SupportSource() = default;

namespace {

/// Neither zero nor what is no number is handed on.
void make_units(std::size_t count, Coordinates* directions) {
  for (std::size_t i = 0; i < count; ++i) {
    Coordinates& n = directions[i];
    const Vec3<double> along = unit(Vec3<double>(n[0], n[1], n[2]));
    n = {along.x(), along.y(), along.z()};
    if (!(along.squaredNorm() > 0.5)) n = {1, 0, 0};
  }
}

}  // namespace

void SupportSource::ask(std::size_t count, Coordinates* directions, Coordinates* points) const {
  make_units(count, directions);
  support(count, directions, points);
}

void SupportSource::ask_jets(std::size_t count, Coordinates* directions, Coordinates* points,
                             Derivative* derivatives) const {
  make_units(count, directions);
  jets(count, directions, points, derivatives);
}

void SupportSource::jets(std::size_t count, const Coordinates* directions, Coordinates* points,
                         Derivative* derivatives) const {
  support(count, directions, points);
  std::fill_n(derivatives, count, Derivative{});
}

}  // namespace minkray
