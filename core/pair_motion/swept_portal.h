// SPDX-License-Identifier: MIT
// First contact of a core that moves without turning and a core at rest: a ray cast at C = B - A by
// portals (G. Snethen, "XenoCollide", in Game Programming Gems 7, 2008). GJK on C projected along
// the motion finds a portal (three points around the origin) or proves a miss. Support points move
// the portal outwards; the portal and the supporting plane bound the time. Exact for polytopes.
// Curved pairs use sliding_portal.h: round ones at once, others after a few iterations.
#pragma once

#include "core/pair_motion/sliding_portal.h"

namespace minkray {

template <CoreKind A, CoreKind B>
class SweptPortal {
 public:
  /// B moves by t * velocity in A's frame, for 0 <= t <= t_max. Miss: a plane separates the cores
  /// by more than `near` at all times. Hit: between the two bounds of the time, B moves at most
  /// `near`.
  SweptPortal(const CorePair& pair, const Vec3<double>& velocity, double t_max, double near)
      : query_(pair, velocity, t_max, near) {
    can_slide_ = pair.a.kind != CoreKind::other && pair.b.kind != CoreKind::other &&
                 (slides(pair.a.kind) || slides(pair.b.kind) || query_.radius > 0);
  }

  /// Runs the search. If `memory` is not null, tries the stored plane first.
  SweptTime run(const PairMemory* memory) {
    if (!(query_.speed > 0) || query_.passes_by()) return query_.result;
    if (memory && memory->has_axis()) {
      if (query_.judge(memory->axis, query_.support(memory->axis))) return query_.result;
    }
    if (can_slide_ && (is_smooth() || have_rims())) {
      const double damping = is_smooth() ? near_damping : far_damping;
      if (SlidingPortal<A, B>(query_).run(first_normal(), damping)) return query_.result;
    }
    portal_[0] = query_.support(-query_.along);
    if (!query_.judge(-query_.along, portal_[0]) && surround()) refine();
    return query_.result;
  }

 private:
  static constexpr int most_turns = 200;
  /// Number of portal iterations before sliding features take over.
  static constexpr int turns_plain = 3;
  static constexpr double near_damping = 0.1, far_damping = 1;

  /// True if C is round. Sliding features then converge without a portal.
  bool is_smooth() const {
    constexpr double of_size = 0.15;
    return query_.pair.a.kind == CoreKind::ellipsoid || query_.pair.b.kind == CoreKind::ellipsoid ||
           query_.radius > of_size * query_.size;
  }
  /// True for two cylinders or cones, which have few corners.
  bool have_rims() const {
    return query_.pair.a.kind == CoreKind::disks && query_.pair.b.kind == CoreKind::disks;
  }

  /// Normal where the motion meets a ball around C's middle.
  Vec3<double> first_normal() const {
    const Vec3<double>&u = query_.along, aside = query_.pair.x - query_.pair.x.dot(u) * u;
    constexpr double of_size = 0.8, most = 0.9;
    const double radius = of_size * query_.size, sine = aside.norm() / radius,
                 turn = std::min(sine, most);
    const double share = sine > 0 ? turn / (sine * radius) : 0;
    return share * aside - std::sqrt(1 - turn * turn) * u;
  }

  /// Finds three points whose projections enclose the origin. Returns false for a miss, or if
  /// undecided.
  bool surround() {
    double dp = portal_[0].p, dq = portal_[0].q;
    int count = 1;
    for (int turn = 0; turn < most_turns; ++turn) {
      Vec3<double> d = dp * query_.e0 + dq * query_.e1;
      if (!(d.squaredNorm() > 0)) d = query_.e0;
      portal_[count] = query_.support(d);
      const SweptPoint& w = portal_[count];
      const double reach = w.p * dp + w.q * dq, length = std::sqrt(dp * dp + dq * dq);
      if (reach > (query_.near + query_.rounding) * length) {
        query_.end(SweptStatus::miss, d);
        return false;
      }
      if (reach > 0) return false;  // too close to decide
      if (++count == 3) {
        const double c01 = side(0, 1), c12 = side(1, 2), c20 = side(2, 0), area = c01 + c12 + c20;
        const double sign = area < 0 ? -1 : 1;
        if (sign * c12 < 0) {
          portal_[0] = portal_[2];
        } else if (sign * c20 < 0) {
          portal_[1] = portal_[2];
        } else {
          return sign * c01 >= 0 && std::abs(area) > 0;
        }
        count = 2;
      }
      // Perpendicular to the edge, away from the origin.
      const double ep = portal_[1].p - portal_[0].p, eq = portal_[1].q - portal_[0].q;
      dp = -eq;
      dq = ep;
      if (dp * portal_[0].p + dq * portal_[0].q < 0) {
        dp = -dp;
        dq = -dq;
      }
      constexpr double on_edge = 1e-15;
      const double edge = std::sqrt(ep * ep + eq * eq);
      if (!(edge > 0)) return false;
      if (turn > 0 && dp * portal_[0].p + dq * portal_[0].q <= on_edge * query_.size * edge)
        return false;
    }
    return false;
  }

  /// Twice the signed area of the triangle formed by the origin and the projections of points i and
  /// j.
  double side(int i, int j) const { return cross(portal_[i], portal_[j]); }

  /// Moves the portal outwards until both bounds meet, or as far as rounding allows.
  void refine() {
    for (int turn = 0; turn < most_turns; ++turn) {
      const double area = side(0, 1) + side(1, 2) + side(2, 0);
      query_.pierce(portal_[0], portal_[1], portal_[2]);
      if (query_.has_met() && query_.end_hit()) return;
      Vec3<double> n = (portal_[1].y - portal_[0].y).cross(portal_[2].y - portal_[0].y);
      if (n.dot(query_.along) > 0) n = -n;
      if (can_slide_ && turn >= turns_plain && n.dot(query_.along) < 0) {
        can_slide_ = false;
        SlidingPortal<A, B> sliding(query_);
        const double weights[3] = {side(1, 2) / area, side(2, 0) / area, side(0, 1) / area};
        for (int i = 0; i < 3; ++i)
          sliding.add(portal_[i].feature_a, portal_[i].feature_b, weights[i]);
        if (sliding.run(n, near_damping)) return;
      }
      if (!(n.squaredNorm() > 0)) return;
      const SweptPoint w = query_.support(n);
      if (query_.judge(n, w)) return;
      if (query_.has_met() && query_.end_hit()) return;
      // The new point divides the triangle into three; this keeps the one that contains the origin.
      const double sign = area < 0 ? -1 : 1, at0 = sign * cross(portal_[0], w),
                   at1 = sign * cross(portal_[1], w), at2 = sign * cross(portal_[2], w);
      if (at0 <= 0 && at1 >= 0)
        portal_[2] = w;
      else if (at1 <= 0 && at2 >= 0)
        portal_[0] = w;
      else if (at2 <= 0 && at0 >= 0)
        portal_[1] = w;
      else
        return;
    }
  }

  SweptQuery<A, B> query_;
  bool can_slide_;
  SweptPoint portal_[3];
};

}  // namespace minkray
