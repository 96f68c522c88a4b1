// SPDX-License-Identifier: MIT
// The model for rounded polytopes: the hull of up to four balls of one radius around vertices, in
// closed form. docs/theory.md derives it.
#pragma once

#include <array>

#include "core/solver/line_cast.h"
#include "core/solver/ray_frame.h"

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
        from_(widen<W>(centre) + s),
        frame_(r),
        rounding_(tolerance::model_rounding<T> * R) {}

  Vec3<W> to_frame(const Vec3<W>& n) const { return frame_.into(n); }
  Vec3<W> to_shape(const Vec3<W>& n) const { return frame_.out_of(n); }
  W against_ray(const Vec3<W>& n) const { return n.z(); }

  Piece support(const Vec3<W>& n) const {
    return {frame_.into(core_.template support<W>(frame_.out_of(n)) - from_), radius_};
  }

  ModelHit<W> step(const Piece& piece, const Vec3<W>&, int) {
    // Forget an older copy of the newest piece; it will be kept in a free place below.
    ModelHit<W> hit;
    for (Kept& kept : kept_) {
      const Mask<W> same = kept.valid & (kept.c.x() == piece.c.x()) &
                           (kept.c.y() == piece.c.y()) & (kept.c.z() == piece.c.z());
      hit.repeated |= same;
      kept.valid &= !same;
    }
    const Choice choice = solve(piece.c);
    hit.m = choice.m;
    const Mask<W> ahead = hit.m.z() > W(0);
    hit.certain = choice.found & ahead;
    hit.height = piece.reach(hit.m) / select(ahead, hit.m.z(), W(1));

    // Keep the pieces that carry the hit.
    Mask<W> placed(false);
    for (std::size_t k = 0; k < 3; ++k) {
      Kept& kept = kept_[k];
      kept.valid &= choice.carries[k];
      const Mask<W> here = (!kept.valid) & (!placed);
      kept.c = select<W>(here, piece.c, kept.c);
      kept.valid |= here;
      placed |= here;
    }
    return hit;
  }

 private:
  using Places = std::array<Mask<W>, 3>;

  struct Kept {
    Vec3<W> c = Vec3<W>::Zero();
    Mask<W> valid = Mask<W>(false);
  };

  /// The candidate for the hit that has been chosen so far.
  struct Choice {
    Vec3<W> m = Vec3<W>::Zero();
    Mask<W> found = Mask<W>(false);  ///< it is the hit; otherwise the best of the others
    W rank = W(std::numeric_limits<T>::infinity());
    Places carries = nobody();

    void adopt(const Mask<W>& where, const Choice& other) {
      m = select<W>(where, other.m, m);
      rank = select(where, other.rank, rank);
      found = (where & other.found) | ((!where) & found);
      for (std::size_t k = 0; k < 3; ++k)
        carries[k] = (where & other.carries[k]) | ((!where) & carries[k]);
    }
  };

  /// The kept piece that reaches furthest in some direction.
  struct Furthest {
    Vec3<W> c = Vec3<W>::Zero();
    W reach = W(-std::numeric_limits<T>::infinity());
    Places at = nobody();
    Mask<W> some = Mask<W>(false);
  };

  static Places nobody() { return {Mask<W>(false), Mask<W>(false), Mask<W>(false)}; }

  Furthest furthest_in(const Vec3<W>& m) const {
    Furthest best;
    for (std::size_t k = 0; k < 3; ++k) {
      const W reach = kept_[k].c.dot(m);
      const Mask<W> further = kept_[k].valid & (reach > best.reach);
      best.c = select<W>(further, kept_[k].c, best.c);
      best.reach = select(further, reach, best.reach);
      for (std::size_t j = 0; j < k; ++j) best.at[j] &= !further;
      best.at[k] = further;
      best.some |= further;
    }
    return best;
  }

  /// Takes the candidate of direction m where it is better than the choice so far: where `meets`
  /// (its pieces meet the ray) and no other piece reaches further, it is the hit.
  Furthest consider(const Vec3<W>& newest, const Vec3<W>& m, const Mask<W>& meets,
                    const Places& carries, const Mask<W>& candidate, Choice& choice) const {
    using std::max;
    const Furthest furthest = furthest_in(m);
    const W reach = newest.dot(m);
    const Mask<W> unbeaten = !(furthest.reach - reach > rounding_);
    const W value = max(reach, furthest.reach) + radius_;
    const Mask<W> ahead = m.z() > W(0);
    const W out_of_reach = W(std::numeric_limits<T>::max());
    const W rank = select(ahead, W(value / select(ahead, m.z(), W(1))),
                          select(value < W(0), W(-out_of_reach), out_of_reach));
    const Mask<W> useful = meets & unbeaten & (ahead | (value < W(0)));
    const Mask<W> wins = candidate & !choice.found & (useful | (rank < choice.rank));
    choice.adopt(wins, {m, useful, rank, carries});
    return furthest;
  }

  /// The hit, the newest piece among its carriers. A
  /// candidate that another piece reaches beyond is joined by that piece; should this not lead to
  /// the hit, all candidates are tried.
  Choice solve(const Vec3<W>& newest) const {
    Choice choice;
    const Furthest second = alone(newest, choice);
    if (all(choice.found)) return choice;
    const Furthest third = edge(newest, second.c, second.at, second.some, choice);
    if (all(choice.found)) return choice;
    Places both;
    Mask<W> same(false);
    for (std::size_t k = 0; k < 3; ++k) {
      both[k] = second.at[k] | third.at[k];
      same |= second.at[k] & third.at[k];
    }
    face(newest, second.c, third.c, both, second.some & third.some & !same, choice);
    if (all(choice.found)) return choice;
    for (std::size_t k = 0; k < 3; ++k) {
      Places at = nobody();
      at[k] = Mask<W>(true);
      edge(newest, kept_[k].c, at, kept_[k].valid, choice);
    }
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = j + 1; k < 3; ++k) {
        Places at = nobody();
        at[j] = at[k] = Mask<W>(true);
        face(newest, kept_[j].c, kept_[k].c, at, kept_[j].valid & kept_[k].valid, choice);
      }
    }
    return choice;
  }

  /// One ball.
  Furthest alone(const Vec3<W>& c, Choice& choice) const {
    using std::max;
    using std::sqrt;
    const W den = radius_ * radius_ - (c.x() * c.x() + c.y() * c.y());
    const Vec3<W> m = unit<W>({-c.x(), -c.y(), sqrt(max(den, W(0)))});
    return consider(c, m, Mask<W>(true), nobody(), Mask<W>(true), choice);
  }

  /// Two: the cylinder between them.
  Furthest edge(const Vec3<W>& c, const Vec3<W>& other, const Places& carries,
                const Mask<W>& candidate, Choice& choice) const {
    using std::abs;
    using std::max;
    using std::sqrt;
    if (!any(candidate & !choice.found)) return {};
    const Vec3<W> e = c - other;
    const W E = e.x() * e.x() + e.y() * e.y();
    const W length = sqrt(E);
    const Vec3<W> t(-e.y() / length, e.x() / length, W(0));
    const Vec3<W> w = unit<W>({-e.x() * e.z(), -e.y() * e.z(), E});
    const W L = t.x() * c.x() + t.y() * c.y();
    const W den = radius_ * radius_ - L * L;
    const Mask<W> crosses = den > W(0);
    const Vec3<W> onto = unit<W>(Vec3<W>(w * sqrt(max(den, W(0))) - t * L));
    const Vec3<W> m = select<W>(crosses, onto, select<W>(L > W(0), Vec3<W>(-t), t));
    // Where between them: in the plane of the support points, or of those that the ray touches.
    const W bulge = select(crosses, radius_, abs(L));
    const W x = other.x() + m.x() * bulge, y = other.y() + m.y() * bulge;
    const W share = -(x * e.x() + y * e.y()) / E, slack = rounding_ / length;
    return consider(c, m, (share >= -slack) & (share <= W(1) + slack), carries,
                    candidate & (E > W(0)), choice);
  }

  /// Three: the plane that touches them.
  void face(const Vec3<W>& a, const Vec3<W>& b, const Vec3<W>& c,
            const Places& carries, const Mask<W>& candidate, Choice& choice) const {
    if (!any(candidate & !choice.found)) return;
    const Vec3<W> m = upper_normal(a, b, c);
    const W x = m.x() * radius_, y = m.y() * radius_;
    const Vec3<W> at_a(a.x() + x, a.y() + y, W(0)), at_b(b.x() + x, b.y() + y, W(0));
    const Vec3<W> at_c(c.x() + x, c.y() + y, W(0));
    consider(a, m,
             passes_between(at_a, at_b, at_c) | passes_edge(at_a, at_b, rounding_) |
                 passes_edge(at_b, at_c, rounding_) | passes_edge(at_c, at_a, rounding_),
             carries, candidate & (m.z() > W(0)), choice);
  }

  const Core& core_;
  W radius_;
  Vec3<W> from_;
  RayFrame<W> frame_;
  W rounding_;
  std::array<Kept, 3> kept_;
};

}  // namespace minkray
