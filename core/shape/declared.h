// SPDX-License-Identifier: MIT
// What a shape's header declares of it beyond its support mapping and its jets. A shape that
// declares nothing is cast at with those alone: what its fields and functions are called says
// nothing of it.
#pragma once

#include <concepts>

namespace minkray {

struct Declared {
  /// It is the box of all points with |x_k| <= half_extents[k].
  bool slabs = false;
  /// It is a polytope, and points.facets() are its facets, or null.
  bool facets = false;
  /// Its surface is smooth, and gauge_along(u, v, lambda) tells how far it is from points of a
  /// line.
  bool gauge = false;
  /// support_where(wanted, n) is support(n) where it is wanted, and cheaper where it is not.
  bool support_where = false;
  /// A program gives it: no file can hold one.
  bool by_program = false;
};

/// What S declares, as `static constexpr Declared declared = {...};`.
template <class S>
inline constexpr Declared declared_by = [] {
  if constexpr (requires { requires std::same_as<decltype(S::declared), const Declared>; })
    return S::declared;
  else
    return Declared();
}();

}  // namespace minkray
