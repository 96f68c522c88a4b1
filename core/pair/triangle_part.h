// SPDX-License-Identifier: MIT
// A triangle as a ContactShape that stores its corners itself, so that it can be made for a single
// query without allocating memory.
#pragma once

#include "core/pair/contact_shape.h"

namespace minkray {

class TrianglePart {
 public:
  TrianglePart(const Vec3<double>& a, const Vec3<double>& b, const Vec3<double>& c)
      : shape_(core_of(a, b, c)) {}
  TrianglePart(const TrianglePart&) = delete;
  TrianglePart& operator=(const TrianglePart&) = delete;

  const ContactShape& shape() const { return shape_; }

 private:
  static constexpr int count = 8;  // arrays of hulls are filled up to a multiple of this

  CoreAndRadius core_of(const Vec3<double>& a, const Vec3<double>& b, const Vec3<double>& c) {
    constexpr double padding = 1 + 16 * std::numeric_limits<double>::epsilon();
    CoreAndRadius found;
    const Vec3<double> lower = a.cwiseMin(b).cwiseMin(c), upper = a.cwiseMax(b).cwiseMax(c);
    found.middle = lower + (upper - lower) / 2;
    ShapeCore& core = found.core;
    core.kind = CoreKind::hull;
    core.count = count;
    core.x = numbers_[0];
    core.y = numbers_[1];
    core.z = numbers_[2];
    for (int i = 0; i < count; ++i) {
      const Vec3<double> p = (i == 0 ? a : i == 1 ? b : c) - found.middle;
      core.ball = std::max(core.ball, length_of<double>(p) * padding);
      for (int k = 0; k < 3; ++k) numbers_[k][i] = p[k];
    }
    return found;
  }

  double numbers_[3][count];
  ContactShape shape_;
};

}  // namespace minkray
