// SPDX-License-Identifier: MIT
// Closed form of a shape for casts: the form's name and its numbers. A shape that declares none is
// cast at by its support mapping alone. Nothing is ever guessed from the names or the number of a
// shape's parameters.
#pragma once

#include <array>

namespace minkray {

/// The closed forms there are, one file each in core/exact, and what their numbers mean. All lie
/// around `middle`, along the axes of the shape's own frame. Lengths are not negative.
enum class FormKind : unsigned char {
  none,
  ball,             ///< radius
  ellipsoid,        ///< three radii
  box,              ///< three half extents
  rounded_box,      ///< three half extents of what is rounded, radius
  capsule,          ///< radius, half height: along z
  tapered_capsule,  ///< the balls' radii at -z and +z, half the distance of their centres
  cylinder,         ///< radius, half height: along z
  frustum,          ///< the disks' radii at -z and +z, half height
  cut_cylinder,     ///< radius, the planes' heights on the z axis, lower and upper slope along x, y
  segment,          ///< half the way from end to end, along x, y, z; the radius it is grown by
  triangle,         ///< three corners; the radius it is grown by
  polytope,         ///< has no numbers: shapes declare its facets (declared.h). Must be last
};

/// As many numbers as the largest form has.
using FormSizes = std::array<double, 10>;

struct ExactForm {
  FormKind kind = FormKind::none;
  FormSizes sizes = {};
  std::array<double, 3> middle = {};
};

/// The form's sum with a ball; none, where that is none of the forms.
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
