// SPDX-License-Identifier: MIT
// First contact of a core that moves without turning and a core at rest: a ray cast at C = B - A by
// portals (G. Snethen, "XenoCollide", in Game Programming Gems 7, 2008). GJK on C projected along
// the motion finds a portal (three points around the origin) or proves a miss. Support points move
// the portal outwards; the portal and the supporting plane bound the time. Exact for polytopes.
// Curved pairs use sliding_portal.h: round ones at once, others after a few iterations.
#pragma once

#include <algorithm>

#include "core/pair_motion/sliding_portal.h"

namespace minkray {

template <CoreKind A, CoreKind B>
class SweptPortal {
 public:
  /// B moves by t * velocity in A's frame, for 0 <= t <= t_max. Miss: a plane separates the cores
  /// by more than `near` at all times. Hit: between the two bounds of the time, B moves at most
  /// `near`.
  SweptPortal(const CorePair& pair, const Vec3<double>& velocity, double t_max, double near,
              bool is_for_derivatives)
      : query_(pair, velocity, t_max, near, is_for_derivatives) {
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

  /// True if C is a polytope: the portal is then a part of a face.
  bool is_polytope() const {
    const auto is_flat = [](CoreKind kind) { return kind != CoreKind::other && !slides(kind); };
    return is_flat(query_.pair.a.kind) && is_flat(query_.pair.b.kind) && !(query_.radius > 0);
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
      if (query_.has_met()) return end_hit();
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
      if (query_.has_met()) return end_hit();
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

  /// Ends the search with a hit on the portal.
  void end_hit() {
    query_.end_hit();
    if (query_.is_for_derivatives && !is_polytope()) sharpen();
  }

  /// Improves the axis by the portal, and estimates its error. With the weights w_i of the contact,
  /// the gap between the bounds limits the height of the true plane above the point i to gap / w_i:
  /// the plane is known along long edges.
  void sharpen() {
    const double c01 = side(0, 1), c12 = side(1, 2), c20 = side(2, 0), area = c01 + c12 + c20;
    const double weights[3] = {c12 / area, c20 / area, c01 / area};
    if (!(weights[0] > 0 && weights[1] > 0 && weights[2] > 0)) return;
    double height = 0, longest = 0;
    for (int i = 0; i < 3; ++i) height -= weights[i] * portal_[i].h;
    const double gap = query_.approach_of_axis() * (height / query_.speed - query_.result.t_lo) +
                       2 * query_.rounding;
    Vec3<double> curved = Vec3<double>::Zero();
    // Largest errors, in radians, of what may be a face or an edge: others are too short.
    constexpr double of_plausible_face = 1e-5, of_plausible_edge = 1e-6;
    int flattest = -1;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const double length = edge(i).norm();
      longest = std::max(longest, length);
      const double tilt = gap / (std::min(weights[i], weights[j]) * length);
      if (tilt <= of_plausible_edge && (flattest < 0 || bend(i) < bend(flattest))) flattest = i;
      curved += weights[i] * normal(i);
    }
    Vec3<double> n = edge(0).cross(edge(1));
    if (n.dot(query_.along) > 0) n = -n;
    double of_face = gap * longest / (std::min({weights[0], weights[1], weights[2]}) * n.norm());
    // The plane itself gives a smaller gap.
    if (of_face > query_.small_axis_error && of_face <= of_plausible_face)
      of_face *= (n.dot(portal_[0].y - query_.support(n).y) / n.norm() + 2 * query_.rounding) / gap;
    if (of_face <= query_.small_axis_error)
      query_.take_axis(n, of_face);
    else if (flattest < 0 || !sharpen_on_edge(flattest, curved))
      sharpen_curved(curved);
  }

  Vec3<double> edge(int i) const { return portal_[(i + 1) % 3].y - portal_[i].y; }
  /// Normal along which the point is furthest.
  Vec3<double> normal(int i) const { return portal_[i].d / portal_[i].d.norm(); }
  double bend(int i) const { return (normal((i + 1) % 3) - normal(i)).norm(); }

  /// For a contact with an edge of C, curved across: n interpolates normals with the weights, which
  /// is accurate if the curvature is the same all along the edge. Then the edge whose normal is n,
  /// between the support points along two slightly turned normals, meets the line of motion.
  /// Returns false if these points are not the ends of an edge.
  bool sharpen_on_edge(int i, Vec3<double> n) {
    constexpr double turn = 1e-9;  // bounds the error along the edge
    const Vec3<double> all = edge(i), along = all / all.norm();
    n -= along.dot(n) * along;
    const SweptPoint one = query_.support(n + turn * along),
                     other = query_.support(n - turn * along);
    const auto length = [](double p, double q) { return std::sqrt(p * p + q * q); };
    if (!((other.y - one.y).norm() > 0.5 * all.norm())) return false;
    const double off = std::abs(cross(one, other)) / length(other.p - one.p, other.q - one.q);
    const int j = (i + 1) % 3, k = (i + 2) % 3, side = bend(j) > bend(k) ? j : k;
    const double p = query_.e0.dot(along), q = query_.e1.dot(along);
    const Vec3<double> across = edge(side);
    const double width =
        std::abs(query_.e0.dot(across) * q - query_.e1.dot(across) * p) / length(p, q);
    if (!is_flat(width, bend(side)))
      take_estimate(n, (off + query_.rounding) * bend(side) / width, turn);
    return true;
  }

  /// For a curved surface, n interpolates normals as the contact interpolates their points. A step
  /// of the secant method for the normal whose support point is on the line of motion estimates the
  /// error.
  void sharpen_curved(const Vec3<double>& n) {
    const SweptPoint there = query_.support(n);
    const double p1 = portal_[1].p - portal_[0].p, q1 = portal_[1].q - portal_[0].q,
                 p2 = portal_[2].p - portal_[0].p, q2 = portal_[2].q - portal_[0].q;
    const double size = std::max(std::abs(p1) + std::abs(q1), std::abs(p2) + std::abs(q2)),
                 off = std::abs(there.p) + std::abs(there.q), area = std::abs(p1 * q2 - q1 * p2);
    const Vec3<double> one = normal(1) - normal(0), other = normal(2) - normal(0);
    constexpr double near = 1e-3;  // further away, relative to the portal, the surface has a corner
    if (!(off <= near * size) || is_flat(size, std::max(one.norm(), other.norm()))) return;
    const Vec3<double> step =
        (there.p * q2 - there.q * p2) / area * one + (p1 * there.q - q1 * there.p) / area * other;
    take_estimate(n, step.norm() + query_.rounding * size * (one.norm() + other.norm()) / area, 0);
  }

  /// True if the surface bends so little that it may be a face, whose normal the normals of its
  /// corners do not determine.
  bool is_flat(double width, double bend) const {
    constexpr double most = 1e3;  // radius of curvature in sizes
    return !(width <= most * query_.size * bend);
  }
  void take_estimate(const Vec3<double>& n, double estimate, double proven) {
    constexpr double doubt = 10;  // the curvature may differ from that of the portal
    const double error = doubt * estimate + proven;
    if (error <= query_.small_axis_error) query_.take_axis(n, error);
  }

  SweptQuery<A, B> query_;
  bool can_slide_;
  SweptPoint portal_[3];
};

}  // namespace minkray
