// SPDX-License-Identifier: MIT
// The model (line_cast.h) of a sum of ellipsoids. Its support function is a sum of square roots, so
// the hit's direction is found without support calls: by osculating ellipsoids, as in SmoothModel,
// or by ellipsoids that contain the sum and touch it. One support call then proves the hit. If the
// proof fails, the cast continues as SmoothModel.
#pragma once

#include <optional>

#include "core/derived/ellipsoid_sum.h"
#include "core/model/smooth_model.h"

namespace minkray {

template <class W, class S>
class EllipsoidSumModel {
 public:
  using T = Lane<W>;

  struct Feature {
    Vec3<W> s;  ///< the support point, relative to the ray's s
    W support_function(const Vec3<W>& n) const { return s.dot(n); }
    const Vec3<W>& support_point(const Vec3<W>&) const { return s; }
  };

  /// `sum` must represent the shape exactly.
  EllipsoidSumModel(const S& shape, const EllipsoidSum<T>& sum, const Vec3<T>& centre,
                    const Vec3<W>& s, const Vec3<W>& r, T R)
      : shape_(shape), sum_(sum), centre_(centre), s_(s), r_(r), frame_(r), R_(R) {
    c_ = frame_.into(widen<W>(Vec3<T>(sum.c - centre)) - s);
    for (std::size_t i = 0; i < sum.used; ++i)
      for (int k = 0; k < 3; ++k) {
        const Vec3<T> column = sum.F[i].col(k);
        F_[i].col(k) = frame_.into(widen<W>(column));
      }
  }

  const Vec3<W>& to_frame(const Vec3<W>& n) const { return n; }
  const Vec3<W>& to_shape(const Vec3<W>& n) const { return n; }
  W against_ray(const Vec3<W>& n) const { return -n.dot(r_); }

  Feature support(const Vec3<W>& n, const Mask<W>&) const {
    return {Vec3<W>(shape_.template support<W>(n) - (widen<W>(centre_) + s_))};
  }

  ModelHit<W> begin(const Vec3<T>&) {
    ModelHit<W> hit = find();
    hit.m = frame_.out_of(hit.m);
    hit.inner = Mask<W>(false);
    hits_ = hit.certain;
    across_ = !hits_;
    height_ = hit.height;
    return hit;
  }

  /// Called only if the plane does not confirm the hit that `begin` found.
  [[gnu::noinline]] ModelHit<W> step(const Feature& feature, const Vec3<W>& n, int iteration) {
    using std::abs;
    if (!smooth_) smooth_.emplace(shape_, centre_, s_, r_, R_);
    const Vec3<W> n_frame = smooth_->to_frame(n);
    ModelHit<W> hit = smooth_->step(smooth_->support(n_frame, Mask<W>(true)), n_frame, iteration);
    hit.m = smooth_->to_shape(hit.m);
    // Among directions across the ray, the support function is least in the requested direction.
    hit.repeated |= across_;
    // The plane confirms the hit up to rounding, but is so nearly parallel to the ray that rounding
    // is large along the ray. The next direction shows whether the ray is tangent.
    const W missing = feature.support_function(n) - height_ * against_ray(n);
    across_ = hits_ & (abs(missing) <= W(tolerance::jet_gap<T> * R_));
    hits_ = Mask<W>(false);
    if (any(across_)) {
      hit.m = select<W>(across_, unit<W>(Vec3<W>(n - r_ * n.dot(r_))), hit.m);
      hit.certain &= !across_;
      hit.repeated &= !across_;
    }
    return hit;
  }

 private:
  /// A symmetric matrix.
  struct Form {
    W xx, xy, xz, yy, yz, zz;

    void add(const Vec3<W>& v, const W& times) {
      const W x = v.x() * times, y = v.y() * times;
      xx += x * v.x();
      xy += x * v.y();
      xz += x * v.z();
      yy += y * v.y();
      yz += y * v.z();
      zz += v.z() * times * v.z();
    }
    void add(const Form& f, const W& times) {
      xx += f.xx * times;
      xy += f.xy * times;
      xz += f.xz * times;
      yy += f.yy * times;
      yz += f.yz * times;
      zz += f.zz * times;
    }
    W at(const Vec3<W>& m) const {
      return m.x() * (xx * m.x() + W(2) * (xy * m.y() + xz * m.z())) +
             m.y() * (yy * m.y() + W(2) * yz * m.z()) + zz * m.z() * m.z();
    }
  };
  static Form zero() { return {W(0), W(0), W(0), W(0), W(0), W(0)}; }

  /// Same as EllipsoidBody::alone, for the ellipsoid around c_ with the shape matrix A. Uses this
  /// matrix instead of a factor.
  Vec3<W> met(const Form& A) const {
    using std::max;
    using std::sqrt;
    const W det = A.xx * A.yy - A.xy * A.xy;
    const W x = A.yy * c_.x() - A.xy * c_.y(), y = A.xx * c_.y() - A.xy * c_.x();
    const W den = det - (x * c_.x() + y * c_.y());
    const W a_x = A.xy * A.yz - A.yy * A.xz, a_y = A.xy * A.xz - A.xx * A.yz;
    const W volume = sqrt(max(W(A.zz * det + A.xz * a_x + A.yz * a_y), W(0)));
    const W root = sqrt(max(den, W(0)));
    const Mask<W> meets = den > W(0);
    return unit<W>({select(meets, W(a_x * root - x * volume), W(-x)),
                    select(meets, W(a_y * root - y * volume), W(-y)), det * root});
  }

  /// Returns the hit in the ray's frame. If the hit is not certain, m is a direction across the ray
  /// in which the sum hardly reaches the ray, or else the best direction found.
  ModelHit<W> find() const {
    using std::sqrt;
    const W rounding = W(tolerance::epsilon<T> * R_);
    const T gap = tolerance::jet_gap<T> * R_;
    std::array<Form, EllipsoidSum<T>::most> A;
    Form around = zero();
    T sum = T(0);
    for (std::size_t i = 0; i < sum_.used; ++i) sum += sum_.F[i].norm();
    for (std::size_t i = 0; i < sum_.used; ++i) {
      A[i] = zero();
      for (int k = 0; k < 3; ++k) A[i].add(Vec3<W>(F_[i].col(k)), W(1));
      around.add(A[i], W(sum / sum_.F[i].norm()));
    }

    ModelHit<W> hit;
    hit.certain = Mask<W>(false);
    Vec3<W> m = met(around), best = m;
    W least = W(std::numeric_limits<T>::infinity());
    Mask<W> best_is_ahead(false), outer(false);
    Mask<W> open = s_.squaredNorm() <= W(T(1.01) * R_ * R_);
    for (int i = 0; i < max_evaluations; ++i) {
      // Support points g_i and heights h_i, relative to the centres.
      std::array<Vec3<W>, EllipsoidSum<T>::most> g;
      std::array<W, EllipsoidSum<T>::most> over;
      Vec3<W> support_point = Vec3<W>::Zero();
      W height(0);
      for (std::size_t k = 0; k < sum_.used; ++k) {
        const Vec3<W> onto = F_[k].transpose() * m;
        const W h = onto.norm();
        over[k] = W(1) / select(h > W(0), h, W(1));
        g[k] = F_[k] * (onto * over[k]);
        support_point += g[k];
        height += h;
      }
      const W h = c_.dot(m) + height;
      const Mask<W> ahead = m.z() > W(tolerance::model_rounding<T>);

      // The value to minimise. For a direction ahead: the height at which its plane cuts the ray.
      // For a direction across the ray: the sum's reach divided by the ray's distance.
      const W cut = h / select(ahead, m.z(), W(1));
      const W beyond = -c_.dot(m);
      const W ratio = height / select(beyond > W(0), beyond, W(T(1) / T(1024)));
      const W value = select(ahead, cut, ratio);
      const Mask<W> comparable = (ahead & best_is_ahead) | !(ahead | best_is_ahead);
      const Mask<W> worse = open & comparable & (value > least) & !outer;
      best = select<W>(worse, best, m);
      least = select(worse, least, value);
      best_is_ahead = (worse & best_is_ahead) | ((!worse) & ahead);

      // The ellipsoid that osculates the sum, or one that contains the sum and touches it. A step
      // with the latter never leads to a higher plane (Cauchy-Schwarz inequality).
      Form osculating = zero();
      for (std::size_t k = 0; k < sum_.used; ++k) {
        const W share = height * over[k];
        osculating.add(A[k], share);
        osculating.add(g[k], select(outer, W(0), W(-share)));
      }
      osculating.add(support_point, select(outer, W(0), W(1)));
      const Vec3<W> next = met(osculating);

      const W x = c_.x() + support_point.x(), y = c_.y() + support_point.y();
      const W offset = sqrt(x * x + y * y), step = (next - m).norm();
      const Mask<W> on_to = next.z() > W(tolerance::model_rounding<T>);
      const Mask<W> settled =
          ahead & on_to & (!outer) & (offset * step <= rounding) & (offset <= W(model_reach * R_));
      // The direction separates, or has the least reach of all directions across the ray. If the
      // ray is tangent up to rounding, directions may alternate.
      const W enough = i < max_across ? W(T(-2) * gap) : W(gap);
      const Mask<W> across =
          (!ahead) &
          ((h <= enough) | ((!on_to) & (!outer) & (step * step <= W(tolerance::epsilon<T>))));
      const Mask<W> ends = open & (settled | across);
      hit.m = select<W>(open, select<W>(settled, next, m), hit.m);
      if (any(open & settled)) {
        const W there = c_.dot(next) + sqrt(osculating.at(next));
        hit.height = select(open & settled, W(there / select(on_to, next.z(), W(1))), hit.height);
        hit.certain |= open & settled;
      }
      open &= !ends;
      if (!any(open)) break;
      m = select<W>(worse, best, next);
      outer = worse;
    }
    return hit;
  }

  /// Sums of two ordinary ellipsoids need three or four evaluations. Sums of needles need dozens,
  /// so SmoothModel continues the search.
  static constexpr int max_evaluations = 12;
  /// Directions across the ray converge in about four evaluations.
  static constexpr int max_across = 6;
  /// Distance from the ray, in units of R, up to which an osculating ellipsoid is trusted (cbrt
  /// epsilon).
  inline static const T model_reach = std::cbrt(tolerance::epsilon<T>);

  const S& shape_;
  const EllipsoidSum<T>& sum_;
  Vec3<T> centre_;
  Vec3<W> s_, r_;
  RayFrame<W> frame_;
  T R_;
  Vec3<W> c_;                                     ///< the sum's centre, in the ray's frame
  std::array<Mat3<W>, EllipsoidSum<T>::most> F_;  ///< the ellipsoids' factors, in the ray's frame
  W height_ = W(0);
  Mask<W> hits_ =
      Mask<W>(false);  ///< the line hits the sum at height_, and no plane has been requested yet
  Mask<W> across_ = Mask<W>(false);  ///< the requested direction has the least reach across the ray
  std::optional<SmoothModel<W, S>> smooth_;
};

}  // namespace minkray
