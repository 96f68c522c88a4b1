// SPDX-License-Identifier: MIT
// Optional declarations in a shape's header, in addition to its support mapping and jets. Casts use
// the members named here only if the shape declares them.
#pragma once

#include <concepts>

namespace minkray {

struct Declared {
  /// The shape is the box of all points with |x_k| <= half_extents[k].
  bool slabs = false;
  /// The shape is a polytope. `points.facets()` returns its facets, or null.
  bool facets = false;
  /// The surface is smooth. `gauge_along(u, v, lambda)` returns the gauge (the least factor by
  /// which the shape must be scaled to contain a point) at points of a line.
  bool gauge = false;
  /// support_where(wanted, n) equals support(n) in wanted lanes, and costs less if few are wanted.
  bool support_where = false;
  /// The calling program provides the shape; files cannot contain such shapes.
  bool by_program = false;
};

/// Declarations of S: `static constexpr Declared declared = {...};`.
template <class S>
inline constexpr Declared declared_by = [] {
  if constexpr (requires { requires std::same_as<decltype(S::declared), const Declared>; })
    return S::declared;
  else
    return Declared();
}();

}  // namespace minkray
