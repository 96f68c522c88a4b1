// SPDX-License-Identifier: MIT
// The model for all other shapes: the hull of up to four sums of ellipsoids. This hull has no
// closed form for the hit, so Newton's method finds it, without support calls (sums_cast.h).
// docs/forms.md derives it.
#pragma once

#include "core/model/line_cast.h"
#include "core/model/sums_cast.h"

namespace minkray {

template <class W>
class SumsModel {
 public:
  using T = Lane<W>;

  using Feature = SumFeature<W>;

  SumsModel(const Shape& shape, const Vec3<T>& centre, const Vec3<W>& s, const Vec3<W>& r, T R)
      : shape_(shape), s_(s), from_(widen<W>(centre) + s), frame_(r), R_(R) {}

  Vec3<W> to_frame(const Vec3<W>& n) const { return frame_.into(n); }
  Vec3<W> to_shape(const Vec3<W>& n) const { return frame_.out_of(n); }
  W against_ray(const Vec3<W>& n) const { return n.z(); }

  ModelHit<W> begin(const Vec3<T>& half_extents) {
    surrogate_ = turned(widen<W, T>(Mat3<T>(half_extents.asDiagonal())));
    ModelHit<W> hit;
    hit.m = frame_.into(normal_on_extents<W>(half_extents, s_, Vec3<W>(-frame_.z)));
    return hit;
  }

  Feature support(const Vec3<W>& n, const Mask<W>&) const {
    const EllipsoidSum<W> in_shape = touching_sum<W>(shape_, frame_.out_of(n));
    Feature feature{{}, n};
    feature.sum.patch = in_shape.patch;
    feature.sum.c = frame_.into(in_shape.c - from_);
    feature.sum.s = frame_.into(in_shape.s - from_);
    feature.sum.exact = in_shape.exact;
    feature.sum.used = in_shape.used;
    for (std::size_t k = 0; k < in_shape.used; ++k) feature.sum.F[k] = turned(in_shape.F[k]);
    return feature;
  }

  ModelHit<W> step(const Feature& feature, const Vec3<W>& n, int iteration) {
    ModelHit<W> hit;
    hit.repeated = features_.add(feature, n);
    shrink_ = select(hit.repeated, W(shrink_ * W(T(0.1))), shrink_);
    if (iteration >= 3) shrink_ *= W(T(0.5));
    const SumsCast<W> cast(features_, R_, surrogate_, shrink_);
    SumsHit<W> found = cast.solve(n);
    // Ellipsoids that osculate in other directions may be wrong here, so the search may stop at a
    // direction that is not the hit's.
    const Mask<W> stalls =
        (!found.certain) & ((found.m - n).squaredNorm() <= W(tolerance::epsilon<T>));
    if (any(stalls)) {
      const Mask<W> flattened = features_.flatten_osculating(stalls);
      if (any(flattened)) found = pick(flattened, cast.solve(n), found);
    }
    hit.m = found.m;
    hit.height = found.height;
    hit.certain = found.certain;
    hit.inner = found.exact;
    features_.keep(found.weights);
    return hit;
  }

 private:
  Mat3<W> turned(const Mat3<W>& F) const {
    Mat3<W> into;
    for (int k = 0; k < 3; ++k) into.col(k) = frame_.into(F.col(k));
    return into;
  }

  const Shape& shape_;
  Vec3<W> s_, from_;
  RayFrame<W> frame_;
  T R_;
  Mat3<W> surrogate_;  ///< ellipsoid with the shape's extents that replaces points
  W shrink_ = W(T(0.5));
  SumFeatures<W> features_;
};

}  // namespace minkray
