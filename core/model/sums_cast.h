// SPDX-License-Identifier: MIT
// Casts the ray at the hull of up to four sums of ellipsoids by Newton's method, without support
// calls. docs/forms.md derives it. The frame is the ray's, as in hull_cast.h.
#pragma once

#include "core/model/flat_kinks.h"
#include "core/model/hull_cast.h"
#include "core/model/sums_hit.h"

namespace minkray {

template <class W>
class SumsCast {
 public:
  using T = Lane<W>;
  using Features = SumFeatures<W>;
  using Sum = EllipsoidSum<W>;
  using Solution = SumsHit<W>;

  /// R is the bounding radius. `surrogate` is an ellipsoid with the shape's extents, scaled by
  /// `shrink`, that replaces points, since points have no curvature.
  SumsCast(const Features& features, T R, const Mat3<W>& surrogate, const W& shrink)
      : features_(features),
        R_(R),
        rounding_(tolerance::model_rounding<T> * R),
        surrogate_(surrogate),
        shrink_(shrink) {}

  /// Returns the hit on the hull of the features. One hull cast suffices if all features are
  /// points, or translates of one ellipsoid. Otherwise, replaces the features repeatedly by
  /// translates of one ellipsoid that combines their curvatures.
  Solution solve(const Vec3<W>& n) const {
    Mask<W> points(true), common(true);
    for (std::size_t i = 0; i < 4; ++i) {
      const Sum& sum = features_[i].sum;
      W later(0);
      for (std::size_t k = 0; k < sum.used; ++k) {
        const W size = sum.F[k].cwiseAbs().sum();
        points &= (!features_.valid(i)) | (size == W(0));
        if (k > 0) later += size;
      }
      const W difference = (sum.F[0] - features_[newest].sum.F[0]).cwiseAbs().sum();
      common &= (!features_.valid(i)) | ((later == W(0)) & (difference == W(0)));
    }
    Solution solution;
    Mask<W> open(true);
    if (any(points)) {
      solution = cast(RoundBody<W>{W(0)}, features_.centres());
      solution.certain &= points;
      open = !(points & (solution.certain | (shrink_ < W(least_shrink))));
      solution.exact = Mask<W>(true);
      if (!any(open)) return solution;
    }
    const Solution curved = solve_curved(n, points, common & !points, open);
    return any(points) ? pick(open, curved, solution) : curved;
  }

 private:
  static constexpr std::size_t newest = Features::newest;

  /// Values of a feature in one direction.
  struct Look {
    Vec3<W> g = Vec3<W>::Zero();  ///< the support point, relative to the sum's centre
    W h = W(0);                   ///< support function relative to the sum's centre
    Mat3<W> H = Mat3<W>::Zero();  ///< derivative of g with respect to the direction
    Mat3<W> G = Mat3<W>::Zero();  ///< sum of g g^T/h of its summands
  };

  /// The direction whose supporting plane is the lowest so far.
  struct Lowest {
    Vec3<W> m = Vec3<W>::Zero();
    W height = W(std::numeric_limits<T>::infinity());
    Vec3<W> support_point = Vec3<W>::Zero();
    Mask<W> careful = Mask<W>(false);  ///< the next step from m must be shorter than Newton's
  };

  /// Returns the hit on translates of one body. `certain` is set in lanes where a hit was found.
  template <class Body>
  Solution cast(const Body& body, const std::array<Vec3<W>, 4>& c) const {
    Translates<W> others;
    for (std::size_t k = 0; k < newest; ++k) {
      others.c[k] = c[k];
      others.valid[k] = features_.valid(k);
    }
    const HullCastHit<W> on_hull = HullCast<W, Body>(body, c[newest], others, rounding_).solve();
    Solution solution;
    solution.m = on_hull.m;
    const Mask<W> ahead = solution.m.z() > W(0);
    solution.height = select(ahead, on_hull.height, W(0));
    solution.certain = on_hull.found & ahead;
    solution.weights[newest] = W(1);
    for (std::size_t k = 0; k < newest; ++k) {
      solution.weights[k] = on_hull.weights[k];
      solution.weights[newest] -= on_hull.weights[k];
    }
    return solution;
  }

  static Look look(const Sum& sum, const Vec3<W>& m, const Mask<W>& at_kink) {
    Look look;
    for (std::size_t k = 0; k < sum.used; ++k) {
      const Mat3<W>& F = sum.F[k];
      const Vec3<W> u = F.transpose() * m;
      W h = u.norm();
      if (any(at_kink))
        h = select(at_kink & (h <= W(T(tolerance::flat_disk<T>)) * F.cwiseAbs().sum()), W(0), h);
      const Mask<W> some = h > W(0);
      const W over = select(some, W(W(1) / select(some, h, W(1))), W(0));
      const Vec3<W> g = F * (u * over);
      const Mat3<W> outer = g * g.transpose() * over;
      look.H += F * F.transpose() * over - outer;
      look.G += outer;
      look.g += g;
      look.h += h;
    }
    return look;
  }

  Solution solve_curved(const Vec3<W>& n, const Mask<W>& points, const Mask<W>& common,
                        Mask<W> open) const {
    Solution solution;
    solution.m = n;
    W count(0);
    for (std::size_t i = 0; i < 4; ++i) count += select(features_.valid(i), W(1), W(0));
    for (std::size_t i = 0; i < 4; ++i)
      solution.weights[i] = select(features_.valid(i), W(W(1) / count), W(0));
    Kink<W> kink;
    Lowest lowest;
    const Mask<W> wanted = open;
    for (int iteration = 0; iteration < newton_steps; ++iteration) {
      std::array<Look, 4> looks;
      Look mean;
      for (std::size_t i = 0; i < 4; ++i) {
        if (!any(features_.valid(i))) continue;
        looks[i] = look(features_[i].sum, solution.m, kink.here);
        const W& weight = solution.weights[i];
        mean.g += looks[i].g * weight;
        mean.h += looks[i].h * weight;
        mean.H += looks[i].H * weight;
        mean.G += looks[i].G * weight;
      }
      const W outer = select(lowest.careful, mean.h, W(0));
      const W own = select(lowest.careful, W(0), W(1));
      lowest.careful = Mask<W>(false);
      const Mask<W> back =
          step_back(lowest, solution.m, looks[newest], open & (count == W(1)) & !kink.here);
      const Mask<W> goes = open & !back;
      if (!any(goes)) continue;
      EllipsoidBody<W> body{
          factor<W>(mean.H * mean.h + mean.G * outer + mean.g * mean.g.transpose() * own)};
      // At a kink, uses the flat summand itself, with the other values found there. For points,
      // which have no curvature, uses the surrogate.
      Vec3<W> g_body = mean.g;
      const Mask<W> is_common = common & !kink.here;
      const Mat3<W> about = surrogate_ * shrink_;
      const Vec3<W> g_about = about * unit<W>(about.transpose() * n);
      for (int j = 0; j < 3; ++j) {
        const Vec3<W> given = features_[newest].sum.F[0].col(j);
        Vec3<W> column = select<W>(is_common, given, Vec3<W>(body.F.col(j)));
        if (any(points)) column = select<W>(points, Vec3<W>(about.col(j)), column);
        body.F.col(j) = select<W>(kink.here, Vec3<W>(kink.F.col(j)), column);
      }
      if (any(points)) g_body = select<W>(points, g_about, g_body);
      g_body = select<W>(kink.here, Vec3<W>(Vec3<W>::Zero()), g_body);
      std::array<Vec3<W>, 4> c = features_.centres();
      for (std::size_t i = 0; i < 4; ++i)
        c[i] = select<W>(is_common, c[i], Vec3<W>(c[i] + looks[i].g - g_body));

      const Solution next = cast(body, c);
      const Mask<W> lost = !(next.m.squaredNorm() > W(0));
      W moved = (next.m - solution.m).squaredNorm();
      Mask<W> same(true);
      for (std::size_t i = 0; i < 4; ++i)
        same &= !((next.weights[i] != W(0)) ^ (solution.weights[i] != W(0)));
      const Vec3<W> before = solution.m;
      solution = pick(goes, next, solution);
      solution.certain &= !lost;
      const Mask<W> settles =
          (same & (moved <= W(tolerance::settled_squared<T>)) & !kink.here) | common | points;
      Mask<W> at_kink = kink.here & next.certain &
                        (moved <= W(T(tolerance::flat_disk<T>) * T(tolerance::flat_disk<T>)));
      if (any(at_kink)) at_kink &= all_have(features_, kink, next.weights);
      kink.solved |= goes & at_kink;
      open &= back | !(lost | settles | at_kink);
      if (!any(open)) break;
      pass_kinks(features_, kink, before, open & goes, solution.m);
    }
    solution.certain &= wanted & !points;
    judge(solution, common, kink.solved);
    return solution;
  }

  /// For one feature. If the plane of direction m is higher than the lowest one so far, takes only
  /// a part of the step from the lowest plane's direction: to the minimum of the parabola through
  /// the known values. If a step leads past the shape, takes the step of an ellipsoid that contains
  /// the sum and touches it in this direction, A = sum h_k sum A_k/h_k; this step cannot be too
  /// long. Returns the lanes whose plane is higher.
  Mask<W> step_back(Lowest& lowest, Vec3<W>& m, const Look& look, const Mask<W>& lanes) const {
    using std::max;
    using std::min;
    const Vec3<W> support_point = features_[newest].sum.c + look.g;
    const W h = features_[newest].sum.c.dot(m) + look.h;
    const Mask<W> ahead = m.z() > W(0);
    const W z = select(ahead, m.z(), W(1));
    const W far = W(std::numeric_limits<T>::max());
    const W height = select(ahead, W(h / z), select(h < W(0), W(-far), far));
    const Mask<W> higher = lanes & (height > lowest.height + W(tolerance::jet_gap<T> * R_));
    const Mask<W> lower = lanes & !higher;
    if (any(higher)) {
      const Vec3<W> from = lowest.m * (W(1) / select(higher, lowest.m.z(), W(1)));
      const Vec3<W> step = m * (W(1) / z) - from;
      const W slope = lowest.support_point.x() * step.x() + lowest.support_point.y() * step.y();
      const W curvature = height - lowest.height - slope;
      const W share = min(max(W(W(T(-0.5)) * slope / curvature), W(T(0.1))), W(T(0.7)));
      const Vec3<W> there = unit<W>(Vec3<W>(from + step * share));
      lowest.careful = higher & !ahead;
      m = select<W>(higher, select<W>(ahead, there, lowest.m), m);
    }
    lowest.m = select<W>(lower, m, lowest.m);
    lowest.support_point = select<W>(lower, support_point, lowest.support_point);
    lowest.height = select(lower, height, lowest.height);
    return higher;
  }

  /// Keeps `certain` set only if the solution is the model's hit up to rounding: the planes of all
  /// carriers agree, no feature reaches further, and the carriers' support points combine to a
  /// point on the ray. Osculating carriers use the support points of the shape in the directions
  /// where they were found, since the ellipsoids' own support points prove nothing.
  void judge(Solution& solution, const Mask<W>& common, const Mask<W>& at_kink) const {
    using std::max;
    const Vec3<W>& m = solution.m;
    const Mask<W> ahead = m.z() > W(0);
    W highest(-std::numeric_limits<T>::infinity()), mean(0);
    Vec3<W> p = Vec3<W>::Zero(), found = Vec3<W>::Zero();
    Vec3<W> n_newest = features_[newest].n;
    solution.exact = Mask<W>(true);
    for (std::size_t i = 0; i < 4; ++i) {
      if (!any(features_.valid(i))) continue;
      const Sum& sum = features_[i].sum;
      const W value = sum.support_function(m), weight = solution.weights[i];
      Vec3<W> support_point = sum.c;
      for (std::size_t k = 0; k < sum.used; ++k) {
        const Vec3<W> g = sum.F[k] * unit<W>(sum.F[k].transpose() * m);
        support_point += g;
      }
      highest = select(features_.valid(i), max(highest, value), highest);
      mean += select(features_.valid(i), W(weight * value), W(0));
      p += select<W>(features_.valid(i), Vec3<W>(support_point * weight), Vec3<W>(Vec3<W>::Zero()));
      found += select<W>(features_.valid(i), Vec3<W>(sum.s * weight), Vec3<W>(Vec3<W>::Zero()));
      solution.exact &= (!features_.valid(i)) | (weight == W(0)) | sum.exact;
    }
    // The distance from p to the point where the ray crosses p's plane.
    const W drop = (m.x() * p.x() + m.y() * p.y()) / select(ahead, m.z(), W(1));
    const W away = p.x() * p.x() + p.y() * p.y() + drop * drop;
    const Mask<W> agrees = (highest - mean <= W(tolerance::jet_gap<T> * R_)) &
                           ((away <= W(tolerance::on_the_ray_squared<T> * R_ * R_)) | at_kink);
    solution.height = select(common, solution.height, W(mean / select(ahead, m.z(), W(1))));
    solution.certain &= ahead & (common | agrees);
    if (all(solution.exact)) return;
    using std::sqrt;
    const W offset = sqrt(found.x() * found.x() + found.y() * found.y());
    const W below = n_newest.dot(features_[newest].sum.s - found);
    const Mask<W> settles =
        (below + offset * (m - n_newest).norm() <= W(tolerance::jet_gap<T> * R_)) &
        (offset <= W(model_reach * R_));
    solution.certain &= solution.exact | settles;
  }

  static constexpr int newton_steps = 12;
  /// Scale of the surrogate below which points are used as they are.
  static constexpr T least_shrink = T(1e-3);
  /// Distance from the ray, in units of R_, up to which an osculating ellipsoid is trusted.
  inline static const T model_reach = std::cbrt(tolerance::epsilon<T>);

  const Features& features_;
  T R_;
  W rounding_;
  const Mat3<W>& surrogate_;
  W shrink_;
};

}  // namespace minkray
