// SPDX-License-Identifier: MIT
#include "core/shape/custom.h"

#include <algorithm>

namespace minkray {

SupportSource::~SupportSource() = default;

namespace {

/// Normalises directions. Zero and NaN become the x axis.
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

SupportSource::JetNumbers SupportSource::jet_along(Coordinates direction) const {
  JetNumbers numbers;
  Derivative derivative;
  make_units(1, &direction);
  jets(1, &direction, &numbers.point, &derivative);
  const auto vector = [](const Coordinates& c) { return Vec3<double>(c[0], c[1], c[2]); };
  const Vec3<double> g = vector(numbers.point) - vector(middle_);
  const double reach = vector(direction).dot(g);
  Mat3<double> H;
  H << derivative[0], derivative[1], derivative[2],  //
      derivative[3], derivative[4], derivative[5],   //
      derivative[6], derivative[7], derivative[8];
  numbers.curved = reach > 0 && H.allFinite() && !H.isZero(0);
  if (!numbers.curved) return numbers;
  const Mat3<double> F = factor<double>(Mat3<double>(reach * H + g * g.transpose()));
  for (int i = 0; i < 9; ++i) numbers.factor[static_cast<std::size_t>(i)] = F(i / 3, i % 3);
  return numbers;
}

void SupportSource::jets(std::size_t count, const Coordinates* directions, Coordinates* points,
                         Derivative* derivatives) const {
  support(count, directions, points);
  std::fill_n(derivatives, count, Derivative{});
}

}  // namespace minkray
