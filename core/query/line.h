// SPDX-License-Identifier: MIT
// Input and output of closed forms: a line relative to a nearby point and where it enters, with an
// error bound (docs/forms.md, "Casts with an error bound"). W is double, or a packet of doubles
// with a line in every lane and the same bits as single lines. Or W is a packet of floats, which
// screens candidates (core/screen/screen.h) and may have a form in every lane as well.
#pragma once

#include "core/math/least_to_square.h"
#include "core/math/vec.h"
#include "core/support/exact_form.h"

namespace minkray::exact {

/// The points s + t d; s is about as near to the form's middle as the line comes.
template <class W>
struct Line {
  Vec3<W> s, d;
  W dd, inv;  ///< d.d and 1 / d.d
  /// Bounds the displacement, across the line and along it, of each point with |t| |d| up to the
  /// form's size: covers the rounding of s, and of what a form does with it.
  W E;
  /// A square of a component of d below this counts as zero: it moves the line by less than E / 4.
  W parallel;

  Line reversed() const { return {s, -d, dd, inv, E, parallel}; }
};

/// Entry of a line into a form, whose sizes may be numbers for all lanes or W, one for each. A
/// lane that neither hits nor misses is in doubt.
template <class W>
struct Entry {
  Mask<W> hit = Mask<W>(false), miss = Mask<W>(false);
  W t = W(0), e = W(0);  ///< hit: the parameter lies in [t - e, t + e]
  /// Hit: outward, of unit length. Miss: of a plane between line and form, pointing to the line, of
  /// any length.
  Vec3<W> normal = Vec3<W>::Zero();
};

/// Below it a direction's component is taken for this: what runs so nearly along a slab leaves it
/// beyond all numbers that count, and does not divide by zero. Directions' lengths are from 1e-19
/// in double, from 1e-4 in float.
template <class W>
inline constexpr Lane<W> least_component = least_to_square<Lane<W>>;

/// The normal of a plane along the line that separates it from what lies below both of two planes:
/// one that the line crosses inwards, after it has left the other one.
template <class W>
Vec3<W> between(const Vec3<W>& entered, const Vec3<W>& left, const Vec3<W>& d) {
  const W inwards = entered.dot(d), outwards = left.dot(d);
  // If the line runs along both, it is above either.
  const Mask<W> is_along = (inwards == W(0)) & (outwards == W(0));
  return entered * select(is_along, W(1), outwards) - left * inwards;
}

/// One pair of parallel planes, z = -half and z = half, as a line with these components sees it.
template <class W>
struct Slab {
  W in, out, e;  ///< the parameters of entry and exit, and their error
  W facing;      ///< 1 or -1: the outward normal where the line leaves

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
