// SPDX-License-Identifier: MIT
#include "core/screen/screen.h"

#include <algorithm>
#include <cmath>

#include "core/exact/forms.h"
#include "core/query/tolerances.h"

namespace minkray {
namespace {

/// True if all numbers that a form of this radius computes are within float's range.
bool is_in_range(double R) {
  return R > tolerance::screen_least_radius && R < tolerance::screen_largest_radius;
}

exact::Lanes lanes_of(FormKind kind) {
  return exact::with_form(kind, []<class F>() { return F::lanes; });
}

double least_radius(const exact::Form& form) {
  return exact::with_form(form.kind, [&]<class F>() { return F::least_radius(form); });
}

/// A box around the shape, as a form.
exact::Form box_around(const ShapeDefinition& definition) {
  exact::Form form;
  form.kind = exact::BoxForm::kind;
  const double R = definition.inner_ball().radius;
  for (int axis = 0; axis < 3; ++axis)
    form.sizes[static_cast<std::size_t>(axis)] =
        definition.inner_half_extents()[axis] + tolerance::screen_box_margin * R;
  form.R = form.inner_R = R * (1 + 2 * tolerance::screen_box_margin);
  return form;
}

ScreenForm screen_form(const exact::Form& form, const Vec3<double>& centre) {
  const Vec3<double> offset = form.offset - centre;
  ScreenForm screen;
  const auto in_float = [](double x) { return static_cast<float>(x); };
  for (std::size_t i = 0; i < screen.sizes.size(); ++i) screen.sizes[i] = in_float(form.sizes[i]);
  screen.slope = in_float(form.slope);
  screen.sine = in_float(form.sine);
  screen.R = in_float(form.R);
  screen.least = in_float(least_radius(form));
  for (int axis = 0; axis < 3; ++axis) {
    screen.scale[static_cast<std::size_t>(axis)] = in_float(form.scale[axis]);
    screen.offset[static_cast<std::size_t>(axis)] = in_float(offset[axis]);
  }
  screen.extent = in_float(form.largest_scale * (form.inner_R + offset.norm()));
  screen.up = form.is_upside_down ? -1.0f : 1.0f;
  return screen;
}

std::shared_ptr<const ScreenPlanes> planes_of(const exact::Polytope& polytope) {
  const exact::PolytopeTables& of = polytope.tables();
  if (of.rounded_by > 0 || polytope.planes() > ScreenPlanes::most || polytope.planes() < 4)
    return {};
  constexpr float infinity = std::numeric_limits<float>::infinity();
  auto planes = std::make_shared<ScreenPlanes>();
  planes->count = polytope.planes();
  for (std::size_t first = 0; first < planes->count; first += screen_lanes)
    for (std::size_t k = 0; k < ScreenPlanes::numbers; ++k)
      for (std::size_t i = first; i < first + screen_lanes; ++i) {
        const double* const row = &of.planes[std::min(i, planes->count - 1) * of.plane_row];
        const float below =
            std::nextafter(static_cast<float>(row[3] - row[4] - polytope.rounding()), -infinity);
        planes->rows.push_back(k < 4 ? static_cast<float>(row[k]) : below);
      }
  return planes;
}

}  // namespace

Screen screen_of(const ShapeDefinition& definition, const Vec3<double>& centre) {
  Screen screen;
  if (definition.is_extreme()) return screen;
  const exact::Form& own = definition.form();
  const bool is_in_reach = is_in_range(own.R) && is_in_range(own.inner_R);
  if (own.polytope && is_in_reach) screen.planes = planes_of(*own.polytope);
  screen.is_whole = lanes_of(own.kind) == exact::Lanes::sizes || screen.planes;
  const exact::Form form = screen.is_whole ? own : box_around(definition);
  if (!is_in_range(form.R) || !is_in_range(form.inner_R)) return {};
  screen.kind = form.kind;
  screen.form = screen_form(form, centre);
  return screen;
}

}  // namespace minkray
