// SPDX-License-Identifier: MIT
// A shape's closed form, for casts. Each form has its own file in this folder, with a struct that
// describes it; core/exact/forms.h lists these structs.
#pragma once

#include <array>
#include <memory>

#include "core/math/vec.h"
#include "core/shape/shape.h"

namespace minkray {

/// Kind of a closed form. The other values are constants of the structs that describe forms, such
/// as exact::BoxForm::kind.
enum class FormKind : unsigned char { none };

/// All kinds are less than this.
inline constexpr std::size_t form_kinds = 16;

namespace exact {

class Polytope;

/// Parameters of a form. A rounded triangle has the most: ten.
using FormSizes = std::array<double, 10>;

/// The form of a shape with given parameters, in the shape's own frame.
struct DeclaredForm {
  FormSizes sizes = {};
  Vec3<double> middle = {0, 0, 0};
  FormKind kind = FormKind::none;
};

/// A closed form prepared for casts. The form's frame is the shape's frame, moved to the form's
/// middle and scaled by `scale` along the axes (so that ellipsoids become balls).
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
  FormSizes sizes = {};
  std::shared_ptr<const Polytope> polytope;  ///< null for other kinds
};

/// Tests of rays against forms of a kind, in float lanes of screens (core/screen/screen.h).
enum class Lanes : unsigned char {
  none,    ///< no test: screens test a box around the form
  sizes,   ///< with F::enter, which takes sizes in lanes
  planes,  ///< with the planes of one polytope
};

/// Defaults of the structs that describe forms.
struct FormDefaults {
  static constexpr std::size_t lengths = 10;  ///< number of sizes that are lengths; others follow
  static constexpr bool is_inlined = false;   ///< `enter` is inlined into casts
  static constexpr Lanes lanes = Lanes::none;
  static constexpr bool is_round = false;  ///< the surface has no flat parts and no edges

  /// Minkowski sum with a ball; kind `none` if the sum has no closed form.
  static DeclaredForm rounded(const DeclaredForm&, double) { return {}; }

  /// Least radius of the round parts.
  static double least_radius(const Form& form) { return form.R; }
};

/// Prepares the closed form of a shape. `ball_centre` is the centre of the shape's bounding ball;
/// lengths are multiplied by `down`. Returns FormKind::none if the shape has no closed form, or if
/// the form does not hold for the shape's parameters.
Form form_of(const Shape& shape, const Vec3<double>& ball_centre, double down);

/// True if the surface of forms of this kind has no flat parts and no edges.
bool is_round(FormKind kind);

}  // namespace exact
}  // namespace minkray
