// SPDX-License-Identifier: MIT
// Support points for some lanes of a packet: shapes that compute lane by lane skip the other lanes.
#pragma once

#include "core/math/vec.h"
#include "core/support/declared.h"

namespace minkray {

/// Returns the support point in direction n in the `wanted` lanes, and any point in the others.
template <class W, class S>
Vec3<W> support_where(const S& shape, const Mask<W>& wanted, const Vec3<W>& n) {
  if constexpr (declared_by<S>.support_where)
    return shape.support_where(wanted, n);
  else
    return shape.template support<W>(n);
}

}  // namespace minkray
