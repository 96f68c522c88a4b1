// SPDX-License-Identifier: MIT
// The model for rounded polytopes: the hull of up to four balls of one radius around vertices.
#pragma once

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
        ball_{W(radius)},
        from_(widen<W>(centre) + s),
        frame_(r),
        rounding_(tolerance::model_rounding<T> * R) {}

  Vec3<W> to_frame(const Vec3<W>& n) const { return frame_.into(n); }
  Vec3<W> to_shape(const Vec3<W>& n) const { return frame_.out_of(n); }
  W against_ray(const Vec3<W>& n) const { return n.z(); }

  Piece support(const Vec3<W>& n) const {
    return {frame_.into(core_.template support<W>(frame_.out_of(n)) - from_), ball_.radius};
  }

  ModelHit<W> step(const Piece& piece, const Vec3<W>&, int) {
    // Forget an older copy of the newest piece; it will be kept in a free place below.
    ModelHit<W> hit;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3<W>& c = kept_.c[k];
      const Mask<W> same =
          kept_.valid[k] & (c.x() == piece.c.x()) & (c.y() == piece.c.y()) & (c.z() == piece.c.z());
      hit.repeated |= same;
      kept_.valid[k] &= !same;
    }
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

 private:
  const Core& core_;
  RoundBody<W> ball_;
  Vec3<W> from_;
  RayFrame<W> frame_;
  W rounding_;
  Translates<W> kept_;
};

}  // namespace minkray
