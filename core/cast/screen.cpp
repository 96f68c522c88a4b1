// SPDX-License-Identifier: MIT
#include "core/cast/screen.h"

#include <algorithm>
#include <cmath>

#include "core/query/tolerances.h"

namespace minkray {
namespace {

/// Whether all that a form of this radius calculates stays among float's numbers.
bool is_in_range(double R) {
  return R > tolerance::screen_least_radius && R < tolerance::screen_largest_radius;
}

bool has_lanes(FormKind kind) {
  switch (kind) {
    case FormKind::ball:
    case FormKind::box:
    case FormKind::rounded_box:
    case FormKind::capsule:
    case FormKind::tapered_capsule:
    case FormKind::cylinder:
    case FormKind::frustum:
      return true;
    default:
      return false;
  }
}

/// The least radius of what is round.
double least_round(const exact::Form& form) {
  const auto& a = form.sizes;
  switch (form.kind) {
    case FormKind::ball:
    case FormKind::capsule:
    case FormKind::cylinder:
      return a[0];
    case FormKind::rounded_box:
      return a[3];
    case FormKind::tapered_capsule:
      return std::min(a[0], a[1]);
    default:
      return form.R;
  }
}

/// A box around the shape, as a form.
template <class T>
exact::Form box_around(const ShapeDefinition<T>& definition) {
  exact::Form form;
  form.kind = FormKind::box;
  const auto R = static_cast<double>(definition.inner_ball().radius);
  for (int axis = 0; axis < 3; ++axis)
    form.sizes[static_cast<std::size_t>(axis)] =
        static_cast<double>(definition.inner_half_extents()[axis]) +
        tolerance::screen_box_margin * R;
  form.R = form.inner_R = R * (1 + 2 * tolerance::screen_box_margin);
  return form;
}

}  // namespace

template <class T>
Screen screen_of(const ShapeDefinition<T>& definition) {
  Screen screen;
  if (definition.is_extreme() || definition.is_lost_in_rounding()) return screen;
  screen.is_whole = has_lanes(definition.form().kind);
  const exact::Form form = screen.is_whole ? definition.form() : box_around(definition);
  if (!is_in_range(form.R) || !is_in_range(form.inner_R)) return screen;
  screen.kind = form.kind;
  const auto in_float = [](double x) { return static_cast<float>(x); };
  for (std::size_t i = 0; i < screen.form.sizes.size(); ++i)
    screen.form.sizes[i] = in_float(form.sizes[i]);
  screen.form.slope = in_float(form.slope);
  screen.form.sine = in_float(form.sine);
  screen.form.R = in_float(form.R);
  screen.form.least = in_float(least_round(form));
  for (int axis = 0; axis < 3; ++axis) {
    screen.form.scale[static_cast<std::size_t>(axis)] = in_float(form.scale[axis]);
    screen.form.offset[static_cast<std::size_t>(axis)] = in_float(form.offset[axis]);
  }
  screen.form.extent = in_float(form.largest_scale * (form.inner_R + form.offset.norm()));
  screen.form.up = form.is_upside_down ? -1.0f : 1.0f;
  return screen;
}

template Screen screen_of(const ShapeDefinition<float>&);
template Screen screen_of(const ShapeDefinition<double>&);

}  // namespace minkray
