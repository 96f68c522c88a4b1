// SPDX-License-Identifier: MIT
// The model for polytopes: the hull of up to four vertices. If the ray passes through a triangle of
// these vertices, the triangle is a "portal"; the normal of its plane is the next direction.
// Without a portal, vertices are replaced by balls that touch their supporting planes from inside,
// as on a curved shape; the balls shrink, so that the search ends. If the polytope's facets are
// known, the first portal is the facet that the ray enters.
#pragma once

#include <array>

#include "core/model/entered_facet.h"
#include "core/model/line_cast.h"

namespace minkray {

template <class W, class Core>
class PolytopeModel {
 public:
  using T = Lane<W>;

  struct Feature {
    Vec3<W> c;  ///< relative to s
    W support_function(const Vec3<W>& n) const { return c.dot(n); }
    const Vec3<W>& support_point(const Vec3<W>&) const { return c; }
  };

  PolytopeModel(const Core& core, const Vec3<T>& centre, const Vec3<W>& s, const Vec3<W>& r, T R)
      : core_(core),
        s_(s),
        from_(widen<W>(centre) + s),
        frame_(r),
        rounding_(tolerance::model_rounding<T> * R),
        ball_(first_ball * R),
        least_ball_(least_ball * R) {}

  Vec3<W> to_frame(const Vec3<W>& n) const { return frame_.into(n); }
  Vec3<W> to_shape(const Vec3<W>& n) const { return first_.to_shape(n, frame_); }
  W against_ray(const Vec3<W>& n) const { return n.z(); }

  Feature support(const Vec3<W>& n, const Mask<W>& wanted) const {
    const auto seen = [&](const Vec3<W>& point) { return frame_.into(point - from_); };
    if constexpr (looks_up) {
      const Mask<W> known = first_.is_known(n), open = wanted & !known;
      if (!any(open)) return {first_.corner()};
      const Vec3<W> corner = seen(core_.support_where(open, frame_.out_of(n)));
      return {select<W>(known, first_.corner(), corner)};
    } else {
      return {seen(core_.template support<W>(frame_.out_of(n)))};
    }
  }

  /// Begins on the facet that the ray enters, if facets are known.
  ModelHit<W> begin(const Vec3<T>& half_extents) {
    ModelHit<W> hit;
    EnteredFacet<W> facet;
    if constexpr (Known::some)
      if (Known::known(core_)) facet = Known::entered(core_, half_extents, s_, from_, frame_);
    hit.m = facet.normal;
    if (!all(facet.known))
      hit.m = select<W>(facet.known, hit.m,
                        frame_.into(normal_on_extents<W>(half_extents, s_, Vec3<W>(-frame_.z))));
    if (!any(facet.enters)) return hit;
    first_ = FacetPlane<W>(facet);
    for (std::size_t k = 0; k < 3; ++k)
      kept_[k] = {facet.neighbours[k], hit.m, facet.there[k], facet.there[k]};
    const Mask<W> ahead = hit.m.z() > W(0);
    hit.certain = facet.enters & ahead;
    hit.height = facet.height;
    return hit;
  }

  ModelHit<W> step(const Feature& feature, const Vec3<W>& n, int iteration) {
    using std::max;
    using std::min;
    const Vec3<W>& newest = feature.c;
    // Removes an older copy of the newest vertex.
    ModelHit<W> hit;
    for (Kept& kept : kept_) {
      const Mask<W> same = kept.valid & (kept.c.x() == newest.x()) & (kept.c.y() == newest.y()) &
                           (kept.c.z() == newest.z());
      hit.repeated |= same;
      kept.valid &= !same;
    }
    hit.certain = portal(newest, hit.repeated, hit.m);
    if (!all(hit.certain)) {
      const Mask<W> open = !hit.certain;
      ball_ = select(open & hit.repeated, W(ball_ * W(T(0.1))), ball_);
      if (iteration >= 3) ball_ = select(open, W(ball_ * W(T(0.5))), ball_);
      const Vec3<W> m = rounded(newest, n);
      hit.m = select<W>(hit.certain, hit.m, m);
    }
    const W height = newest.dot(hit.m) / select(hit.m.z() > W(0), hit.m.z(), W(1));
    hit.height = select(hit.certain, min(max(height, lowest_), highest_), height);
    replace(newest, n, iteration);
    return hit;
  }

 private:
  struct Kept {
    Vec3<W> c = Vec3<W>::Zero();
    Vec3<W> n = Vec3<W>::Zero();  ///< direction in which the vertex was found
    Mask<W> valid = Mask<W>(false);
    Mask<W> carries = Mask<W>(false);  ///< carries the last hit
  };

  /// Considers the triangles of the newest vertex and two kept vertices. Finds the highest of those
  /// that the ray passes through; m is its normal. If the newest vertex was found before, only
  /// rounding prevents progress, so a ray that touches an edge counts as passing through.
  Mask<W> portal(const Vec3<W>& newest, const Mask<W>& repeated, Vec3<W>& m) {
    using std::max;
    using std::min;
    Mask<W> found(false);
    for (Kept& kept : kept_) kept.carries = Mask<W>(false);
    for (std::size_t i = 0; i < 3; ++i) {
      Kept &a = kept_[i], &b = kept_[(i + 1) % 3], &rest = kept_[(i + 2) % 3];
      Mask<W> candidate = a.valid & b.valid & !found;
      if (!any(candidate)) continue;
      Mask<W> passes = passes_between(newest, a.c, b.c);
      if (any(candidate & repeated & !passes))
        passes |=
            repeated & (passes_edge(newest, a.c, rounding_) | passes_edge(newest, b.c, rounding_) |
                        passes_edge(a.c, b.c, rounding_));
      candidate &= passes;
      if (!any(candidate)) continue;
      const Vec3<W> normal = upper_normal(newest, a.c, b.c);
      const Mask<W> beaten = rest.valid & ((rest.c - newest).dot(normal) > rounding_);
      candidate &= normal.z() > W(0);
      candidate &= !beaten;
      m = select<W>(candidate, normal, m);
      // Limits the hit to the heights of the three vertices, since the normal of a sliver is
      // inaccurate.
      lowest_ = select(candidate, min(newest.z(), min(a.c.z(), b.c.z())), lowest_);
      highest_ = select(candidate, max(newest.z(), max(a.c.z(), b.c.z())), highest_);
      a.carries |= candidate;
      b.carries |= candidate;
      found |= candidate;
    }
    return found;
  }

  /// Returns the normal where the ray meets the ball of the newest vertex. If another ball reaches
  /// beyond that plane, returns the normal on the cylinder between the two balls.
  Vec3<W> rounded(const Vec3<W>& newest, const Vec3<W>& n) {
    using std::max;
    using std::sqrt;
    const W ball = select(ball_ < least_ball_, W(0), ball_);
    const Vec3<W> c = newest - n * ball;
    const W depth = ball * ball - (c.x() * c.x() + c.y() * c.y());
    const Vec3<W> alone = unit<W>({-c.x(), -c.y(), sqrt(max(depth, W(0)))});

    W furthest = c.dot(alone) + rounding_;
    Vec3<W> other = c;
    Mask<W> beaten(false);
    for (const Kept& kept : kept_) {
      const Vec3<W> centre = kept.c - kept.n * ball;
      const W h = centre.dot(alone);
      const Mask<W> further = kept.valid & (h > furthest);
      other = select<W>(further, centre, other);
      furthest = select(further, h, furthest);
      beaten |= further;
    }
    if (!any(beaten)) return alone;
    const Vec3<W> e = c - other;
    const W E = e.x() * e.x() + e.y() * e.y();
    beaten &= E > W(0);
    const W length = sqrt(select(E > W(0), E, W(1)));
    const Vec3<W> t(-e.y() / length, e.x() / length, W(0));
    const Vec3<W> w = unit<W>({-e.x() * e.z(), -e.y() * e.z(), E});
    const W L = t.x() * c.x() + t.y() * c.y();
    const W den = ball * ball - L * L;
    const Vec3<W> onto = unit<W>(Vec3<W>(w * sqrt(max(den, W(0))) - t * L));
    const Vec3<W> m = select<W>(den > W(0), onto, select<W>(L > W(0), Vec3<W>(-t), t));
    return select<W>(beaten, m, alone);
  }

  /// Stores the newest vertex in a free place, or replaces a vertex that does not carry the hit.
  void replace(const Vec3<W>& newest, const Vec3<W>& n, int iteration) {
    Mask<W> placed(false);
    const auto place = [&](Kept& kept, const Mask<W>& here) {
      kept.c = select<W>(here, newest, kept.c);
      kept.n = select<W>(here, n, kept.n);
      kept.valid |= here;
      placed |= here;
    };
    for (Kept& kept : kept_) place(kept, (!kept.valid) & (!placed));
    if (all(placed)) return;
    for (int i = 0; i < 3; ++i) {
      Kept& kept = kept_[static_cast<std::size_t>((iteration + i) % 3)];
      place(kept, (!kept.carries) & (!placed));
    }
  }

  /// Radii in units of R. Balls smaller than least_ball count as points.
  static constexpr T first_ball = T(1) / T(2);
  static constexpr T least_ball = T(1) / T(1024);

  using Known = Facets<W, Core>;

  /// True if support points in the directions of facets are looked up, which is faster than a call.
  static constexpr bool looks_up = declared_by<Core>.support_where;

  const Core& core_;
  Vec3<W> s_, from_;
  RayFrame<W> frame_;
  W rounding_;
  W ball_, least_ball_;
  FacetPlane<W> first_;
  W lowest_ = W(0), highest_ = W(0);  ///< heights of the portal's vertices
  std::array<Kept, 3> kept_;
};

}  // namespace minkray
