// SPDX-License-Identifier: MIT
// A facet of a polytope that a line enters, and its supporting plane. A guess for the solvers,
// which verify it by the support mapping, or by results stored when the polytope was made.
#pragma once

#include "core/model/line_cast.h"
#include "core/query/ray_frame.h"
#include "core/support/declared.h"

namespace minkray {

/// Expressed in the ray's frame: the ray runs down the z axis.
template <class W>
struct EnteredFacet {
  Mask<W> known = Mask<W>(false);  ///< there is an answer
  /// The line passes through the facet; of `around`, through the facet moved outwards, if that is
  /// supported.
  Mask<W> enters = Mask<W>(false);
  /// Known: no point of the polytope is further along the facet's normal than `corner`.
  Mask<W> supported = Mask<W>(false);
  /// Outward normal of the facet, of unit length. For a line that passes by, one at right angles
  /// to it, with the line beyond the polytope in that direction.
  Vec3<W> normal = Vec3<W>::Zero();
  Vec3<W> in_shape = Vec3<W>::Zero();  ///< the normal in the shape's frame
  W height = W(0);                     ///< the line enters at lambda = -height, if it does
  Vec3<W> corner = Vec3<W>::Zero();    ///< one of the facet's
  /// Adjacent corners.
  std::array<Vec3<W>, 3> neighbours = {Vec3<W>::Zero(), Vec3<W>::Zero(), Vec3<W>::Zero()};
  std::array<Mask<W>, 3> there = {Mask<W>(false), Mask<W>(false),
                                  Mask<W>(false)};  ///< mask of the valid ones
};

/// The supporting plane of the facet that a line enters, to know it again.
template <class W>
class FacetPlane {
 public:
  FacetPlane() = default;
  explicit FacetPlane(const EnteredFacet<W>& facet)
      : normal_(select<W>(facet.enters, facet.normal, Vec3<W>(Vec3<W>::Zero()))),
        in_shape_(select<W>(facet.enters, facet.in_shape, Vec3<W>(Vec3<W>::Zero()))),
        corner_(facet.corner),
        supported_(facet.enters & facet.supported) {}

  /// True if n is the facet's normal, and `corner` the polytope's support point in that direction.
  Mask<W> is_known(const Vec3<W>& n) const { return supported_ & is_normal(n); }
  const Vec3<W>& corner() const { return corner_; }

  /// n in the shape's frame: there and back, the facet's normal would be rounded.
  Vec3<W> to_shape(const Vec3<W>& n, const RayFrame<W>& frame) const {
    return select<W>(is_normal(n), in_shape_, frame.out_of(n));
  }

 private:
  Mask<W> is_normal(const Vec3<W>& n) const {
    return (n.x() == normal_.x()) & (n.y() == normal_.y()) & (n.z() == normal_.z());
  }

  Vec3<W> normal_ = Vec3<W>::Zero(), in_shape_ = Vec3<W>::Zero(), corner_ = Vec3<W>::Zero();
  Mask<W> supported_ = Mask<W>(false);
};

/// This one is for polytopes without any. Others have `known`, whether there is a facet for a line;
/// `entered`, the facet of the polytope; and `around`, one that is near where the line meets the
/// polytope rounded by a radius (but for boxes: closed forms answer them). The line passes `from`,
/// which is s from the bounding ball's centre.
template <class W, class Core>
struct Facets {
  static constexpr bool some = false;
};

}  // namespace minkray
