// SPDX-License-Identifier: MIT
// Finds the direction of least depth of overlapping curved cores, to second order
// (sliding_features.h), and points of C near this direction. A polytope alone, which grows from its
// nearest face, approaches a curved surface slowly and rarely finds an overlap of 1e-6 of the size.
#pragma once

#include <array>

#include "core/pair_distance/core_distance.h"
#include "core/pair_distance/sliding_features.h"

namespace minkray {

class DepthDirection {
 public:
  explicit DepthDirection(const CorePair& pair) : query_{pair, search_} {}

  static bool helps(const CorePair& pair) {
    const auto is_known = [](const ShapeCore& core) { return core.kind != CoreKind::other; };
    return is_known(pair.a) && is_known(pair.b) && (slides(pair.a.kind) || slides(pair.b.kind));
  }

  const Vec3<double>& direction() const { return direction_; }
  double gap() const { return gap_; }  ///< gap along direction(): minus the depth
  int supports() const { return query_.result.supports; }

  /// Finds four points of C that enclose the origin, which is close to C's surface: three around
  /// the direction of least depth (searched from `from`), and the point of C furthest from these
  /// three. The three are so close to each other that their plane cuts off at most `gap` of C,
  /// unless the depth requires larger distances. `is_sure(enclosure)` decides whether four points
  /// are accepted.
  template <class IsSure>
  bool enclose(const Vec3<double>& from, double gap, Enclosure& enclosure, const IsSure& is_sure) {
    SlidingFeatures<CoreKind::other, CoreKind::other> features(query_);
    if (!features.settle(from)) return false;
    direction_ = features.direction();
    gap_ = direction_.dot(query_.nearest(direction_).c);
    if (!(gap_ < 0)) return false;
    const DifferencePoint furthest = query_.nearest(-direction_);
    const double finest = std::sqrt(gap / query_.size),
                 turn = std::sqrt(-gap_ / query_.size) + 1e-9;
    for (const double angle : {finest, 0.5 * turn, 5 * turn, 50 * turn}) {
      if (angle < finest) continue;
      Candidates near;
      features.around(angle, [&](const DifferencePoint& p) { near.add(p); });
      if (try_triples(near, furthest, enclosure, is_sure)) return true;
      // At an edge or a corner of C, some of the points needed are further away.
      Candidates all;
      for (std::size_t i = 0; i < std::min<std::size_t>(near.count, 6); ++i)
        all.add(near.points[i]);
      all.add(query_.nearest(direction_));
      all.add(furthest);
      const Vec3<double> e0 = direction_.unitOrthogonal(), e1 = direction_.cross(e0);
      for (const double tilt : {0.3, 2.0})
        for (const double side : {0.0, 2.0944, 4.1888})
          all.add(query_.nearest(direction_ + tilt * (std::cos(side) * e0 + std::sin(side) * e1)));
      if (try_fours(all, enclosure, is_sure)) return true;
    }
    return false;
  }

 private:
  struct Candidates {
    std::array<DifferencePoint, 14> points;
    std::size_t count = 0;

    void add(const DifferencePoint& p) {
      if (count < points.size()) points[count++] = p;
    }
  };

  template <class IsSure>
  static bool take(const std::array<const DifferencePoint*, 4>& four, Enclosure& enclosure,
                   const IsSure& is_sure) {
    for (std::size_t n = 0; n < 4; ++n) {
      enclosure.c[n] = four[n]->c;
      enclosure.a[n] = four[n]->a;
    }
    enclosure.is_found = is_sure(enclosure);
    return enclosure.is_found;
  }

  template <class IsSure>
  static bool try_fours(const Candidates& all, Enclosure& enclosure, const IsSure& is_sure) {
    const auto& p = all.points;
    for (std::size_t i = 0; i < all.count; ++i)
      for (std::size_t j = i + 1; j < all.count; ++j) {
        const Vec3<double> ij = p[i].c.cross(p[j].c);
        for (std::size_t k = j + 1; k < all.count; ++k) {
          const double ijk = ij.dot(p[k].c);
          const Vec3<double> ik = p[i].c.cross(p[k].c), jk = p[j].c.cross(p[k].c);
          for (std::size_t l = k + 1; l < all.count; ++l) {
            const double ijl = -ij.dot(p[l].c), ikl = ik.dot(p[l].c), jkl = -jk.dot(p[l].c);
            const bool is_around =
                ijk > 0 ? ijl > 0 && ikl > 0 && jkl > 0 : ijk < 0 && ijl < 0 && ikl < 0 && jkl < 0;
            if (is_around && take({&p[i], &p[j], &p[k], &p[l]}, enclosure, is_sure)) return true;
          }
        }
      }
    return false;
  }

  /// Tries all triples of near points together with the furthest point. The three points, projected
  /// along the furthest point's direction, must enclose the origin.
  template <class IsSure>
  static bool try_triples(const Candidates& near, const DifferencePoint& furthest,
                          Enclosure& enclosure, const IsSure& is_sure) {
    const Vec3<double> along = unit<double>(furthest.c);
    if (along.isZero(0)) return false;
    const Vec3<double> e0 = along.unitOrthogonal(), e1 = along.cross(e0);
    const auto& p = near.points;
    const auto side = [&](std::size_t i, std::size_t j) {
      return e0.dot(p[i].c) * e1.dot(p[j].c) - e1.dot(p[i].c) * e0.dot(p[j].c);
    };
    for (std::size_t i = 0; i < near.count; ++i)
      for (std::size_t j = i + 1; j < near.count; ++j)
        for (std::size_t k = j + 1; k < near.count; ++k) {
          const double ij = side(i, j), jk = side(j, k), ki = side(k, i);
          const bool is_around = (ij > 0 && jk > 0 && ki > 0) || (ij < 0 && jk < 0 && ki < 0);
          if (is_around && take({&p[i], &p[j], &p[k], &furthest}, enclosure, is_sure)) return true;
        }
    return false;
  }

  CoreSearch search_;
  CoreQuery<CoreKind::other, CoreKind::other> query_;
  Vec3<double> direction_ = Vec3<double>::Zero();
  double gap_ = 0;
};

}  // namespace minkray
