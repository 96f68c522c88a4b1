// SPDX-License-Identifier: MIT
// Operands of shapes that are made of shapes: rounding, sums, hulls and maps. Operands are
// immutable and shared, so copying such a shape is cheap.
#pragma once

#include <memory>
#include <utility>
#include <vector>

namespace minkray {

template <class T>
struct Shape;

/// One operand.
template <class T>
class Nested {
 public:
  Nested() = default;
  Nested(Shape<T> shape) : shape_(std::make_shared<const Shape<T>>(std::move(shape))) {}

  const Shape<T>& operator*() const { return *shape_; }
  const Shape<T>* operator->() const { return shape_.get(); }

 private:
  std::shared_ptr<const Shape<T>> shape_;
};

/// One or more operands.
template <class T>
using ShapeList = std::vector<Nested<T>>;

}  // namespace minkray
