// SPDX-License-Identifier: MIT
// Lines in lanes over a polytope. All names here contain the instruction set (core/math/wide.h).
#include "core/polytope/polytope.h"
#include "core/polytope/polytope_rounded.h"

namespace minkray::exact {

using Lanes = Wide<double, static_cast<int>(IsaHere::register_bytes / sizeof(double)), IsaHere>;

template <>
Entry<Lanes> enter_tables<Lanes>(const PolytopeTables& polytope, const Line<Lanes>& line,
                                 const Mask<Lanes>& open) {
  return polytope.rounded_by > 0 ? enter_features(polytope, line, open)
                                 : enter_planes(polytope, line, open);
}

}  // namespace minkray::exact
