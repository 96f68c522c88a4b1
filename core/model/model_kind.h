// SPDX-License-Identifier: MIT
// Selects the model (line_cast.h) that suits a shape, when the shape is prepared. Tests the shape's
// jets (core/support/jet.h) in a few directions.
#pragma once

#include "core/shape/shape.h"

namespace minkray {

enum class ModelKind : unsigned char {
  points,           ///< a polytope
  rounded_points,   ///< a rounded polytope
  translates,       ///< the hull of translates of one ellipsoid
  gauge,            ///< given by its gauge, the scale at which its surface meets a point
  ellipsoid_sum,    ///< a sum of ellipsoids
  smooth,           ///< a smooth surface
  exact_sums,       ///< the hull of finitely many sums of ellipsoids
  osculating_sums,  ///< as exact_sums, but some sums only approximate (osculate) the surface
};

/// Returns the model that suits a shape. Correctness does not depend on this choice: supporting
/// planes bound any shape, and support points lie in it.
ModelKind model_kind_of(const Shape& shape);

}  // namespace minkray
