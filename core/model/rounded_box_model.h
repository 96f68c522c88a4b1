// SPDX-License-Identifier: MIT
// The model of a rounded box: itself. Along a line the squared distance to the box within is a
// convex chain of parabolas, whose links join where the line crosses the planes of the box's faces.
// Which link reaches the radius first, the distances at the joints tell: without a search, the hit
// is one root of one parabola. docs/theory.md, section 9.
#pragma once

#include <array>

#include "core/model/hull_cast.h"
#include "core/model/line_cast.h"
#include "core/model/translates_model.h"

namespace minkray {

template <class W, class Box>
class RoundedBoxModel {
 public:
  using T = Lane<W>;
  using Piece = Translate<W, RoundBody<W>>;  ///< relative to s

  RoundedBoxModel(const Box& box, T radius, const Vec3<T>& centre, const Vec3<W>& s,
                  const Vec3<W>& r, T R)
      : box_(box), radius_(radius), from_(widen<W>(centre) + s), r_(r), R_(R) {}

  const Vec3<W>& to_frame(const Vec3<W>& n) const { return n; }
  const Vec3<W>& to_shape(const Vec3<W>& n) const { return n; }
  W against_ray(const Vec3<W>& n) const { return -n.dot(r_); }

  Piece support(const Vec3<W>& n, const Mask<W>&) const {
    return {Vec3<W>(box_.template support<W>(n) - from_), {W(radius_)}};
  }

  ModelHit<W> begin(const Vec3<T>&) {
    const Folded line(*this);
    Entry entry = near_sides(line);
    if (!all(entry.certain)) {
      const Entry other = any_side(line);
      entry.m = select<W>(entry.certain, entry.m, other.m);
      entry.certain |= other.certain;
    }
    certain_ = entry.certain;
    const Vec3<W> m = unit<W>(each([&](int k) -> W { return entry.m[k] * line.side[k]; }));
    return meeting(support(m, Mask<W>(true)), m);
  }

  /// Nothing can be added to what `begin` has answered.
  ModelHit<W> step(const Piece& piece, const Vec3<W>& n, int) const {
    ModelHit<W> hit = meeting(piece, n);
    hit.repeated = Mask<W>(true);
    return hit;
  }

 private:
  template <class Component>
  static Vec3<W> each(const Component& component) {
    return {component(0), component(1), component(2)};
  }

  /// Of direction m, which the piece was found in.
  ModelHit<W> meeting(const Piece& piece, const Vec3<W>& m) const {
    ModelHit<W> hit;
    hit.m = m;
    const W z = against_ray(m);
    const Mask<W> ahead = z > W(0);
    hit.height = piece.reach(m) / select(ahead, z, W(1));
    hit.certain = certain_ & ahead;
    return hit;
  }

  /// The line as seen when the box is mirrored such that it runs towards positive coordinates, from
  /// the corner that it comes by first: the box is 0 <= y <= width, the line y = u + lambda v.
  struct Folded {
    Vec3<W> side, u, v, width;
    Vec3<W> into;  ///< where the line crosses the planes y = 0

    explicit Folded(const RoundedBoxModel& model) {
      using std::abs;
      using std::copysign;
      using std::max;
      const Vec3<W> h = widen<W>(model.box_.half_extents);
      side = each([&](int k) { return copysign(W(1), model.r_[k]); });
      u = model.from_.cwiseProduct(side) + h;
      v = each([&](int k) -> W {
        const W slope = abs(model.r_[k]);
        return select(slope < W(parallel), W(0), slope);
      });
      width = h + h;
      into = each([&](int k) -> W { return -u[k] / max(v[k], W(parallel)); });
    }
    Vec3<W> at(const W& lambda) const { return u + v * lambda; }
  };

  struct Entry {
    Vec3<W> m;  ///< a normal, of any length, of the mirrored box
    Mask<W> certain;
  };

  /// The first root of one parabola: where u + lambda v is as long as the radius.
  struct Link {
    Mask<W> meets;
    W lambda;
    Vec3<W> spot;  ///< along u + lambda v there, or where it is shortest
  };

  Link on_link(const Vec3<W>& u, const Vec3<W>& v) const {
    using std::max;
    using std::sqrt;
    const W a = v.squaredNorm();
    const Vec3<W> turn = u.cross(v);
    const W den = W(radius_ * radius_) * a - turn.squaredNorm();
    const W root = sqrt(max(den, W(0)));
    const Mask<W> moves = a > W(0);
    return {Mask<W>(moves & (den >= W(0))), -(u.dot(v) + root) / select(moves, a, W(1)),
            Vec3<W>(v.cross(turn) - v * root)};
  }

  /// Of the box grown without end away from the line's beginning, which is y >= 0: its hit is the
  /// rounded box's if it lies beside that. The distance falls all along, so that a face's plane is
  /// crossed after the hit if the distance there is the radius at most.
  Entry near_sides(const Folded& line) const {
    using std::min;
    const auto before_hit = [&](int k) -> Mask<W> {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      const W y_i = min(W(line.u[i] + line.v[i] * line.into[k]), W(0));
      const W y_j = min(W(line.u[j] + line.v[j] * line.into[k]), W(0));
      return y_i * y_i + y_j * y_j <= W(radius_ * radius_);
    };
    const std::array<Mask<W>, 3> before = {before_hit(0), before_hit(1), before_hit(2)};
    const auto of_those = [&](const Vec3<W>& x) {
      return each([&](int k) { return select(before[static_cast<std::size_t>(k)], x[k], W(0)); });
    };
    const Link link = on_link(of_those(line.u), of_those(line.v));
    const Vec3<W> y = line.at(link.lambda);
    const Mask<W> beside =
        (y.x() <= line.width.x()) & (y.y() <= line.width.y()) & (y.z() <= line.width.z());
    return {each([&](int k) { return min(link.spot[k], W(0)); }), Mask<W>(link.meets & beside)};
  }

  /// Beside any of the faces. A joint lies after the hit if the distance there is the radius at
  /// most, or no longer falls; where the line passes by, the same tells the link that is nearest.
  Entry any_side(const Folded& line) const {
    using std::max;
    using std::min;
    const auto after_hit = [&](const W& lambda, int k) {
      W squared(0), change(0);
      for (const int j : {(k + 1) % 3, (k + 2) % 3}) {
        const W e = beside(line.u[j] + line.v[j] * lambda, line.width[j]);
        squared += e * e;
        change += e * line.v[j];
      }
      return (squared <= W(radius_ * radius_)) | (change >= W(0));
    };
    const W far(T(4) * R_);  // there the line is past the shape, or before it, on two axes alone
    Vec3<W> u, v;
    Mask<W> near[3];
    for (int k = 0; k < 3; ++k) {
      const W into = min(max(line.into[k], W(-far)), far);
      const W past = line.into[k] + line.width[k] / max(line.v[k], W(parallel));
      const W out = min(max(past, W(-far)), far);
      near[k] = after_hit(into, k);
      const Mask<W> behind = !(near[k] | after_hit(out, k));
      const Mask<W> within = !(near[k] | behind);
      u[k] = select(within, W(0), select(behind, W(line.u[k] - line.width[k]), line.u[k]));
      v[k] = select(within, W(0), line.v[k]);
    }
    const Link link = on_link(u, v);
    Entry entry{link.spot, link.meets};
    for (int k = 0; k < 3; ++k)
      entry.m[k] = select(near[k], min(link.spot[k], W(0)), max(link.spot[k], W(0)));
    // Across the line, if it passes by; a direction's zeros stay, for a vertex may be far.
    for (int k = 0; k < 3; ++k) v[k] = select(entry.m[k] == W(0), W(0), v[k]);
    const W a = v.squaredNorm();
    const Mask<W> moves = a > W(0);
    const Vec3<W> across = entry.m - v * (entry.m.dot(v) / select(moves, a, W(1)));
    const Mask<W> some = across.squaredNorm() > entry.m.squaredNorm() * W(tolerance::epsilon<T>);
    entry.m = select<W>((!link.meets) & some, across, entry.m);
    W off(0);
    const Vec3<W> y = line.at(link.lambda);
    for (int k = 0; k < 3; ++k) {
      const W e = beside(y[k], line.width[k]);
      off += e * e;
    }
    const T reach = radius_ + tolerance::model_rounding<T> * R_;
    entry.certain &= off <= W(reach * reach);
    return entry;
  }

  /// How far y is beside [0, width].
  static W beside(const W& y, const W& width) {
    using std::max;
    using std::min;
    return y - min(max(y, W(0)), width);
  }

  /// A slope that moves the line less than rounding over the shape's size.
  static constexpr T parallel = tolerance::epsilon<T> / T(16);

  const Box& box_;
  T radius_;
  Vec3<W> from_, r_;
  T R_;
  Mask<W> certain_ = Mask<W>(false);
};

}  // namespace minkray
