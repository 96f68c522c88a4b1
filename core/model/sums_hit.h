// SPDX-License-Identifier: MIT
// Result of a cast at the hull of up to four sums of ellipsoids (sums_cast.h).
#pragma once

#include <array>

#include "core/math/vec.h"

namespace minkray {

/// The hit on the hull of sums of ellipsoids.
template <class W>
struct SumsHit {
  Vec3<W> m = Vec3<W>::Zero();       ///< normal at the hit
  W height = W(0);                   ///< z of the hit, in the ray's frame
  Mask<W> certain = Mask<W>(false);  ///< the hit is that of the model, up to rounding
  Mask<W> exact = Mask<W>(false);    ///< all carriers belong to the shape
  std::array<W, 4> weights = {W(0), W(0), W(0), W(0)};
};

template <class W>
SumsHit<W> pick(const Mask<W>& condition, const SumsHit<W>& a, const SumsHit<W>& b) {
  SumsHit<W> chosen{select<W>(condition, a.m, b.m),
                    select(condition, a.height, b.height),
                    Mask<W>((condition & a.certain) | ((!condition) & b.certain)),
                    Mask<W>((condition & a.exact) | ((!condition) & b.exact)),
                    {}};
  for (std::size_t i = 0; i < 4; ++i)
    chosen.weights[i] = select(condition, a.weights[i], b.weights[i]);
  return chosen;
}

}  // namespace minkray
