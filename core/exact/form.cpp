// SPDX-License-Identifier: MIT
#include "core/exact/form.h"

#include <algorithm>
#include <cmath>

#include "core/exact/cut_cylinder.h"
#include "core/exact/turned_capsule.h"
#include "core/polytope/polytope.h"

namespace minkray::exact {

namespace {

/// Prepares forms with a lateral surface that is part of a cone: computes the height of the cone's
/// apex, and mirrors forms so that the apex is above. Returns no form if the apex is too far away,
/// or an end too small, for the bounds that docs/forms.md derives.
Form tapered(Form form) {
  double &lower = form.sizes[0], &upper = form.sizes[1], &half_height = form.sizes[2],
         &apex = form.sizes[3];
  if (upper > lower) {
    std::swap(lower, upper);
    form.is_upside_down = true;
  }
  const bool is_round = form.kind == FormKind::tapered_capsule;
  if (lower == upper) {
    form.kind = is_round ? FormKind::capsule : FormKind::cylinder;
    form.sizes = {lower, half_height};
    form.R = is_round ? lower + half_height : std::hypot(lower, half_height);
    return form;
  }
  if (!(half_height > 0)) return {};
  const double narrows = (lower - upper) / (2 * half_height);
  if (is_round) {
    if (!(narrows < tolerance::tapered_steepest) ||
        !(upper > tolerance::tapered_least_ball * lower))
      return {};
    form.sine = narrows;
    form.slope = narrows / std::sqrt(1 - narrows * narrows);
  } else {
    form.slope = narrows;
    form.sine = narrows / std::sqrt(1 + narrows * narrows);
  }
  form.R = is_round ? half_height + lower : std::hypot(half_height, lower);
  apex = half_height + upper / narrows;
  if (!(apex < tolerance::tapered_farthest_apex * form.R)) return {};
  return form;
}

}  // namespace

Form turned_capsule_form(Form form) {
  const double radius = form.sizes[3];
  if (!(radius > 0)) return {};
  using Long = Vec3<long double>;
  const Vec3<double> half(form.sizes[0], form.sizes[1], form.sizes[2]);
  const Long along = half.cast<long double>();
  const double length = static_cast<double>(along.norm());
  form.R = length + radius;
  if (!(length > 0)) {
    form.kind = FormKind::ball;
    form.sizes = {radius};
    return form;
  }
  const Vec3<double> z = along.normalized().cast<double>();
  const Vec3<double> x = along.unitOrthogonal().cast<double>();
  form.sizes = {radius, length, z.x(), z.y(), z.z(), x.x(), x.y(), x.z()};
  return form;
}

Form form_of(const ExactForm& declared, const Vec3<double>& ball_centre, double down) {
  Form form;
  form.kind = declared.kind;
  const auto& middle = declared.middle;
  form.offset = ball_centre - Vec3<double>(middle[0], middle[1], middle[2]) * down;
  form.is_off_centre = !form.offset.isZero(0);
  for (std::size_t i = 0; i < declared.sizes.size(); ++i) form.sizes[i] = declared.sizes[i] * down;
  const auto& a = form.sizes;
  switch (declared.kind) {
    case FormKind::none:
    case FormKind::polytope:
      return {};
    case FormKind::segment:
      form = turned_capsule_form(form);
      break;
    case FormKind::triangle: {
      std::array<Vec3<double>, 3> corners;
      for (std::size_t i = 0; i < 3; ++i)
        corners[i] = Vec3<double>(a[3 * i], a[3 * i + 1], a[3 * i + 2]) - ball_centre;
      return form_of(Polytope::of(corners, a[9]));
    }
    case FormKind::ball:
      form.R = a[0];
      break;
    case FormKind::ellipsoid:
      form.scale = {1 / a[0], 1 / a[1], 1 / a[2]};
      form.is_scaled = true;
      form.largest_scale = form.scale.maxCoeff();
      form.R = 1;
      form.inner_R = std::max({a[0], a[1], a[2]});
      form.sizes = {1};
      form.kind = FormKind::ball;
      break;
    case FormKind::box:
      form.R = Vec3<double>(a[0], a[1], a[2]).norm();
      break;
    case FormKind::capsule:
      form.R = a[0] + a[1];
      break;
    case FormKind::rounded_box:
      if (!(a[3] > 0)) return {};
      form.R = Vec3<double>(a[0], a[1], a[2]).norm() + a[3];
      break;
    case FormKind::tapered_capsule:
    case FormKind::frustum:
      form = tapered(form);
      break;
    case FormKind::cut_cylinder:
      form = cut_cylinder_form(form, declared.sizes);
      break;
    case FormKind::cylinder:
      form.R = std::hypot(a[0], a[1]);
      break;
  }
  if (!form.is_scaled) form.inner_R = form.R;
  const bool has_size = form.R > 0 && std::isfinite(form.R) && std::isfinite(form.largest_scale);
  return has_size ? form : Form();
}

Form form_of(std::shared_ptr<const Polytope> polytope) {
  Form form;
  if (!polytope) return form;
  form.kind = FormKind::polytope;
  form.R = form.inner_R = polytope->radius();
  form.polytope = std::move(polytope);
  return form;
}

}  // namespace minkray::exact
