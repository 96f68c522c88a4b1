// SPDX-License-Identifier: MIT
// Optional declarations in a shape's header beyond its support mapping and its jets. A shape
// without declarations is cast at with those alone: the names of its fields and functions imply
// nothing.
#pragma once

#include <concepts>

namespace minkray {

struct Declared {
  /// The shape is the box of all points with |x_k| <= half_extents[k].
  bool slabs = false;
  /// The shape is a polytope, and points.facets() are its facets, or null.
  bool facets = false;
  /// The surface is smooth, and gauge_along(u, v, lambda) returns its distance from points of a
  /// line.
  bool gauge = false;
  /// support_where(wanted, n) is support(n) where it is wanted, and cheaper where it is not.
  bool support_where = false;
  /// A program gives it: no file can hold one.
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
