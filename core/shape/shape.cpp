// SPDX-License-Identifier: MIT
#include "core/shape/shape.h"

namespace minkray {

Shape::Shape(const Shape& other) = default;
Shape::Shape(Shape&& other) noexcept = default;
Shape& Shape::operator=(const Shape& other) = default;
Shape& Shape::operator=(Shape&& other) noexcept = default;
Shape::~Shape() = default;

ExactForm Rounded::exact_form() const {
  return std::visit(
      [&](const auto& inner) -> ExactForm {
        if constexpr (requires { inner.exact_form(); })
          return minkray::rounded(inner.exact_form(), radius);
        else
          return {};
      },
      shape->kind);
}

template Vec3<double> Shape::support(const Vec3<double>&) const;
template Vec3<long double> Shape::support(const Vec3<long double>&) const;
template Jet<double> Shape::jet(const Vec3<double>&) const;

}  // namespace minkray
