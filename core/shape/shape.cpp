// SPDX-License-Identifier: MIT
#include "core/shape/shape.h"

namespace minkray {

Shape::Shape(const Shape& other) = default;
Shape::Shape(Shape&& other) noexcept = default;
Shape& Shape::operator=(const Shape& other) = default;
Shape& Shape::operator=(Shape&& other) noexcept = default;
Shape::~Shape() = default;

template Vec3<double> Shape::support(const Vec3<double>&) const;
template Vec3<long double> Shape::support(const Vec3<long double>&) const;
template Jet<double> Shape::jet(const Vec3<double>&) const;

}  // namespace minkray
