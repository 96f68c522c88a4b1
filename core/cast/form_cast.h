// SPDX-License-Identifier: MIT
// Casting one ray at a shape whose closed form answers without a doubt: all that is read of the
// shape's place is what the filter needs.
#pragma once

#include "core/math/ray.h"
#include "core/model/shape_definition.h"
#include "core/query/result.h"

namespace minkray {

/// Holds the part of a PreparedShape that the filter reads. The definition and the map must outlive
/// it.
class FormPlace {
 public:
  /// `centre` is the inner ball's, rounded; the map is null for the identity.
  FormPlace(const ShapeDefinition<double>& definition, const Vec3<double>& centre,
            const Mat3<double>* to_inner)
      : definition_(definition), centre_(centre), to_inner_(to_inner) {}

  const ShapeDefinition<double>& definition() const { return definition_; }
  const Vec3<double>& centre() const { return centre_; }
  const Mat3<double>* linear_to_inner() const { return to_inner_; }

 private:
  const ShapeDefinition<double>& definition_;
  Vec3<double> centre_;
  const Mat3<double>* to_inner_;
};

/// Finds where the ray enters the shape, by its closed form: false if that is in doubt, or there is
/// none. The same bits as cast_ray.
bool cast_by_form(const FormPlace& place, const Ray<double>& ray, CastResult<double>& result);

}  // namespace minkray
