// SPDX-License-Identifier: MIT
#include "core/shape/shape.h"

namespace minkray {

template <class T>
Shape<T>::Shape(const Shape& other) = default;
template <class T>
Shape<T>::Shape(Shape&& other) noexcept = default;
template <class T>
Shape<T>& Shape<T>::operator=(const Shape& other) = default;
template <class T>
Shape<T>& Shape<T>::operator=(Shape&& other) noexcept = default;
template <class T>
Shape<T>::~Shape() = default;

template struct Shape<float>;
template struct Shape<double>;
template struct Shape<long double>;
template Vec3<float> Shape<float>::support(const Vec3<float>&) const;
template Vec3<double> Shape<double>::support(const Vec3<double>&) const;
template Vec3<long double> Shape<long double>::support(const Vec3<long double>&) const;
template Jet<float> Shape<float>::jet(const Vec3<float>&) const;
template Jet<double> Shape<double>::jet(const Vec3<double>&) const;

}  // namespace minkray
