// SPDX-License-Identifier: MIT
// Operands of shapes that are made of shapes: rounding, sums, hulls and maps. Operands are
// immutable and shared, so copying such a shape is cheap.
#pragma once

#include <memory>
#include <vector>

#include "core/support/jet.h"

namespace minkray {

struct Shape;

/// One operand. Its members are defined in core/shape/shape.h.
class Nested {
 public:
  Nested() = default;
  Nested(Shape shape);

  const Shape& operator*() const { return *shape_; }
  const Shape* operator->() const { return shape_.get(); }

  /// Support point and jet of the operand.
  template <class W>
  Vec3<W> support(const Vec3<W>& n) const;
  template <class W>
  Jet<W> jet(const Vec3<W>& n) const;

 private:
  std::shared_ptr<const Shape> shape_;
};

/// One or more operands.
using ShapeList = std::vector<Nested>;

}  // namespace minkray
