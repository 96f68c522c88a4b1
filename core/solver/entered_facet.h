// SPDX-License-Identifier: MIT
// Where a line enters a polytope whose facets are known: a box between its slabs, a hull by walking
// from facet to facet. A guess for the solvers, which ask the support mapping whether it is right.
#pragma once

#include "core/shape/box.h"
#include "core/shape/hull.h"
#include "core/solver/line_cast.h"
#include "core/solver/ray_frame.h"

namespace minkray {

/// In the ray's frame (the ray runs down the z axis), but for `normal`, which is in the shape's.
template <class W>
struct EnteredFacet {
  Mask<W> known = Mask<W>(false);   ///< there is an answer
  Mask<W> enters = Mask<W>(false);  ///< the line passes through the facet
  /// Outward, of unit length: the facet's. Of a line that passes by, one at right angles to it in
  /// which the line lies beyond the polytope.
  Vec3<W> normal;
  Vec3<W> corner;                     ///< the facet's corner that is nearest to the line
  std::array<Vec3<W>, 3> neighbours;  ///< corners beside it, as many as Facets has
};

/// Of a polytope without known facets. The others have the same members; `grows` says that
/// `entered` is about the polytope grown by the radius, in all directions or at least its facets'.
template <class W, class Core>
struct Facets {
  static constexpr std::size_t neighbour_count = 0;
  static constexpr bool grows = false;
  static bool known(const Core&) { return false; }
  static EnteredFacet<W> entered(const Core&, Lane<W>, const Vec3<Lane<W>>&, const Vec3<W>&,
                                 const Vec3<W>&, const RayFrame<W>&) {
    return {};
  }
};

template <class W>
struct Facets<W, Box<Lane<W>>> {
  using T = Lane<W>;
  static constexpr std::size_t neighbour_count = 3;
  static constexpr bool grows = true;
  static bool known(const Box<T>&) { return true; }

  /// Of the box grown by `radius`. The line passes `from`, which is s from the ball's centre.
  static EnteredFacet<W> entered(const Box<T>& box, T radius, const Vec3<T>&, const Vec3<W>&,
                                 const Vec3<W>& from, const RayFrame<W>& frame) {
    using std::abs;
    using std::copysign;
    const Vec3<W> r = -frame.z;
    const W infinity = W(std::numeric_limits<T>::infinity());
    W last_in = -infinity, first_out = infinity, in_slope = W(1), out_slope = W(1);
    Vec3<W> in_normal = Vec3<W>::Zero(), out_normal = Vec3<W>::Zero();
    for (int axis = 0; axis < 3; ++axis) {
      const W h = W(box.half_extents[axis] + radius), slope = abs(r[axis]);
      const W side = copysign(W(1), r[axis]), along = from[axis] * side;
      const Mask<W> crosses = slope > W(0), beside = abs(along) > h;
      const W safe = select(crosses, slope, W(1));
      const W in = select(crosses, W((-h - along) / safe), select(beside, infinity, W(-infinity)));
      const W out = select(crosses, W((h - along) / safe), infinity);
      const W outward = select(crosses, W(-side), copysign(W(1), from[axis]));
      const Mask<W> later = in > last_in, sooner = out < first_out;
      last_in = select(later, in, last_in);
      first_out = select(sooner, out, first_out);
      in_slope = select(later, slope, in_slope);
      out_slope = select(sooner, slope, out_slope);
      for (int k = 0; k < 3; ++k) {
        in_normal[k] = select(later, k == axis ? outward : W(0), in_normal[k]);
        out_normal[k] = select(sooner, k == axis ? side : W(0), out_normal[k]);
      }
    }
    EnteredFacet<W> facet;
    facet.known = Mask<W>(true);
    facet.enters = last_in <= first_out;
    facet.normal = in_normal;
    if (!all(facet.enters))
      facet.normal = select<W>(facet.enters, in_normal,
                               unit<W>(Vec3<W>(in_normal * out_slope + out_normal * in_slope)));
    const Vec3<W> at = from + r * select(abs(last_in) < infinity, last_in, W(0));
    Vec3<W> corner;
    for (int k = 0; k < 3; ++k)
      corner[k] =
          copysign(W(box.half_extents[k]), select(in_normal[k] != W(0), in_normal[k], at[k]));
    facet.corner = frame.into(corner - from);
    for (int k = 0; k < 3; ++k) {
      Vec3<W> other = corner;
      other[k] = -corner[k];
      facet.neighbours[static_cast<std::size_t>(k)] = frame.into(other - from);
    }
    return facet;
  }
};

template <class W>
struct Facets<W, Hull<Lane<W>>> {
  using T = Lane<W>;
  static constexpr std::size_t neighbour_count = 2;
  static constexpr bool grows = false;
  static bool known(const Hull<T>& hull) { return hull.points.facets() != nullptr; }

  /// The line passes `from`, which is s from the ball's centre. Seen along the ray the facets that
  /// face it are a triangulation; from one that is likely to be near, the walk leaves each triangle
  /// by the edge that the line is furthest beyond (Devillers, Pion and Teillaud, "Walking in a
  /// Triangulation", 2002). Where that leads to a facet that faces away, the edge is on the outline
  /// and the line passes by.
  static EnteredFacet<W> entered(const Hull<T>& hull, T, const Vec3<T>& half_extents,
                                 const Vec3<W>& s, const Vec3<W>& from, const RayFrame<W>& frame) {
    const FacetMesh<T>& mesh = *hull.points.facets();
    const Vec3<W> start =
        normal_on_extents<W>(half_extents, s, Vec3<W>(-frame.z)) + frame.z * W(towards_ray);

    EnteredFacet<W> facet;
    W at = mesh.facing(start), found = at;
    Mask<W> open = Mask<W>(true), stepped = Mask<W>(false), beside = Mask<W>(false);
    Vec3<W> outline = Vec3<W>::Zero();
    std::array<Vec3<W>, 3> corners = {Vec3<W>::Zero(), Vec3<W>::Zero(), Vec3<W>::Zero()};
    for (int step = 0; step < max_steps; ++step) {
      std::array<Vec3<W>, 3> p;
      for (std::size_t k = 0; k < 3; ++k)
        p[k] = frame.into(gather<W>(at, [&](std::size_t i) { return mesh[i].corners[k]; }) - from);
      const W a = cross_2d(p[0], p[1]), b = cross_2d(p[1], p[2]), c = cross_2d(p[2], p[0]);
      const Mask<W> faces = open & (a + b + c > W(0));
      beside |= open & stepped & !faces;
      open = faces;
      for (std::size_t k = 0; k < 3; ++k) corners[k] = select<W>(open, p[k], corners[k]);
      found = select(open, at, found);
      facet.known |= open;
      const Mask<W> within = open & (a >= W(0)) & (b >= W(0)) & (c >= W(0));
      facet.enters |= within;
      open &= !within;
      if (!any(open)) break;

      const Mask<W> by_b = b < a, by_c = (c < a) & (c < b);
      const Vec3<W> begin = select<W>(by_c, p[2], select<W>(by_b, p[1], p[0]));
      const Vec3<W> end = select<W>(by_c, p[0], select<W>(by_b, p[2], p[1]));
      outline = select<W>(open, Vec3<W>(end.y() - begin.y(), begin.x() - end.x(), W(0)), outline);
      const Vec3<W> next = gather<W>(at, [&](std::size_t i) {
        const auto& neighbours = mesh[i].neighbours;
        return Vec3<T>(T(neighbours[0]), T(neighbours[1]), T(neighbours[2]));
      });
      at = select(open, select(by_c, next.z(), select(by_b, next.y(), next.x())), at);
      stepped |= open;
    }

    facet.normal =
        gather<W>(found, [&](std::size_t i) { return Vec3<T>(mesh[i].normal.template cast<T>()); });
    if (any(beside)) facet.normal = select<W>(beside, frame.out_of(unit<W>(outline)), facet.normal);
    // The nearest corner comes first.
    const auto off = [](const Vec3<W>& p) { return p.x() * p.x() + p.y() * p.y(); };
    facet.corner = corners[0];
    W least = off(corners[0]);
    facet.neighbours = {corners[1], corners[2], corners[2]};
    for (std::size_t k = 1; k < 3; ++k) {
      const W squared = off(corners[k]);
      const Mask<W> nearer = squared < least;
      least = select(nearer, squared, least);
      const Vec3<W> before = facet.corner;
      facet.corner = select<W>(nearer, corners[k], before);
      facet.neighbours[k - 1] = select<W>(nearer, before, facet.neighbours[k - 1]);
    }
    return facet;
  }

 private:
  /// A start that faces the ray for sure is not as near, but near the outline better than one which
  /// does not.
  static constexpr T towards_ray = T(0.5);
  /// Walks of hulls with thousands of facets were seen to take up to 20; only rounding makes more.
  static constexpr int max_steps = 64;
};

}  // namespace minkray
