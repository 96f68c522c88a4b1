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
  /// which the shape must be scaled to contain a point) at points of a line. All points are in
  /// units of `radii`. `squared_start()` is the square of the radius of a ball near the surface.
  /// `parabola_error(step)` bounds the difference, after a step of this length, between the
  /// gauge's square and its osculating parabola. `is_nearly_sharp()` is true for parameters with
  /// edges so sharply curved that a plane is a poor model of the surface near them.
  bool gauge = false;
  /// Faces may be slanted. `half_thickness()` returns half of the distance between them.
  bool slanted = false;
  /// `heights` are the only coordinates along z: a number added to all of them moves the shape.
  bool heights = false;
  /// The shape is a body of revolution about the z axis. Only pairs without a formula use this.
  bool revolved = false;
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
