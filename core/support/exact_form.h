// SPDX-License-Identifier: MIT
// Closed form of a shape for casts: the form's kind and parameters. Casts at a shape that declares
// no form use only the shape's support mapping and jets.
#pragma once

#include <array>

namespace minkray {

/// Kinds of closed forms, each in its own file in core/exact, with the parameters in `sizes`. All
/// forms are centred at `middle`, with axes along those of the shape's own frame. Lengths are not
/// negative.
enum class FormKind : unsigned char {
  none,
  ball,             ///< radius
  ellipsoid,        ///< three radii
  box,              ///< three half extents
  rounded_box,      ///< three half extents of the box before rounding, radius
  capsule,          ///< radius, half height (along z)
  tapered_capsule,  ///< the balls' radii at -z and +z, half the distance of their centres
  cylinder,         ///< radius, half height (along z)
  frustum,          ///< the disks' radii at -z and +z, half height
  /// Radius; heights of both planes on the z axis (lower, upper); slopes along x and y of the lower
  /// plane, then of the upper plane.
  cut_cylinder,
  segment,   ///< half the vector from end to end; rounding radius
  triangle,  ///< three corners; rounding radius
  polytope,  ///< no parameters: shapes declare facets (declared.h). Must be last
};

/// Parameters of a form. A triangle has the most: ten.
using FormSizes = std::array<double, 10>;

struct ExactForm {
  FormKind kind = FormKind::none;
  FormSizes sizes = {};
  std::array<double, 3> middle = {};
};

/// The form's Minkowski sum with a ball; FormKind::none if the sum has no closed form.
inline ExactForm rounded(const ExactForm& form, double radius) {
  if (radius == 0) return form;
  ExactForm sum = form;
  switch (form.kind) {
    case FormKind::ball:
    case FormKind::capsule:
      sum.sizes[0] += radius;
      return sum;
    case FormKind::tapered_capsule:
      sum.sizes[0] += radius;
      sum.sizes[1] += radius;
      return sum;
    case FormKind::box:
      sum.kind = FormKind::rounded_box;
      sum.sizes[3] = radius;
      return sum;
    case FormKind::rounded_box:
    case FormKind::segment:
      sum.sizes[3] += radius;
      return sum;
    case FormKind::triangle:
      sum.sizes[9] += radius;
      return sum;
    default:
      return {};
  }
}

}  // namespace minkray
