// SPDX-License-Identifier: MIT
// Casts one ray at a shape by its closed form alone, with the filter (core/cast/filter.h). Reads
// only the part of the shape's placement that the filter needs.
#pragma once

#include "core/math/ray.h"
#include "core/model/shape_definition.h"
#include "core/query/result.h"

namespace minkray {

/// Holds the part of a PreparedShape that the filter reads. The definition and the map must outlive
/// the FormPlace.
class FormPlace {
 public:
  /// `centre`: centre of the inner shape's bounding ball, rounded to double. `to_inner`: null for
  /// the identity.
  FormPlace(const ShapeDefinition& definition, const Vec3<double>& centre,
            const Mat3<double>* to_inner)
      : definition_(definition), centre_(centre), to_inner_(to_inner) {}

  const ShapeDefinition& definition() const { return definition_; }
  const Vec3<double>& centre() const { return centre_; }
  const Mat3<double>* linear_to_inner() const { return to_inner_; }

 private:
  const ShapeDefinition& definition_;
  Vec3<double> centre_;
  const Mat3<double>* to_inner_;
};

/// Casts the ray by the shape's closed form. Returns false, with no valid result, if the filter is
/// in doubt or the shape has no closed form. Results are bit-identical to cast_ray's.
bool cast_by_form(const FormPlace& place, const Ray<double>& ray, CastResult<double>& result);

}  // namespace minkray
