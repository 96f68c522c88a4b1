// SPDX-License-Identifier: MIT
// Distance of two cores by GJK on C = B - A (core_pair.h). GJK keeps up to four points of C, finds
// the point d of their hull closest to the origin, and adds the point c of C with the least d.c. On
// curved surfaces GJK converges linearly, so after a few iterations flat ends (flat_ends.h) and
// sliding features (sliding_features.h) take over. The plane through c gives a lower bound, the
// point d an upper bound; the loop ends when the bounds meet.
#pragma once

#include "core/pair_distance/flat_ends.h"
#include "core/pair_distance/sliding_features.h"

namespace minkray {

/// A point of the core that is near p, where finding one is cheap; otherwise the middle.
template <CoreKind K>
Vec3<double> point_near(const ShapeCore& core, const Vec3<double>& p) {
  const Vec3<double>& size = core.size;
  if constexpr (K == CoreKind::segment) {
    return {0, 0, std::clamp(p.z(), -size.z(), size.z())};
  } else if constexpr (K == CoreKind::box) {
    return p.cwiseMax(-size).cwiseMin(size);
  } else {
    return {0, 0, 0};
  }
}

template <CoreKind A, CoreKind B>
class CurvedGjk {
 public:
  CurvedGjk(const CorePair& pair, const CoreSearch& search) : query_{pair, search} {
    const bool is_known = pair.a.kind != CoreKind::other && pair.b.kind != CoreKind::other;
    may_slide_ = search.may_slide && is_known && (slides(pair.a.kind) || slides(pair.b.kind));
  }

  CoreDistance run() {
    Vec3<double> d = between_near_points();
    if (!(d.squaredNorm() > 0)) d = query_.pair.x;
    if (!(d.squaredNorm() > 0)) d = Vec3<double>::UnitX();
    double squared = std::numeric_limits<double>::infinity();
    if (query_.search.memory) {
      if (resume(*query_.search.memory, d, squared)) return query_.result;
    }
    int stalls = 0;
    for (int turn = 1; turn <= query_.search.max_turns; ++turn) {
      if constexpr (any_slides) {
        const int plain_turns = query_.result.lower > 0 ? turns_apart : turns_near;
        if (may_slide_ && turn > plain_turns) {
          may_slide_ = false;
          if (try_flat_ends(query_, d) || slide(d, SlidingFeatures<A, B>::first_damping))
            return query_.result;
        }
      }
      const DifferencePoint w = query_.nearest(d);
      const double length = d.norm();
      query_.result.raise_lower(d.dot(w.c) / length, d / length);
      if (query_.result.lower > query_.search.apart) return finish(CoreStatus::separated);
      if (count_ > 0 && length - query_.result.lower <= query_.gap)
        return finish(CoreStatus::separated);
      for (int i = 0; i < count_; ++i)
        if (y_[i] == w.c) return finish(settled(length));
      if (count_ == 4) return finish(settled(length));
      y_[count_] = w.c;
      a_[count_] = w.a;
      feature_a_[count_] = w.feature_a;
      feature_b_[count_] = w.feature_b;
      ++count_;
      const SimplexPoint closest = closest_of_simplex(y_, count_, true);
      // If rounding keeps the closest point from coming nearer, the previous closest point is the
      // result.
      const bool is_nearer = closest.kept != 0 && closest.squared < squared;
      if (!is_nearer && (closest.kept == 0 || ++stalls > 1 || query_.result.lower > 0)) {
        --count_;
        return finish(settled(length));
      }
      squared = closest.squared;
      keep(closest);
      if (closest.is_inside() || squared <= common_point * common_point * query_.size * query_.size)
        return finish(CoreStatus::overlapping);
      d = closest.v;
    }
    return finish(CoreStatus::unsettled);
  }

  /// True if the search ended with four points of C that enclose the origin. Writes these to c, and
  /// the corresponding points of A to a.
  bool encloses(Vec3<double>* c, Vec3<double>* a) const {
    if (count_ != 4 || query_.result.status != CoreStatus::overlapping) return false;
    std::copy(y_, y_ + 4, c);
    std::copy(a_, a_ + 4, a);
    return true;
  }

 private:
  /// Number of GJK iterations before sliding features take over: with a known separating plane, and
  /// without.
  static constexpr int turns_apart = 2, turns_near = 6;
  /// Damping of the first step, relative to the size, if the sliding features come from a previous
  /// query.
  static constexpr double resumed_damping = 1e-3;
  static constexpr bool any_slides =
      (A == CoreKind::other || slides(A) || slides(B)) || B == CoreKind::other;

  /// First direction: from a point of A near B's middle to a point of B near that point.
  Vec3<double> between_near_points() const {
    const CorePair& pair = query_.pair;
    const Vec3<double> from_a = pair.x - point_near<A>(pair.a, pair.x);
    if constexpr (B == CoreKind::segment || B == CoreKind::box)
      return from_a + pair.turn * point_near<B>(pair.b, pair.to_b(-from_a));
    else
      return from_a;
  }

  CoreStatus settled(double length) const {
    if (query_.result.lower > 0) return CoreStatus::separated;
    return length <= common_point * query_.size ? CoreStatus::overlapping : CoreStatus::unsettled;
  }

  /// Keeps the vertices with nonzero weights in the closest point.
  void keep(const SimplexPoint& closest) {
    int kept = 0;
    for (int i = 0; i < count_; ++i) {
      if ((closest.kept >> i & 1u) == 0) continue;
      y_[kept] = y_[i];
      a_[kept] = a_[i];
      feature_a_[kept] = feature_a_[i];
      feature_b_[kept] = feature_b_[i];
      weight_[kept] = closest.weight[i];
      ++kept;
    }
    count_ = kept;
  }

  /// Continues the search with sliding features (second order). Returns true if that gave a result.
  bool slide(const Vec3<double>& d, double damping) {
    SlidingFeatures<A, B> features(query_);
    for (int i = 0; i < count_; ++i) features.add(feature_a_[i], feature_b_[i], weight_[i]);
    if (!features.run(d, damping)) return false;
    if (!query_.search.memory) return true;
    // Stored features lead back to nearest points, but overlapping bodies have none.
    if (query_.result.status == CoreStatus::overlapping)
      query_.search.memory->count = 0;
    else
      features.remember(*query_.search.memory);
    return true;
  }

  /// Starts from the final state of the previous query on the pair: the stored features give points
  /// of C at any pose of the bodies. Returns true if the state led to the result; otherwise the
  /// search continues from d and the kept points. The direction alone is not enough: on a surface
  /// known only by its support mapping, a new simplex would consist of points so close to each
  /// other that its closest point has few digits.
  bool resume(const PairMemory& memory, Vec3<double>& d, double& squared) {
    if (!memory.has_axis()) return false;
    take_features_of(memory);
    if (count_ == 0) return false;
    const SimplexPoint closest = closest_of_simplex(y_, count_, false);
    keep(closest);
    if (closest.is_inside()) {
      finish(CoreStatus::overlapping);
      // If the stored points lie in a plane, only rounding makes them enclose the origin.
      constexpr double in_plane = 1e-13;
      if (query_.result.upper <= in_plane * query_.size) return true;
    } else if (count_ > 0) {
      if constexpr (any_slides) {
        if (may_slide_) {
          may_slide_ = false;
          if (try_flat_ends(query_, memory.axis) || slide(memory.axis, resumed_damping))
            return true;
          may_slide_ = true;
        }
      }
      constexpr double is_near = 1e-12;
      if (!may_slide_ && closest.squared > is_near * is_near * query_.size * query_.size) {
        squared = closest.squared;
        d = closest.v;
        return false;
      }
    }
    // Restarts GJK from the beginning.
    count_ = 0;
    query_.result.status = CoreStatus::unsettled;
    query_.result.upper = std::numeric_limits<double>::infinity();
    return false;
  }

  /// Takes the stored features, except numbers that are not features of these cores.
  void take_features_of(const PairMemory& memory) {
    const Vec3<double> of_b = query_.pair.to_b(-memory.axis);
    for (int i = 0; i < 4 && i < memory.count; ++i) {
      const int feature_a = memory.feature_a[i], feature_b = memory.feature_b[i];
      if (!is_feature_of(query_.pair.a, feature_a) || !is_feature_of(query_.pair.b, feature_b))
        continue;
      const Vec3<double> a = point_of_feature<A>(query_.pair.a, feature_a, memory.axis),
                         b = point_of_feature<B>(query_.pair.b, feature_b, of_b);
      a_[count_] = a;
      y_[count_] = query_.pair.x + query_.pair.turn * b - a;
      feature_a_[count_] = feature_a;
      feature_b_[count_] = feature_b;
      ++count_;
    }
  }

  void remember(PairMemory& memory, CoreStatus status) const {
    const bool slid = any_slides && (slides(query_.pair.a.kind) || slides(query_.pair.b.kind));
    memory.count = slid && status == CoreStatus::overlapping ? 0 : count_;
    std::copy(feature_a_, feature_a_ + count_, memory.feature_a);
    std::copy(feature_b_, feature_b_ + count_, memory.feature_b);
  }

  CoreDistance finish(CoreStatus status) {
    if (query_.search.memory) remember(*query_.search.memory, status);
    query_.result.status = status;
    if (count_ > 0) {
      query_.result.a.setZero();
      query_.result.c.setZero();
      for (int i = 0; i < count_; ++i) {
        query_.result.a += weight_[i] * a_[i];
        query_.result.c += weight_[i] * y_[i];
      }
      query_.result.upper = query_.result.c.norm();
    }
    // A separating plane is more reliable than a simplex that is flat to within rounding.
    if (status == CoreStatus::overlapping && query_.result.lower > 0)
      query_.result.status = CoreStatus::unsettled;
    if (count_ == 3 && status != CoreStatus::overlapping &&
        query_.result.upper - query_.result.lower > query_.gap)
      use_face();
    return query_.result;
  }

  /// Uses the normal of the simplex face that contains the closest point as the axis. If the cores
  /// nearly touch, the closest point itself has too few digits to give a direction.
  void use_face() {
    Vec3<double> n = (y_[1] - y_[0]).cross(y_[2] - y_[0]);
    const double length = n.norm();
    if (!(length > 0)) return;
    n *= (n.dot(query_.result.axis) < 0 ? -1 : 1) / length;
    query_.result.raise_lower(n.dot(query_.nearest(n).c), n);
    if (query_.result.status == CoreStatus::unsettled && query_.result.lower > 0)
      query_.result.status = CoreStatus::separated;
  }

  CoreQuery<A, B> query_;
  bool may_slide_;
  int count_ = 0;
  Vec3<double> y_[4], a_[4];
  int feature_a_[4], feature_b_[4];
  double weight_[4];
};

}  // namespace minkray
