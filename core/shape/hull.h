// SPDX-License-Identifier: MIT
// The convex hull of points: given as a list, or as the vertices of a mesh file.
#pragma once

#include "core/geometry/point_cloud.h"
#include "core/support/declared.h"
#include "core/support/field.h"
#include "core/support/jet.h"

namespace minkray {

struct Hull {
  PointCloud points;

  static constexpr std::string_view name = "hull";
  static constexpr std::string_view doc =
      "The convex hull of points; coplanar, collinear and single points make flat shapes.";
  static constexpr Declared declared = {.facets = true, .support_where = true};
  static constexpr auto fields() {
    return std::tuple{Field{"points", &Hull::points, Unit::length, Range::any,
                            "at least one point, or instead \"file\": an .obj or .stl mesh"}};
  }

  template <class W>
  Vec3<W> support(const Vec3<W>& n) const {
    return points.support(n);
  }
  template <class W>
  Vec3<W> support_where(const Mask<W>& wanted, const Vec3<W>& n) const {
    return points.support_where(wanted, n);
  }

  template <class W>
  PointJet<W> jet(const Vec3<W>& n) const {
    return {support(n)};
  }
};

}  // namespace minkray
