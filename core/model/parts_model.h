// SPDX-License-Identifier: MIT
// The model for all other shapes: the hull of up to four parts, each a sum of ellipsoids. There is
// no closed form; Newton's method finds the hit, without support calls. docs/theory.md derives it.
#pragma once

#include "core/model/hull_cast.h"
#include "core/model/line_cast.h"
#include "core/shape/ellipsoid_sum.h"

namespace minkray {

template <class W>
class PartsModel {
 public:
  using T = Lane<W>;
  using Part = EllipsoidSum<W>;

  /// It is in the ray's frame, relative to s.
  struct Piece {
    Part part;
    Vec3<W> n;  ///< the direction, of unit length, in which it was found

    W reach(const Vec3<W>& m) const { return select(part.exact, part.reach(m), part.s.dot(m)); }
    const Vec3<W>& spot(const Vec3<W>&) const { return part.s; }
  };

  PartsModel(const Shape<T>& shape, const Vec3<T>& centre, const Vec3<W>& s, const Vec3<W>& r, T R)
      : shape_(shape),
        s_(s),
        from_(widen<W>(centre) + s),
        frame_(r),
        R_(R),
        rounding_(tolerance::model_rounding<T> * R) {}

  Vec3<W> to_frame(const Vec3<W>& n) const { return frame_.into(n); }
  Vec3<W> to_shape(const Vec3<W>& n) const { return frame_.out_of(n); }
  W against_ray(const Vec3<W>& n) const { return n.z(); }

  ModelHit<W> begin(const Vec3<T>& half_extents) {
    surrogate_ = turned(widen<W, T>(Mat3<T>(half_extents.asDiagonal())));
    ModelHit<W> hit;
    hit.m = frame_.into(normal_on_extents<W>(half_extents, s_, Vec3<W>(-frame_.z)));
    return hit;
  }

  Piece support(const Vec3<W>& n, const Mask<W>&) const {
    const Part in_shape = part_of<W>(shape_, frame_.out_of(n));
    Piece piece{{}, n};
    piece.part.patch = in_shape.patch;
    piece.part.c = frame_.into(in_shape.c - from_);
    piece.part.s = frame_.into(in_shape.s - from_);
    piece.part.exact = in_shape.exact;
    piece.part.used = in_shape.used;
    for (std::size_t k = 0; k < in_shape.used; ++k) piece.part.F[k] = turned(in_shape.F[k]);
    return piece;
  }

  ModelHit<W> step(const Piece& piece, const Vec3<W>& n, int iteration) {
    ModelHit<W> hit;
    hit.repeated = add(piece, n);
    shrink_ = select(hit.repeated, W(shrink_ * W(T(0.1))), shrink_);
    if (iteration >= 3) shrink_ *= W(T(0.5));
    Solution solution = solve(n);
    // Ellipsoids that osculate elsewhere may hold the direction where it is, and be wrong.
    const Mask<W> stalls =
        (!solution.certain) & ((solution.m - n).squaredNorm() <= W(tolerance::epsilon<T>));
    if (any(stalls)) {
      Mask<W> flattened(false);
      for (std::size_t k = 0; k < newest; ++k) {
        const Mask<W> osculates = stalls & valid_[k] & !pieces_[k].part.exact;
        flatten(pieces_[k], osculates);
        flattened |= osculates;
      }
      if (any(flattened)) solution = pick(flattened, solve(n), solution);
    }
    hit.m = solution.m;
    hit.height = solution.height;
    hit.certain = solution.certain;
    hit.inner = solution.exact;
    keep(solution);
    return hit;
  }

 private:
  /// The newest piece is the last.
  static constexpr std::size_t newest = 3;
  using Weights = std::array<W, 4>;

  struct Solution {
    Vec3<W> m = Vec3<W>::Zero();
    W height = W(0);
    Mask<W> certain = Mask<W>(false);
    Mask<W> exact = Mask<W>(false);  ///< all carriers are parts of the shape
    Weights weights = {W(0), W(0), W(0), W(0)};
  };

  /// A piece as it looks from one direction.
  struct Look {
    Vec3<W> g = Vec3<W>::Zero();  ///< its support point, relative to its centre
    W h = W(0);                   ///< how far it reaches beyond its centre
    Mat3<W> H = Mat3<W>::Zero();  ///< derivative of g by the direction
    Mat3<W> G = Mat3<W>::Zero();  ///< sum of g g^T/h of its summands
  };

  /// The lowest height of a supporting plane so far.
  struct Lowest {
    Vec3<W> m = Vec3<W>::Zero();
    W height = W(std::numeric_limits<T>::infinity());
    Vec3<W> spot = Vec3<W>::Zero();
    Mask<W> careful = Mask<W>(false);  ///< the next step from there must not be Newton's
  };

  /// A direction across a flat summand, in which its support point jumps to the other side.
  struct Kink {
    Mat3<W> F = Mat3<W>::Zero();
    Vec3<W> axis = Vec3<W>::Zero();
    Mask<W> here = Mask<W>(false);    ///< the model is asked exactly there
    Mask<W> solved = Mask<W>(false);  ///< and is hit there
    Mask<W> tried = Mask<W>(false);
  };

  Mat3<W> turned(const Mat3<W>& F) const {
    Mat3<W> into;
    for (int k = 0; k < 3; ++k) into.col(k) = frame_.into(F.col(k));
    return into;
  }

  static Mask<W> alike(const Part& a, const Part& b) {
    W difference = (a.c - b.c).cwiseAbs().sum();
    for (std::size_t k = 0; k < std::max(a.used, b.used); ++k)
      difference += (a.F[k] - b.F[k]).cwiseAbs().sum();
    return a.exact & b.exact & (difference == W(0));
  }

  /// Turns a piece into its support point, which is a part of the shape whatever the curvature.
  static void flatten(Piece& piece, const Mask<W>& lanes) {
    if (!any(lanes)) return;
    piece.part.c = select<W>(lanes, piece.part.s, piece.part.c);
    piece.part.patch = select<W>(lanes, piece.part.s, piece.part.patch);
    piece.part.exact |= lanes;
    for (std::size_t k = 0; k < piece.part.used; ++k)
      for (int j = 0; j < 3; ++j)
        piece.part.F[k].col(j) =
            select<W>(lanes, Vec3<W>(Vec3<W>::Zero()), Vec3<W>(piece.part.F[k].col(j)));
  }

  /// Adds the newest piece and says whether it was there already. Osculating pieces keep their
  /// ellipsoids only beside those of other patches that were found in nearly the same direction.
  Mask<W> add(const Piece& piece, const Vec3<W>& n) {
    Mask<W> repeated(false);
    for (std::size_t k = 0; k < newest; ++k) {
      if (!any(valid_[k])) continue;
      Piece& old = pieces_[k];
      const Mask<W> far = ((old.part.patch - piece.part.patch).squaredNorm() == W(0)) |
                          ((old.n - n).squaredNorm() > W(near_squared));
      flatten(old, far & !old.part.exact);
      const Mask<W> same = valid_[k] & alike(old.part, piece.part);
      repeated |= same;
      valid_[k] &= !same;
    }
    pieces_[newest] = piece;
    valid_[newest] = Mask<W>(true);
    return repeated;
  }

  void keep(const Solution& solution) {
    Mask<W> placed(false);
    for (std::size_t k = 0; k < newest; ++k) {
      valid_[k] &= solution.weights[k] != W(0);
      const Mask<W> here = (!valid_[k]) & (!placed);
      placed |= here;
      if (!any(here)) continue;
      pieces_[k] = pick(here, pieces_[newest], pieces_[k]);
      valid_[k] |= here;
    }
  }

  static Piece pick(const Mask<W>& condition, const Piece& a, const Piece& b) {
    return {select<W>(condition, a.part, b.part), select<W>(condition, a.n, b.n)};
  }

  /// The hit on the hull of the pieces. Where they are points, or translates of one ellipsoid, that
  /// is one cast; elsewhere pieces are replaced, again and again, by translates of one ellipsoid
  /// that joins their curvatures.
  Solution solve(const Vec3<W>& n) const {
    Mask<W> points(true), common(true);
    for (std::size_t i = 0; i < 4; ++i) {
      const Part& part = pieces_[i].part;
      W later(0);
      for (std::size_t k = 0; k < part.used; ++k) {
        const W size = part.F[k].cwiseAbs().sum();
        points &= (!valid_[i]) | (size == W(0));
        if (k > 0) later += size;
      }
      const W apart = (part.F[0] - pieces_[newest].part.F[0]).cwiseAbs().sum();
      common &= (!valid_[i]) | ((later == W(0)) & (apart == W(0)));
    }
    Solution solution;
    Mask<W> open(true);
    if (any(points)) {
      solution = cast(RoundBody<W>{W(0)}, centres());
      solution.certain &= points;
      open = !(points & (solution.certain | (shrink_ < W(least_shrink))));
      solution.exact = Mask<W>(true);
      if (!any(open)) return solution;
    }
    const Solution curved = solve_curved(n, points, common & !points, open);
    return any(points) ? pick(open, curved, solution) : curved;
  }

  static Solution pick(const Mask<W>& condition, const Solution& a, const Solution& b) {
    Solution chosen{select<W>(condition, a.m, b.m),
                    select(condition, a.height, b.height),
                    Mask<W>((condition & a.certain) | ((!condition) & b.certain)),
                    Mask<W>((condition & a.exact) | ((!condition) & b.exact)),
                    {}};
    for (std::size_t i = 0; i < 4; ++i)
      chosen.weights[i] = select(condition, a.weights[i], b.weights[i]);
    return chosen;
  }

  std::array<Vec3<W>, 4> centres() const {
    return {pieces_[0].part.c, pieces_[1].part.c, pieces_[2].part.c, pieces_[3].part.c};
  }

  /// The hit on translates of one body; `certain` where it was found.
  template <class Body>
  Solution cast(const Body& body, const std::array<Vec3<W>, 4>& c) const {
    Translates<W> others;
    for (std::size_t k = 0; k < newest; ++k) {
      others.c[k] = c[k];
      others.valid[k] = valid_[k];
    }
    const HullCastHit<W> on_hull = HullCast<W, Body>(body, c[newest], others, rounding_).solve();
    Solution solution;
    solution.m = on_hull.m;
    const Mask<W> ahead = solution.m.z() > W(0);
    solution.height = select(ahead, on_hull.rank, W(0));
    solution.certain = on_hull.found & ahead;
    solution.weights[newest] = W(1);
    for (std::size_t k = 0; k < newest; ++k) {
      solution.weights[k] = on_hull.weights[k];
      solution.weights[newest] -= on_hull.weights[k];
    }
    return solution;
  }

  static Look look(const Part& part, const Vec3<W>& m, const Mask<W>& at_kink) {
    Look look;
    for (std::size_t k = 0; k < part.used; ++k) {
      const Mat3<W>& F = part.F[k];
      const Vec3<W> u = F.transpose() * m;
      W h = u.norm();
      if (any(at_kink)) h = select(at_kink & (h <= W(flat) * F.cwiseAbs().sum()), W(0), h);
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
    for (std::size_t i = 0; i < 4; ++i) count += select(valid_[i], W(1), W(0));
    for (std::size_t i = 0; i < 4; ++i)
      solution.weights[i] = select(valid_[i], W(W(1) / count), W(0));
    Kink kink;
    Lowest lowest;
    const Mask<W> wanted = open;
    for (int iteration = 0; iteration < newton_steps; ++iteration) {
      std::array<Look, 4> looks;
      Look mean;
      for (std::size_t i = 0; i < 4; ++i) {
        if (!any(valid_[i])) continue;
        looks[i] = look(pieces_[i].part, solution.m, kink.here);
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
      // At a kink the flat summand itself, and all else as it is there; among points, which have
      // no curvature, something of the shape's extents.
      Vec3<W> g_body = mean.g;
      const Mask<W> is_common = common & !kink.here;
      const Mat3<W> about = surrogate_ * shrink_;
      const Vec3<W> g_about = about * unit<W>(about.transpose() * n);
      for (int j = 0; j < 3; ++j) {
        const Vec3<W> given = pieces_[newest].part.F[0].col(j);
        Vec3<W> column = select<W>(is_common, given, Vec3<W>(body.F.col(j)));
        if (any(points)) column = select<W>(points, Vec3<W>(about.col(j)), column);
        body.F.col(j) = select<W>(kink.here, Vec3<W>(kink.F.col(j)), column);
      }
      if (any(points)) g_body = select<W>(points, g_about, g_body);
      g_body = select<W>(kink.here, Vec3<W>(Vec3<W>::Zero()), g_body);
      std::array<Vec3<W>, 4> c = centres();
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
      const Mask<W> settles = (same & (moved <= W(settled_squared)) & !kink.here) | common | points;
      Mask<W> at_kink = kink.here & next.certain & (moved <= W(flat * flat));
      if (any(at_kink)) at_kink &= all_have(kink, next);
      kink.solved |= goes & at_kink;
      open &= back | !(lost | settles | at_kink);
      if (!any(open)) break;
      pass_kinks(kink, before, open & goes, solution.m);
    }
    solution.certain &= wanted & !points;
    judge(solution, common, kink.solved);
    return solution;
  }

  /// Where the flat summand that all pieces were given at the kink is theirs.
  Mask<W> all_have(const Kink& kink, const Solution& solution) const {
    Mask<W> have(true);
    for (std::size_t i = 0; i < 4; ++i) {
      const Part& part = pieces_[i].part;
      W difference(0), number(0);
      for (std::size_t k = 0; k < part.used; ++k) {
        const W size = part.F[k].cwiseAbs().sum();
        const Mask<W> is_flat =
            (size > W(0)) & ((part.F[k].transpose() * kink.axis).norm() <= W(flat) * size);
        difference += select(is_flat, W((part.F[k] - kink.F).cwiseAbs().sum()), W(0));
        number += select(is_flat, W(1), W(0));
      }
      have &= (solution.weights[i] == W(0)) | ((difference == W(0)) & (number == W(1)));
    }
    return have;
  }

  /// Where the plane of direction m is higher than the lowest one so far, takes a part of the step
  /// from there instead, to where the parabola through what is known is lowest; a step past the
  /// shape is repeated as one that cannot be too long (the ellipsoid A = sum h_k sum A_k/h_k holds
  /// the sum of ellipsoids and touches it where it is asked). Answers where. For one piece.
  Mask<W> step_back(Lowest& lowest, Vec3<W>& m, const Look& look, const Mask<W>& lanes) const {
    using std::max;
    using std::min;
    const Vec3<W> spot = pieces_[newest].part.c + look.g;
    const W reach = pieces_[newest].part.c.dot(m) + look.h;
    const Mask<W> ahead = m.z() > W(0);
    const W z = select(ahead, m.z(), W(1));
    const W far = W(std::numeric_limits<T>::max());
    const W height = select(ahead, W(reach / z), select(reach < W(0), W(-far), far));
    const Mask<W> higher = lanes & (height > lowest.height + W(agreed * R_));
    const Mask<W> lower = lanes & !higher;
    if (any(higher)) {
      const Vec3<W> from = lowest.m * (W(1) / select(higher, lowest.m.z(), W(1)));
      const Vec3<W> step = m * (W(1) / z) - from;
      const W slope = lowest.spot.x() * step.x() + lowest.spot.y() * step.y();
      const W bend = height - lowest.height - slope;
      const W share = min(max(W(W(T(-0.5)) * slope / bend), W(T(0.1))), W(T(0.7)));
      const Vec3<W> part = unit<W>(Vec3<W>(from + step * share));
      lowest.careful = higher & !ahead;
      m = select<W>(higher, select<W>(ahead, part, lowest.m), m);
    }
    lowest.m = select<W>(lower, m, lowest.m);
    lowest.spot = select<W>(lower, spot, lowest.spot);
    lowest.height = select(lower, height, lowest.height);
    return higher;
  }

  /// Where the step from `before` to m leads across the axis of a flat summand, the axis comes
  /// next; where the model is not hit there either, a direction near it.
  void pass_kinks(Kink& kink, const Vec3<W>& before, const Mask<W>& open, Vec3<W>& m) const {
    const Mask<W> leaves = open & kink.here;
    if (any(leaves))
      m = select<W>(leaves, unit<W>(Vec3<W>(kink.axis + (m - kink.axis) * W(beside_kink))), m);
    kink.tried |= leaves;
    kink.here &= !open;
    for (std::size_t i = 0; i < 4; ++i) {
      const Part& part = pieces_[i].part;
      for (std::size_t k = 0; k < part.used; ++k) {
        const Mat3<W>& F = part.F[k];
        const Mask<W> is_flat = valid_[i] & (F.col(2).cwiseAbs().sum() == W(0));
        if (!any(is_flat & open)) continue;
        const Vec3<W> across = F.col(0).cross(F.col(1));
        const Vec3<W> axis = unit<W>(select<W>(across.dot(m) < W(0), Vec3<W>(-across), across));
        const Mask<W> crosses = open & is_flat & (!leaves) & (!kink.here) & (axis.z() > W(0)) &
                                ((F.transpose() * before).dot(F.transpose() * m) < W(0)) &
                                (axis.dot(before) > W(0));
        const Mask<W> first = crosses & !kink.tried, again = crosses & kink.tried;
        kink.here |= first;
        kink.axis = select<W>(first, axis, kink.axis);
        for (int j = 0; j < 3; ++j)
          kink.F.col(j) = select<W>(first, Vec3<W>(F.col(j)), Vec3<W>(kink.F.col(j)));
        m = select<W>(first, axis, m);
        m = select<W>(again, unit<W>(Vec3<W>(axis + (before - axis) * W(beside_kink))), m);
      }
    }
  }

  /// Whether the solution is the model's hit up to rounding: all carriers agree, nothing reaches
  /// further, and the carriers' support points combine to a point on the ray; of osculating
  /// carriers, which prove nothing by themselves, their support points where they were found.
  void judge(Solution& solution, const Mask<W>& common, const Mask<W>& at_kink) const {
    using std::max;
    const Vec3<W>& m = solution.m;
    const Mask<W> ahead = m.z() > W(0);
    W highest(-std::numeric_limits<T>::infinity()), mean(0);
    Vec3<W> p = Vec3<W>::Zero(), found = Vec3<W>::Zero();
    Vec3<W> n_newest = pieces_[newest].n;
    solution.exact = Mask<W>(true);
    for (std::size_t i = 0; i < 4; ++i) {
      if (!any(valid_[i])) continue;
      const Part& part = pieces_[i].part;
      const W value = part.reach(m), weight = solution.weights[i];
      Vec3<W> spot = part.c;
      for (std::size_t k = 0; k < part.used; ++k) {
        const Vec3<W> g = part.F[k] * unit<W>(part.F[k].transpose() * m);
        spot += g;
      }
      highest = select(valid_[i], max(highest, value), highest);
      mean += select(valid_[i], W(weight * value), W(0));
      p += select<W>(valid_[i], Vec3<W>(spot * weight), Vec3<W>(Vec3<W>::Zero()));
      found += select<W>(valid_[i], Vec3<W>(part.s * weight), Vec3<W>(Vec3<W>::Zero()));
      solution.exact &= (!valid_[i]) | (weight == W(0)) | part.exact;
    }
    // From p to where the ray crosses its plane.
    const W drop = (m.x() * p.x() + m.y() * p.y()) / select(ahead, m.z(), W(1));
    const W away = p.x() * p.x() + p.y() * p.y() + drop * drop;
    const Mask<W> agrees =
        (highest - mean <= W(agreed * R_)) & ((away <= W(on_the_ray_squared * R_ * R_)) | at_kink);
    solution.height = select(common, solution.height, W(mean / select(ahead, m.z(), W(1))));
    solution.certain &= ahead & (common | agrees);
    if (all(solution.exact)) return;
    using std::sqrt;
    const W beside = sqrt(found.x() * found.x() + found.y() * found.y());
    const W below = n_newest.dot(pieces_[newest].part.s - found);
    const Mask<W> settles = (below + beside * (m - n_newest).norm() <= W(agreed * R_)) &
                            (beside <= W(model_reach * R_));
    solution.certain &= solution.exact | settles;
  }

  /// Up to about 15 degrees between their directions, the ellipsoids of two patches go together.
  static constexpr T near_squared = T(1) / T(16);
  static constexpr int newton_steps = 12;
  /// Where the surrogate is so small, points are taken as they are.
  static constexpr T least_shrink = T(1e-3);
  /// How little the direction moves (of 1; squared) when the iteration, which converges
  /// quadratically, has used up the digits: the value's error is the square.
  static constexpr T settled_squared = T(4) * tolerance::epsilon<T>;
  /// How far a summand reaches, relative to its size, that counts as seen along its axis.
  static constexpr T flat = tolerance::flat_disk<T>;
  /// How far beside a kink the iteration goes on, relative to the step that was wanted.
  static constexpr T beside_kink = T(1) / T(8);
  /// It is the rounding of a value, in units of the bounding radius.
  static constexpr T agreed = T(4) * tolerance::epsilon<T>;
  /// How far beside its point the ray may cross the tangent plane, in units of the bounding radius,
  /// squared: the surface is lower there by half of it over the radius of curvature.
  static constexpr T on_the_ray_squared = T(0.36) * tolerance::epsilon<T>;
  /// An osculating ellipsoid is trusted so close to the ray, in units of the bounding radius.
  inline static const T model_reach = std::cbrt(tolerance::epsilon<T>);

  const Shape<T>& shape_;
  Vec3<W> s_, from_;
  RayFrame<W> frame_;
  T R_;
  W rounding_;
  Mat3<W> surrogate_;  ///< an ellipsoid of the shape's extents, for points' lack of curvature
  W shrink_ = W(T(0.5));
  std::array<Piece, 4> pieces_ = {nothing(), nothing(), nothing(), nothing()};
  std::array<Mask<W>, 4> valid_ = {Mask<W>(false), Mask<W>(false), Mask<W>(false), Mask<W>(false)};

  static Piece nothing() { return {{}, Vec3<W>::Zero()}; }
};

}  // namespace minkray
