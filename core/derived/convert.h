// SPDX-License-Identifier: MIT
// A shape is converted to another scalar type.
#pragma once

#include "core/shape/shape.h"

namespace minkray {

/// The shape with its numbers rounded to U. Both types are float, double or long double.
template <class U, class T>
Shape<U> convert(const Shape<T>& shape);

}  // namespace minkray
