// SPDX-License-Identifier: MIT
// The model for smooth shapes: the ellipsoid of the newest jet, which only osculates the shape, and
// its translates for other patches that were found in nearly the same direction. Translates touch
// their supporting planes at their support points. Converges like Newton's method. A step to a
// lower plane is halved; this helps, since the height where the plane cuts the ray is a concave
// function of the direction. Support points prove the hit (`settled`).
#pragma once

#include "core/model/hull_cast.h"
#include "core/model/line_cast.h"
#include "core/support/jet.h"

namespace minkray {

template <class W, class S>
class SmoothModel {
 public:
  using T = Lane<W>;

  struct Feature {
    Vec3<W> s;  ///< the support point, relative to the ray's s
    Mat3<W> F;
    Vec3<W> patch;  ///< the jet's centre, which distinguishes the patches of the surface
    W height;       ///< height of the supporting plane over the origin
    W support_function(const Vec3<W>&) const { return height; }
    const Vec3<W>& support_point(const Vec3<W>&) const { return s; }
  };

  SmoothModel(const S& shape, const Vec3<T>& centre, const Vec3<W>& s, const Vec3<W>& r, T R)
      : shape_(shape),
        s_in_shape_(s),
        from_(widen<W>(centre) + s),
        frame_(r),
        R_(R),
        rounding_(tolerance::model_rounding<T> * R) {}

  Vec3<W> to_frame(const Vec3<W>& n) const { return frame_.into(n); }
  Vec3<W> to_shape(const Vec3<W>& n) const { return frame_.out_of(n); }
  W against_ray(const Vec3<W>& n) const { return n.z(); }

  ModelHit<W> begin(const Vec3<T>& half_extents) const {
    ModelHit<W> hit;
    hit.m = frame_.into(normal_on_extents<W>(half_extents, s_in_shape_, Vec3<W>(-frame_.z)));
    return hit;
  }

  Feature support(const Vec3<W>& n, const Mask<W>&) const {
    const Vec3<W> n_shape = frame_.out_of(n);
    const Jet<W> jet = shape_.template jet<W>(n_shape);
    Feature feature;
    feature.s = frame_.into(jet.support(n_shape) - from_);
    for (int k = 0; k < 3; ++k) feature.F.col(k) = frame_.into(jet.F.col(k));
    feature.patch = jet.c;
    feature.height = feature.s.dot(n);
    return feature;
  }

  ModelHit<W> step(const Feature& feature, const Vec3<W>& n, int iteration) {
    // A vertex has no curvature, so a small ball replaces it.
    const Mask<W> repeated = repeats(feature);
    shrink_ = select(repeated, W(shrink_ * W(T(0.1))), shrink_);
    if (iteration >= 3) shrink_ *= W(T(0.5));
    EllipsoidBody<W> body{feature.F};
    const Mask<W> is_point = feature.F.squaredNorm() == W(0);
    if (any(is_point)) {
      const W ball = select(is_point, W(shrink_ * W(R_)), W(0));
      for (int k = 0; k < 3; ++k) body.F(k, k) += ball;
    }
    const Vec3<W> c = feature.s - body.support_point(n);
    Translates<W> others;
    for (std::size_t k = 0; k < 3; ++k) {
      others.c[k] = s_[k] - body.support_point(n_[k]);
      others.valid[k] = valid_[k] & ((patch_[k] - feature.patch).squaredNorm() > W(0));
    }
    const HullCastHit<W> on_hull =
        HullCast<W, EllipsoidBody<W>>(body, c, others, rounding_).solve();

    ModelHit<W> hit;
    hit.m = on_hull.m;
    const Mask<W> ahead = hit.m.z() > W(0);
    hit.height = select(ahead, on_hull.height, W(0));
    hit.certain = on_hull.found & ahead & settled(feature, n, on_hull);
    hit.inner = Mask<W>(false);
    hit.repeated = repeated;
    keep(feature, n, on_hull);

    step_back(feature, n, hit);
    stay_between(feature, n, hit);
    return hit;
  }

 private:
  /// A direction (x, y, 1), the direction that the model proposes next, and the offset of the
  /// support point from the ray.
  struct Point {
    W x = W(0), y = W(0), to_x = W(0), to_y = W(0), offset_x = W(0), offset_y = W(0);
  };

  static Point pick(const Mask<W>& condition, const Point& a, const Point& b) {
    return {select(condition, a.x, b.x),
            select(condition, a.y, b.y),
            select(condition, a.to_x, b.to_x),
            select(condition, a.to_y, b.to_y),
            select(condition, a.offset_x, b.offset_x),
            select(condition, a.offset_y, b.offset_y)};
  }

  Mask<W> repeats(const Feature& feature) {
    Mask<W> repeated(false);
    for (std::size_t k = 0; k < 3; ++k) {
      const Mask<W> same = valid_[k] & (s_[k].x() == feature.s.x()) & (s_[k].y() == feature.s.y()) &
                           (s_[k].z() == feature.s.z());
      repeated |= same;
      valid_[k] &= !same;
    }
    return repeated;
  }

  /// True if the hit is proven. The carriers' support points, weighted as in the hit, give a point
  /// p of the shape, which must be nearly on the newest supporting plane and nearly on the ray.
  /// Further iterations gain at most half the product of the step and p's distance from the ray.
  Mask<W> settled(const Feature& feature, const Vec3<W>& n, const HullCastHit<W>& on_hull) const {
    using std::sqrt;
    Vec3<W> p = feature.s;
    for (std::size_t k = 0; k < 3; ++k) p += (s_[k] - feature.s) * on_hull.weights[k];
    const W offset = sqrt(p.x() * p.x() + p.y() * p.y());
    const W below = feature.height - n.dot(p);
    return (below + offset * (on_hull.m - n).norm() <= W(tolerance::jet_gap<T> * R_)) &
           (offset <= W(model_reach * R_));
  }

  /// Shortens a step that leads to a lower plane or clearly overshoots. The new direction is
  /// between the two ends of the step: there the support point's offset from the ray has no
  /// component along the step. The direction is interpolated (Hermite) as a function of the offset,
  /// from the values and Newton steps at both ends. This function is smooth even where curvature
  /// vanishes; its inverse is not.
  void step_back(const Feature& feature, const Vec3<W>& n, ModelHit<W>& hit) {
    using std::abs;
    using std::max;
    using std::min;
    using std::sqrt;
    const Mask<W> cuts = n.z() > W(tolerance::model_rounding<T>);
    const W z = select(cuts, n.z(), W(1));
    const W lambda = select(cuts, W(-feature.height / z), W(-infinity));
    const Mask<W> onto = hit.m.z() > W(tolerance::model_rounding<T>);
    const W m_z = select(onto, hit.m.z(), W(1)), x = n.x() / z, y = n.y() / z;
    const Point here{x,
                     y,
                     select(onto, W(hit.m.x() / m_z), W(x + hit.m.x() * W(far_step))),
                     select(onto, W(hit.m.y() / m_z), W(y + hit.m.y() * W(far_step))),
                     feature.s.x(),
                     feature.s.y()};
    const Mask<W> worse = lambda < best_lambda_;

    // Interpolates along the step that the model proposes now.
    W e_x = here.to_x - here.x, e_y = here.to_y - here.y;
    const W length = sqrt(e_x * e_x + e_y * e_y);
    e_x /= length;
    e_y /= length;
    const auto along = [&](const W& v_x, const W& v_y) { return v_x * e_x + v_y * e_y; };
    const W before = along(best_.offset_x, best_.offset_y);
    const W now = along(here.offset_x, here.offset_y);
    const Mask<W> overshoots = cuts & onto & (before * now < W(0)) &
                               (abs(now) > abs(before) * W(T(0.25))) & !(worse & was_back_);
    const Mask<W> back = (!hit.certain) & (worse | overshoots) & (best_lambda_ > W(-infinity));
    if (any(back)) {
      const W from = along(best_.x, best_.y), to = along(here.x, here.y);
      const W rise = now - before, u = -before / rise;
      const W first = -along(best_.to_x - best_.x, best_.to_y - best_.y) / before * rise;
      const W last = -length / now * rise;
      const W there = from + (to - from) * u * u * (W(3) - W(2) * u) +
                      u * (W(1) - u) * (W(1) - u) * first - u * u * (W(1) - u) * last;
      const Mask<W> fits = overshoots & (there > min(from, to)) & (there < max(from, to));
      // Perpendicular to the step, follows the model. If that is worse, takes a smaller part of the
      // best direction's own step.
      const W aside = here.x * -e_y + here.y * e_x;
      damping_ = select(back & worse, W(damping_ * W(T(0.5))), damping_);
      const W to_x = select(fits, W(there * e_x - aside * e_y),
                            W(best_.x + (best_.to_x - best_.x) * damping_));
      const W to_y = select(fits, W(there * e_y + aside * e_x),
                            W(best_.y + (best_.to_y - best_.y) * damping_));
      hit.m = select<W>(back & (fits | worse), unit<W>({to_x, to_y, W(1)}), hit.m);
    }
    was_back_ = back;
    damping_ = select(worse, damping_, W(1));
    best_ = pick(worse, best_, here);
    best_lambda_ = select(worse, best_lambda_, lambda);
  }

  /// For directions perpendicular to the ray (n.z = 0) in which the ray misses the model, too.
  /// Finds the direction on this circle with the least reach, where the derivative of the reach
  /// changes sign. The search keeps an arc whose ends have different signs. If a step leaves the
  /// arc, or spans over half of it, the secant method gives the step.
  void stay_between(const Feature& feature, const Vec3<W>& n, ModelHit<W>& hit) {
    using std::abs;
    const Mask<W> on_circle = (abs(n.z()) <= W(tolerance::model_rounding<T>)) &
                              !(hit.m.z() > W(tolerance::model_rounding<T>));
    if (!any(on_circle)) return;
    const W slope = n.x() * feature.s.y() - n.y() * feature.s.x();  // counter-clockwise
    const Mask<W> falls = on_circle & (slope < W(0)), rises = on_circle & (slope > W(0));
    // If one end of the arc stays twice, its slope is halved (Illinois variant of the secant
    // method).
    rising_.slope = select(falls & fell_, W(rising_.slope * W(T(0.5))), rising_.slope);
    falling_.slope = select(rises & rose_, W(falling_.slope * W(T(0.5))), falling_.slope);
    fell_ = falls;
    rose_ = rises;
    falling_.set(falls, n, slope);
    rising_.set(rises, n, slope);

    const W arc = (rising_.n - falling_.n).squaredNorm();
    const Mask<W> outside =
        !((cross_2d(falling_.n, hit.m) > W(0)) & (cross_2d(hit.m, rising_.n) > W(0)) &
          ((hit.m - n).squaredNorm() <= W(T(0.25)) * arc));
    const Mask<W> between = on_circle & falling_.there & rising_.there & outside &
                            (cross_2d(falling_.n, rising_.n) > W(0));
    const Vec3<W> secant = falling_.n * rising_.slope - rising_.n * falling_.slope;
    if (any(between)) hit.m = select<W>(between, unit<W>({secant.x(), secant.y(), W(0)}), hit.m);
  }

  void keep(const Feature& feature, const Vec3<W>& n, const HullCastHit<W>& on_hull) {
    Mask<W> placed(false);
    for (std::size_t k = 0; k < 3; ++k) {
      valid_[k] &= on_hull.weights[k] != W(0);
      const Mask<W> here = (!valid_[k]) & (!placed);
      s_[k] = select<W>(here, feature.s, s_[k]);
      n_[k] = select<W>(here, n, n_[k]);
      patch_[k] = select<W>(here, feature.patch, patch_[k]);
      valid_[k] |= here;
      placed |= here;
    }
  }

  /// A direction perpendicular to the ray.
  struct OnCircle {
    Vec3<W> n = Vec3<W>::Zero();
    W slope = W(0);
    Mask<W> there = Mask<W>(false);
    void set(const Mask<W>& lanes, const Vec3<W>& direction, const W& its_slope) {
      n = select<W>(lanes, direction, n);
      slope = select(lanes, its_slope, slope);
      there |= lanes;
    }
  };

  /// Distance from the ray, in units of R, up to which an osculating ellipsoid is trusted (cbrt
  /// epsilon).
  inline static const T model_reach = std::cbrt(tolerance::epsilon<T>);
  /// Length of a step if the model's own step would have led past the shape.
  static constexpr T far_step = T(4);
  static constexpr T infinity = std::numeric_limits<T>::infinity();

  const S& shape_;
  Vec3<W> s_in_shape_, from_;
  RayFrame<W> frame_;
  T R_;
  W rounding_;
  W shrink_ = W(T(0.5));
  std::array<Vec3<W>, 3> s_ = {Vec3<W>::Zero(), Vec3<W>::Zero(), Vec3<W>::Zero()};
  std::array<Vec3<W>, 3> n_ = {Vec3<W>::Zero(), Vec3<W>::Zero(), Vec3<W>::Zero()};
  std::array<Vec3<W>, 3> patch_ = {Vec3<W>::Zero(), Vec3<W>::Zero(), Vec3<W>::Zero()};
  W best_lambda_ = W(-infinity);
  Point best_;
  Mask<W> was_back_ = Mask<W>(false);
  W damping_ = W(1);
  OnCircle falling_, rising_;
  Mask<W> fell_ = Mask<W>(false), rose_ = Mask<W>(false);
  std::array<Mask<W>, 3> valid_ = {Mask<W>(false), Mask<W>(false), Mask<W>(false)};
};

}  // namespace minkray
