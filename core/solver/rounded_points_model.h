// SPDX-License-Identifier: MIT
// The model for rounded polytopes: the hull of up to four balls of one radius around vertices.
#pragma once

#include "core/solver/entered_facet.h"
#include "core/solver/hull_cast.h"
#include "core/solver/line_cast.h"

namespace minkray {

/// `Core` is the polytope, `radius` how far it is rounded.
template <class W, class Core>
class RoundedPointsModel {
 public:
  using T = Lane<W>;

  struct Piece {
    Vec3<W> c;  ///< relative to s
    W radius;
    W reach(const Vec3<W>& n) const {
      return c.dot(n) + radius * (W(T(0.5)) * (W(1) + n.squaredNorm()));
    }
    Vec3<W> spot(const Vec3<W>& n) const { return c + n * radius; }
  };

  RoundedPointsModel(const Core& core, T radius, const Vec3<T>& centre, const Vec3<W>& s,
                     const Vec3<W>& r, T R)
      : core_(core),
        radius_(radius),
        ball_{W(radius)},
        s_(s),
        from_(widen<W>(centre) + s),
        frame_(r),
        rounding_(tolerance::model_rounding<T> * R) {}

  Vec3<W> to_frame(const Vec3<W>& n) const { return frame_.into(n); }
  Vec3<W> to_shape(const Vec3<W>& n) const { return frame_.out_of(n); }
  W against_ray(const Vec3<W>& n) const { return n.z(); }

  Piece support(const Vec3<W>& n) const {
    return {frame_.into(core_.template support<W>(frame_.out_of(n)) - from_), ball_.radius};
  }

  /// Around the facet that the ray enters, if facets are known.
  ModelHit<W> begin(const Vec3<T>& half_extents) {
    ModelHit<W> hit;
    EnteredFacet<W> facet;
    if (Known::known(core_))
      facet = Known::entered(core_, radius_, half_extents, s_, from_, frame_);
    if (all(facet.known))
      hit.m = frame_.into(facet.normal);
    else
      hit.m = frame_.into(select<W>(facet.known, facet.normal,
                                    normal_on_extents<W>(half_extents, s_, Vec3<W>(-frame_.z))));
    const Mask<W> near = Known::grows ? facet.enters : facet.known;
    if (!any(near)) return hit;
    for (std::size_t k = 0; k < Known::neighbour_count; ++k) {
      kept_.c[k] = facet.neighbours[k];
      kept_.valid[k] = near;
    }
    const ModelHit<W> around = with({facet.corner, ball_.radius});
    for (Mask<W>& valid : kept_.valid) valid &= near;
    const Mask<W> some = near & (around.m.squaredNorm() > W(0));
    hit.m = select<W>(some, around.m, hit.m);
    hit.height = around.height;
    hit.certain = around.certain & some;
    return hit;
  }

  ModelHit<W> step(const Piece& piece, const Vec3<W>&, int) {
    // Forget an older copy of the newest piece; it will be kept in a free place.
    Mask<W> repeated(false);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3<W>& c = kept_.c[k];
      const Mask<W> same =
          kept_.valid[k] & (c.x() == piece.c.x()) & (c.y() == piece.c.y()) & (c.z() == piece.c.z());
      repeated |= same;
      kept_.valid[k] &= !same;
    }
    ModelHit<W> hit = with(piece);
    hit.repeated = repeated;
    return hit;
  }

 private:
  using Known = Facets<W, Core>;

  /// The hit on the hull of the pieces that are kept and this one, which is none of them.
  ModelHit<W> with(const Piece& piece) {
    ModelHit<W> hit;
    const HullCastHit<W> on_hull =
        HullCast<W, RoundBody<W>>(ball_, piece.c, kept_, rounding_).solve();
    hit.m = on_hull.m;
    const Mask<W> ahead = hit.m.z() > W(0);
    hit.certain = on_hull.found & ahead;
    hit.height = piece.reach(hit.m) / select(ahead, hit.m.z(), W(1));

    // Keep the pieces that carry the hit.
    Mask<W> placed(false);
    for (std::size_t k = 0; k < 3; ++k) {
      kept_.valid[k] &= on_hull.weights[k] != W(0);
      const Mask<W> here = (!kept_.valid[k]) & (!placed);
      kept_.c[k] = select<W>(here, piece.c, kept_.c[k]);
      kept_.valid[k] |= here;
      placed |= here;
    }
    return hit;
  }

  const Core& core_;
  T radius_;
  RoundBody<W> ball_;
  Vec3<W> s_, from_;
  RayFrame<W> frame_;
  W rounding_;
  Translates<W> kept_;
};

}  // namespace minkray
