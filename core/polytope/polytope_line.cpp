// SPDX-License-Identifier: MIT
// Finds where a single line enters a polytope.
#include "core/polytope/polytope.h"
#include "core/polytope/polytope_rounded.h"

namespace minkray::exact {

template <>
Entry<double> enter_tables<double>(const PolytopeTables& polytope, const Line<double>& line,
                                   const bool& open) {
  return polytope.rounded_by > 0 ? enter_features(polytope, line, open)
                                 : enter_planes(polytope, line, open);
}

/// Called if the walk fails: on flat and slender polytopes it may go in circles.
Entry<double> enter_any_feature(const PolytopeTables& of, const Line<double>& line) {
  constexpr std::size_t most_half_edges = 384;  // three for each of 128 triangles
  const std::size_t count = of.origin.size();
  if (count > most_half_edges) return {};
  RoundedWalk<double> walk(of, line);
  for (std::size_t edge = 0; edge < count; ++edge)
    for (const double kind : {feature::face, feature::edge, feature::vertex})
      if (kind != feature::face || edge % 3 == 0)
        if (walk.settles_at(kind, static_cast<double>(edge))) return walk.entry();
  return {};
}

}  // namespace minkray::exact
