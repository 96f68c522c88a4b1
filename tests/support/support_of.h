// SPDX-License-Identifier: MIT
// A shape of ours as if a program gave it: by its support mapping alone.
#pragma once

#include "core/shape/shape.h"

namespace minkray::testing {

class SupportOf final : public SupportSource {
 public:
  explicit SupportOf(Shape shape) : shape_(std::move(shape)) {}

 private:
  void support(std::size_t count, const Coordinates* n, Coordinates* points) const override {
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3<double> p = shape_.support(Vec3<double>(n[i][0], n[i][1], n[i][2]));
      points[i] = {p.x(), p.y(), p.z()};
    }
  }
  Shape shape_;
};

inline Shape as_custom(Shape shape) {
  return Custom{std::make_shared<const SupportOf>(std::move(shape))};
}

}  // namespace minkray::testing
