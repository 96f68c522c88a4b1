// SPDX-License-Identifier: MIT
// A facet of a polytope that a line enters, and its supporting plane. Both are guesses, which
// solvers verify by the support mapping or by results stored with the polytope.
#pragma once

#include "core/model/line_cast.h"
#include "core/query/ray_frame.h"
#include "core/support/declared.h"

namespace minkray {

/// The facet that a line enters, in the ray's frame, where the ray runs down the z axis.
template <class W>
struct EnteredFacet {
  Mask<W> known = Mask<W>(false);  ///< the other members are valid
  /// The line passes through the facet, if the facet is supported. For Facets::around, through the
  /// facet moved outwards.
  Mask<W> enters = Mask<W>(false);
  /// True if it is proven that no point of the polytope is further along the normal than `corner`.
  Mask<W> supported = Mask<W>(false);
  /// Outward unit normal of the facet. For a line that misses, a direction perpendicular to the
  /// line, in which the line lies beyond the polytope.
  Vec3<W> normal = Vec3<W>::Zero();
  Vec3<W> in_shape = Vec3<W>::Zero();  ///< the normal in the shape's frame
  W height = W(0);                     ///< if the line enters: at lambda = -height
  Vec3<W> corner = Vec3<W>::Zero();    ///< a corner of the facet
  /// Adjacent corners.
  std::array<Vec3<W>, 3> neighbours = {Vec3<W>::Zero(), Vec3<W>::Zero(), Vec3<W>::Zero()};
  std::array<Mask<W>, 3> there = {Mask<W>(false), Mask<W>(false),
                                  Mask<W>(false)};  ///< mask of the valid neighbours
};

/// Recognises the normal of the facet that a line enters, and stores the facet's supporting plane.
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

  /// Converts n to the shape's frame. The facet's normal is stored in that frame, since conversion
  /// there and back would round it.
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

/// Finds facets of a core. This template is for polytopes without stored facets. Specialisations
/// have `some`, true if facets are stored; `entered`, which returns the facet that the line enters;
/// and, except for boxes, `around`, which returns a facet near the point where the line meets the
/// polytope grown by a radius. The line passes through `from`, which is at s relative to the
/// bounding ball's centre.
template <class W, class Core>
struct Facets {
  static constexpr bool some = false;
};

}  // namespace minkray
