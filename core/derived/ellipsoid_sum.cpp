// SPDX-License-Identifier: MIT
#include "core/derived/ellipsoid_sum.h"

namespace minkray {

template EllipsoidSum<float> touching_sum(const Shape<float>&, const Vec3<float>&);
template EllipsoidSum<double> touching_sum(const Shape<double>&, const Vec3<double>&);

}  // namespace minkray
