// SPDX-License-Identifier: MIT
// Shapes whose proportions exceed the design of the solvers' rounding: needles, plates and slivers
// of more than 1 : 10^4 to 10^6, and edges as sharp next to faces.
#pragma once

#include "core/shape/shape.h"

namespace minkray {

/// True if any of its component shapes is so much longer than it is thick, the maps around it
/// included, or so much larger than another of them. Operands without any thickness (disks,
/// segments, flat hulls) are not thin; points in double that lie on a line but for rounding are.
/// Superellipsoids whose edges are nearly, but not quite, sharp count as well.
template <class T>
bool has_extreme_proportions(const Shape<T>& shape);

/// True if the shape is made of points in float that are a needle thinner than their rounding:
/// rays in float still meet it, and only the GJK ray cast finds where.
bool is_lost_in_rounding(const Shape<float>& shape);

/// True if the shape is made of points in float that are a sliver: a ray in its plane is off by
/// the rounding of its length times its ratio of length to thickness.
bool is_sliver(const Shape<float>& shape);

/// True if the shape is made of points in float that lie in a plane but for their rounding.
bool is_flat_but_for_rounding(const Shape<float>& shape);

extern template bool has_extreme_proportions(const Shape<float>&);
extern template bool has_extreme_proportions(const Shape<double>&);

}  // namespace minkray
