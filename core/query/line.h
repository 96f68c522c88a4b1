// SPDX-License-Identifier: MIT
// Input and output of closed forms: a line relative to a nearby point, and the point where the line
// enters, with an error bound (docs/forms.md, "Casts with an error bound"). W is double or a packet
// of doubles, with one line per lane and bit-identical results. W may also be a packet of floats,
// to screen candidates (core/screen/screen.h); each lane may then have its own form.
#pragma once

#include "core/math/least_to_square.h"
#include "core/math/vec.h"

namespace minkray::exact {

/// The points s + t d; s is approximately the line's closest point to the form's middle.
template <class W>
struct Line {
  Vec3<W> s, d;
  W dd, inv;  ///< d.d and 1 / d.d
  /// Bounds the error, across the line and along it, of the line's points with |t| |d| up to the
  /// form's size. Includes the rounding of s and of a form's operations.
  W E;
  /// If the square of a component of d is less than this, the component counts as zero: over the
  /// length of the form, such a component moves the line by less than E / 4.
  W parallel;

  Line reversed() const { return {s, -d, dd, inv, E, parallel}; }
};

/// Entry of a line into a form. Sizes of the form are plain numbers if all lanes have the same
/// form, otherwise W. A lane that neither hits nor misses is undecided.
template <class W>
struct Entry {
  Mask<W> hit = Mask<W>(false), miss = Mask<W>(false);
  W t = W(0), e = W(0);  ///< hit: the parameter lies in [t - e, t + e]
  /// Hit: outward unit normal. Miss: normal of a plane between line and form, towards the line, of
  /// any length.
  Vec3<W> normal = Vec3<W>::Zero();
};

/// Smaller components of a direction are replaced by this number, to avoid division by zero. A line
/// so nearly parallel to a slab leaves the slab far beyond the form. Lengths of directions are at
/// least 1e-19 in double, 1e-4 in float.
template <class W>
inline constexpr Lane<W> least_component = least_to_square<Lane<W>>;

/// Returns the normal of a plane that is parallel to the line and separates the line from all
/// points below two planes. The line leaves the half-space of `left` before it enters that of
/// `entered`.
template <class W>
Vec3<W> between(const Vec3<W>& entered, const Vec3<W>& left, const Vec3<W>& d) {
  const W inwards = entered.dot(d), outwards = left.dot(d);
  // If the line is parallel to both planes, it is above both.
  const Mask<W> is_along = (inwards == W(0)) & (outwards == W(0));
  return entered * select(is_along, W(1), outwards) - left * inwards;
}

/// Intersection of a line with the slab -half <= z <= half; s and d are the line's z components.
template <class W>
struct Slab {
  W in, out, e;  ///< parameters of entry and exit, and their error
  W facing;      ///< 1 or -1: z of the outward normal where the line leaves

  template <class S>
  Slab(const W& s, const W& d, const S& half, const W& E) {
    using std::abs;
    using std::copysign;
    using std::max;
    const W inv = W(1) / max(abs(d), W(least_component<W>));
    facing = copysign(W(1), d);
    const W at = facing * s;
    in = (W(-half) - at) * inv;
    out = (W(half) - at) * inv;
    e = E * inv;
  }
};

}  // namespace minkray::exact
