// SPDX-License-Identifier: MIT
// Closed form of a shape for casts: its kind and its numbers. Casts at a shape that declares no
// form use only its support mapping and jets.
#pragma once

#include <array>

namespace minkray {

/// The closed forms, one file each in core/exact, and the meaning of their numbers. All forms are
/// centred at `middle`, along the axes of the shape's own frame. Lengths are not negative.
enum class FormKind : unsigned char {
  none,
  ball,             ///< radius
  ellipsoid,        ///< three radii
  box,              ///< three half extents
  rounded_box,      ///< three half extents of the box before rounding, radius
  capsule,          ///< radius, half height: along z
  tapered_capsule,  ///< the balls' radii at -z and +z, half the distance of their centres
  cylinder,         ///< radius, half height: along z
  frustum,          ///< the disks' radii at -z and +z, half height
  cut_cylinder,     ///< radius, the planes' heights on the z axis, lower and upper slope along x, y
  segment,          ///< half the vector from end to end; rounding radius
  triangle,         ///< three corners; rounding radius
  polytope,         ///< has no numbers: shapes declare its facets (declared.h). Must be last
};

/// The numbers of a form; the largest form has this many.
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
