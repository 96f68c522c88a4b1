// SPDX-License-Identifier: MIT
#include "core/exact/form.h"

#include <cmath>

#include "core/exact/forms.h"
#include "core/support/declared.h"

namespace minkray::exact {
namespace {

/// The form of a shape, if one of the forms in the list is for its kind.
template <class S, class F, class... Rest>
DeclaredForm declared(const S& shape, FormList<F, Rest...>) {
  if constexpr (requires { DeclaredForm(F::of(shape)); }) {
    DeclaredForm form = F::of(shape);
    form.kind = F::kind;
    return form;
  } else if constexpr (sizeof...(Rest) > 0) {
    return declared(shape, FormList<Rest...>());
  } else {
    return {};
  }
}

DeclaredForm declared(const Shape& shape) {
  return std::visit(
      []<class S>(const S& kind) -> DeclaredForm {
        if constexpr (std::is_same_v<S, Rounded>) {
          const DeclaredForm core = declared(*kind.shape);
          if (kind.radius == 0) return core;
          return with_form(core.kind, [&]<class F>() { return F::rounded(core, kind.radius); });
        } else {
          return declared(kind, Forms());
        }
      },
      shape.kind);
}

/// The form of a hull, grown by `radius`, and no form of other shapes.
Form form_of_hull(const Shape& shape, double radius, const Vec3<double>& ball_centre, double down) {
  return std::visit(
      [&]<class S>(const S& hull) -> Form {
        if constexpr (declared_by<S>.facets)
          return PolytopeForm::of(Polytope::of(hull.points, ball_centre, down, radius * down));
        else
          return {};
      },
      shape.kind);
}

}  // namespace

Form form_of(const Shape& shape, const Vec3<double>& ball_centre, double down) {
  const auto* rounded = std::get_if<Rounded>(&shape.kind);
  Form form = form_of_hull(rounded ? *rounded->shape : shape, rounded ? rounded->radius : 0,
                           ball_centre, down);
  if (form.kind == FormKind::none) {
    const DeclaredForm declaration = declared(shape);
    form.kind = declaration.kind;
    form.offset = ball_centre - declaration.middle * down;
    form.is_off_centre = !form.offset.isZero(0);
    form = with_form(form.kind, [&]<class F>() {
      for (std::size_t i = 0; i < form.sizes.size(); ++i)
        form.sizes[i] = declaration.sizes[i] * (i < F::lengths ? down : 1);
      return F::prepared(form);
    });
  }
  if (!form.is_scaled) form.inner_R = form.R;
  const bool has_size = form.R > 0 && std::isfinite(form.R) && std::isfinite(form.largest_scale);
  return has_size ? form : Form();
}

bool is_round(FormKind kind) {
  return with_form(kind, []<class F>() { return F::is_round; });
}

}  // namespace minkray::exact
