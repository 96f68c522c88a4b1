// SPDX-License-Identifier: MIT
// The model for hulls of translates of one body: of a ball around each vertex of a polytope, or of
// one ellipsoid. The model is the hull of up to four translates.
#pragma once

#include "core/model/entered_facet.h"
#include "core/model/hull_cast.h"
#include "core/model/line_cast.h"
#include "core/support/jet.h"
#include "core/support/support_where.h"

namespace minkray {

/// One of the translates.
template <class W, class Body>
struct Translate {
  Vec3<W> c;  ///< centre
  Body body;
  W support_function(const Vec3<W>& n) const { return c.dot(n) + body.support_function(n); }
  Vec3<W> support_point(const Vec3<W>& n) const { return c + body.support_point(n); }
};

/// A polytope and its rounding radius.
template <class W, class Polytope>
struct RoundedPolytope {
  using Core = Polytope;
  using Body = RoundBody<W>;

  const Polytope& core;
  Lane<W> radius;

  Body body(const RayFrame<W>&) const { return {W(radius)}; }
  /// Returns the translate that reaches furthest along n, relative to `from`. Lanes that are not
  /// wanted may get any translate. n and the result are in the ray's frame, `from` in the shape's.
  Translate<W, Body> furthest(const Vec3<W>& n, const Mask<W>& wanted, const Vec3<W>& from,
                              const RayFrame<W>& frame) const {
    return {frame.into(support_where<W>(core, wanted, frame.out_of(n)) - from), {W(radius)}};
  }
  static Mask<W> alike(const Body&, const Body&) { return Mask<W>(true); }
};

/// A shape whose jets are assumed to be exact and to differ only in their centres.
template <class W, class S>
struct JetTranslates {
  using Core = void;
  using Body = EllipsoidBody<W>;

  const S& shape;

  Body body(const RayFrame<W>& frame) const {
    return turned(shape.template jet<W>(Vec3<W>(W(1), W(0), W(0))).F, frame);
  }
  Translate<W, Body> furthest(const Vec3<W>& n, const Mask<W>&, const Vec3<W>& from,
                              const RayFrame<W>& frame) const {
    const Jet<W> jet = shape.template jet<W>(frame.out_of(n));
    Translate<W, Body> feature{frame.into(jet.c - from), turned(jet.F, frame)};
    if (!all(jet.exact)) {  // the support point, so that the translate differs from the others
      feature.c = select<W>(jet.exact, feature.c, frame.into(jet.s - from));
      for (int k = 0; k < 3; ++k)
        feature.body.F.col(k) =
            select<W>(jet.exact, Vec3<W>(feature.body.F.col(k)), Vec3<W>(Vec3<W>::Zero()));
    }
    return feature;
  }
  static Mask<W> alike(const Body& a, const Body& b) {
    return (a.F - b.F).cwiseAbs().sum() == W(0);
  }

 private:
  static Body turned(const Mat3<W>& F, const RayFrame<W>& frame) {
    Body body;
    for (int k = 0; k < 3; ++k) body.F.col(k) = frame.into(F.col(k));
    return body;
  }
};

/// `Bodies` selects the kind of translates.
template <class W, class Bodies>
class TranslatesModel {
 public:
  using T = Lane<W>;
  using Body = typename Bodies::Body;

  using Feature = Translate<W, Body>;  ///< relative to s

  TranslatesModel(const Bodies& bodies, const Vec3<T>& centre, const Vec3<W>& s, const Vec3<W>& r,
                  T R)
      : bodies_(bodies),
        s_(s),
        from_(widen<W>(centre) + s),
        frame_(r),
        body_(bodies.body(frame_)),
        rounding_(tolerance::model_rounding<T> * R) {}

  Vec3<W> to_frame(const Vec3<W>& n) const { return frame_.into(n); }
  Vec3<W> to_shape(const Vec3<W>& n) const {
    if constexpr (Known::some)
      return first_.to_shape(n, frame_);
    else
      return frame_.out_of(n);
  }
  W against_ray(const Vec3<W>& n) const { return n.z(); }

  Feature support(const Vec3<W>& n, const Mask<W>& wanted) const {
    if constexpr (Known::some) {
      const Mask<W> known = first_.is_known(n), open = wanted & !known;
      if (!any(open)) return {first_.corner(), body_};
      Feature feature = bodies_.furthest(n, open, from_, frame_);
      feature.c = select<W>(known, first_.corner(), feature.c);
      return feature;
    } else {
      return bodies_.furthest(n, wanted, from_, frame_);
    }
  }

  /// Begins around the facet that the ray enters, if facets are known.
  ModelHit<W> begin(const Vec3<T>& half_extents) {
    ModelHit<W> hit;
    EnteredFacet<W> facet;
    if constexpr (Known::some)
      if (Known::known(bodies_.core))
        facet = Known::around(bodies_.core, bodies_.radius, half_extents, s_, from_, frame_);
    hit.m = facet.normal;
    if (!all(facet.known))
      hit.m = select<W>(facet.known, hit.m,
                        frame_.into(normal_on_extents<W>(half_extents, s_, Vec3<W>(-frame_.z))));
    const Mask<W> near = facet.there[0];
    if (!any(near)) return hit;
    first_ = FacetPlane<W>(facet);
    kept_.c = facet.neighbours;
    kept_.valid = facet.there;
    HullCastHit<W> known;
    known.found = facet.enters | !near;
    known.m = select<W>(facet.enters, facet.normal, known.m);
    known.height = select(facet.enters, facet.height, known.height);
    for (std::size_t k = 0; k < 2; ++k)
      known.weights[k] = select(facet.enters, W(1), known.weights[k]);
    const Feature corner{facet.corner, body_};
    const ModelHit<W> around =
        keep(corner, HullCast<W, Body>(body_, corner.c, kept_, rounding_).solve_from(known));
    for (Mask<W>& valid : kept_.valid) valid &= near;
    const Mask<W> some = near & (around.m.squaredNorm() > W(0));
    hit.m = select<W>(some, around.m, hit.m);
    hit.height = around.height;
    hit.certain = around.certain & some;
    return hit;
  }

  ModelHit<W> step(const Feature& feature, const Vec3<W>&, int) {
    // Removes an older copy of the newest feature; the newest is stored in a free place later.
    Mask<W> repeated(false);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3<W>& c = kept_.c[k];
      const Mask<W> same = kept_.valid[k] & (c.x() == feature.c.x()) & (c.y() == feature.c.y()) &
                           (c.z() == feature.c.z());
      repeated |= same;
      kept_.valid[k] &= !same;
    }
    ModelHit<W> hit = keep(feature, HullCast<W, Body>(body_, feature.c, kept_, rounding_).solve());
    hit.repeated = repeated;
    // If the body is of another kind, this model does not suit the shape.
    const Mask<W> alike = Bodies::alike(feature.body, body_);
    if (!all(alike)) hit.m = select<W>(alike, hit.m, Vec3<W>(Vec3<W>::Zero()));
    hit.certain &= alike;
    return hit;
  }

 private:
  using Known = Facets<W, typename Bodies::Core>;

  /// Returns the hit on the hull of the kept features and `feature`, which must not be one of the
  /// kept. Then keeps only the features that carry the hit.
  ModelHit<W> keep(const Feature& feature, const HullCastHit<W>& on_hull) {
    ModelHit<W> hit;
    hit.m = on_hull.m;
    const Mask<W> ahead = hit.m.z() > W(0);
    hit.certain = on_hull.found & ahead;
    hit.height = select(ahead, on_hull.height, W(0));

    Mask<W> placed(false);
    for (std::size_t k = 0; k < 3; ++k) {
      kept_.valid[k] &= on_hull.weights[k] != W(0);
      const Mask<W> here = (!kept_.valid[k]) & (!placed);
      kept_.c[k] = select<W>(here, feature.c, kept_.c[k]);
      kept_.valid[k] |= here;
      placed |= here;
    }
    return hit;
  }

  Bodies bodies_;
  Vec3<W> s_, from_;
  RayFrame<W> frame_;
  Body body_;
  W rounding_;
  Translates<W> kept_;
  FacetPlane<W> first_;
};

}  // namespace minkray
