// SPDX-License-Identifier: MIT
// A shape's closed form prepared for casts: its declaration (core/support/exact_form.h), relative
// to the middle of the shape's bounding ball.
#pragma once

#include <memory>

#include "core/math/vec.h"
#include "core/support/exact_form.h"

namespace minkray::exact {

class Polytope;

/// The form's frame is the shape's frame, moved to the form's middle and scaled by `scale` along
/// the axes (so that ellipsoids become balls).
struct Form {
  FormKind kind = FormKind::none;   ///< none: the shape has no closed form
  bool is_scaled = false;           ///< `scale` is not (1, 1, 1)
  bool is_off_centre = false;       ///< `offset` is not zero
  bool is_upside_down = false;      ///< z is mirrored, so that the larger end is below
  double R = 0;                     ///< radius of a ball around the form, in the form's frame
  double inner_R = 0;               ///< radius of a ball around the form before scaling
  double largest_scale = 1;         ///< the greatest component of `scale`
  Vec3<double> offset = {0, 0, 0};  ///< from the form's middle to the ball's centre, before scaling
  Vec3<double> scale = {1, 1, 1};
  double slope = 0;  ///< radius of a cone per height below its apex
  double sine = 0;   ///< sine of the cone's half angle
  /// Sizes as declared, but in the form's frame. For forms with a cone: lower radius, upper radius,
  /// half height, height of the apex.
  FormSizes sizes = {};
  std::shared_ptr<const Polytope> polytope;  ///< null for other kinds
};

/// Prepares a declared form. `ball_centre` is the centre of the shape's bounding ball; lengths are
/// multiplied by `down`. Returns FormKind::none if the closed form does not hold for these sizes.
Form form_of(const ExactForm& declared, const Vec3<double>& ball_centre, double down);

/// Makes the form of a polytope, whose middle must be the bounding ball's centre. Returns
/// FormKind::none if `polytope` is null.
Form form_of(std::shared_ptr<const Polytope> polytope);

}  // namespace minkray::exact
