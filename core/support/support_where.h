// SPDX-License-Identifier: MIT
// Support points for some of a packet's lanes: shapes that answer lane by lane save the others.
#pragma once

#include "core/math/vec.h"
#include "core/support/declared.h"

namespace minkray {

/// The support point in direction n in the lanes that are `wanted`, in others any point.
template <class W, class S>
Vec3<W> support_where(const S& shape, const Mask<W>& wanted, const Vec3<W>& n) {
  if constexpr (declared_by<S>.support_where)
    return shape.support_where(wanted, n);
  else
    return shape.template support<W>(n);
}

}  // namespace minkray
