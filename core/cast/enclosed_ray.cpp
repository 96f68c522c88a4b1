// SPDX-License-Identifier: MIT
#include "core/cast/enclosed_ray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace minkray {
namespace {

using Vec2 = Vec<double, 2>;

/// Angles between the normal and the first directions. The first is the square root of the machine
/// epsilon; the second is for corners that would be too close together with the first.
constexpr std::array tilts = {0x1p-26, 0x1p-20};
/// Limits of support calls for one tilt and for refining a portal.
constexpr int most_corners = 7, most_refinements = 32;
/// Stops refining when the bound is within this many times the plane's rounding.
constexpr double good_share = 3;

/// A support point relative to the hit: its offsets perpendicular to the ray and along it.
struct Corner {
  Vec2 beside = Vec2::Zero();
  double along = 0;
};

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// A triangle of support points that the ray crosses, and the search for it: GJK for a point in the
/// plane perpendicular to the ray.
class Portal {
 public:
  /// `rounding` is the error bound of corners.
  explicit Portal(double rounding) : rounding_(rounding) {}

  /// Least distance of the ray from the triangle's sides, so that rounding cannot move it outside.
  double least_distance() const { return 2 * rounding_; }

  void add(const Corner& corner) { corners_[size_++] = corner; }

  /// Returns the direction in which the next corner must lie beyond the ray. Drops a corner on the
  /// opposite side. Returns zero if the ray passes between three corners.
  Vec2 missing_side() {
    if (size_ == 2 && corners_[0].beside == corners_[1].beside) size_ = 1;
    if (size_ == 1) return -corners_[0].beside;
    if (size_ == 2) return beside_edge(0, 1, cross(corners_[0].beside, corners_[1].beside));
    const double turn = this->turn();
    double least = least_distance();
    std::size_t from = 3;
    for (std::size_t i = 0; i < 3; ++i) {
      const double within = distance_within(corners_[i], corners_[(i + 1) % 3], turn);
      if (within >= least) continue;
      least = within;
      from = i;
    }
    if (from == 3) return Vec2::Zero();
    const Vec2 outward = beside_edge(from, (from + 1) % 3, -turn);
    std::swap(corners_[(from + 2) % 3], corners_[2]);
    size_ = 2;
    return outward;
  }

  /// Slope of the triangle's plane: rise along the ray per distance perpendicular to it.
  Vec2 rise() const {
    const Vec2 u = corners_[1].beside - corners_[0].beside,
               v = corners_[2].beside - corners_[0].beside;
    const double du = corners_[1].along - corners_[0].along,
                 dv = corners_[2].along - corners_[0].along;
    return Vec2(v.y() * du - u.y() * dv, u.x() * dv - v.x() * du) / cross(u, v);
  }
  double along_ray() const { return corners_[0].along - rise().dot(corners_[0].beside); }

  /// Returns an upper bound of the parameter at which the ray crosses the triangle. Rounding of the
  /// corners moves the plane; the more the plane is slanted, the further the crossing moves along
  /// the ray.
  double latest() const {
    const Vec2 u = corners_[1].beside - corners_[0].beside,
               v = corners_[2].beside - corners_[0].beside;
    // Allows for the rounding of rise() in thin triangles.
    const double sliver = 4 * tolerance::epsilon<double> * u.norm() * v.norm() /
                          std::abs(cross(u, v)) *
                          (std::abs(corners_[1].along - corners_[0].along) +
                           std::abs(corners_[2].along - corners_[0].along));
    return along_ray() + rounding_ * std::sqrt(1 + rise().squaredNorm()) + sliver;
  }

  /// Replaces one corner so that the ray still passes through the triangle. Returns false if that
  /// is impossible.
  bool refine(const Corner& corner) {
    const double turn = this->turn();
    double best = least_distance();
    std::size_t replaced = 3;
    for (std::size_t i = 0; i < 3; ++i) {
      const Corner &a = corners_[(i + 1) % 3], &b = corners_[(i + 2) % 3];
      const double within = std::min({distance_within(a, b, turn), distance_within(b, corner, turn),
                                      distance_within(corner, a, turn)});
      if (!(within >= best)) continue;
      best = within;
      replaced = i;
    }
    if (replaced == 3) return false;
    corners_[replaced] = corner;
    return true;
  }

 private:
  /// Twice the triangle's signed area.
  double turn() const {
    return cross(corners_[1].beside - corners_[0].beside, corners_[2].beside - corners_[0].beside);
  }
  /// Distance at which the ray passes to the left of the edge; to the right if `turn` is negative.
  static double distance_within(const Corner& from, const Corner& to, double turn) {
    const double length = (to.beside - from.beside).norm();
    return length > 0 ? std::copysign(1.0, turn) * cross(from.beside, to.beside) / length : 0;
  }
  /// Vector perpendicular to the edge, to its left if the sign is positive.
  Vec2 beside_edge(std::size_t i, std::size_t j, double sign) const {
    const Vec2 edge = corners_[j].beside - corners_[i].beside;
    return Vec2(-edge.y(), edge.x()) * std::copysign(1.0, sign);
  }

  double rounding_;
  std::array<Corner, 3> corners_;
  std::size_t size_ = 0;
};

/// Support points of a shape in the ray's frame, relative to the hit.
class Seen {
 public:
  Seen(const PreparedShape& shape, const RayNearBall<double>& near, const Vec3<double>& x,
       const Vec3<double>& n)
      : shape_(shape),
        x_(x),
        r_(near.r),
        a_(r_.unitOrthogonal()),
        b_(r_.cross(a_)),
        n_(n),
        rounding_(tolerance::plane_rounding<double> * shape.inner_ball().radius + near.loss) {}

  /// Returns an upper bound of the parameter at which the ray enters the shape, relative to the
  /// hit; infinite if none is found.
  double latest() const {
    for (const double tilt : tilts) {
      Portal portal(rounding_);
      if (find(portal, tilt)) return refined(portal);
    }
    return std::numeric_limits<double>::infinity();
  }

 private:
  Vec3<double> beside(const Vec2& side) const { return side.x() * a_ + side.y() * b_; }
  Corner corner_along(const Vec3<double>& direction) const {
    const Vec3<double> seen =
        (shape_.inner_shape().support(direction) - shape_.inner_ball().centre) - x_;
    return {Vec2(a_.dot(seen), b_.dot(seen)), r_.dot(seen)};
  }

  bool find(Portal& portal, double tilt) const {
    // On curved surfaces three directions 120 degrees apart are enough.
    Vec2 side(1, 0);
    for (int i = 0; i < most_corners; ++i) {
      const Vec3<double> sideways = beside(side);
      const Corner corner =
          corner_along(n_ + tilt * unit<double>(sideways - n_.dot(sideways) * n_));
      if (!(side.dot(corner.beside) > portal.least_distance() * side.norm())) return false;
      portal.add(corner);
      side = i == 0 ? Vec2(-0.5, 0.8660254037844386) : portal.missing_side();
      if (side.isZero(0)) return true;
    }
    return false;
  }

  double refined(Portal& portal) const {
    double latest = portal.latest();
    const double good_enough = good_share * rounding_ / std::max(-n_.dot(r_), rounding_);
    for (int i = 0; i < most_refinements && !(latest <= good_enough); ++i) {
      const Vec2 rise = portal.rise();
      if (!portal.refine(corner_along(unit<double>(beside(rise) - r_)))) break;
      latest = std::min(latest, portal.latest());
    }
    return latest;
  }

  const PreparedShape& shape_;
  Vec3<double> x_, r_, a_, b_, n_;
  double rounding_;
};

}  // namespace

void enclose_ray(const PreparedShape& shape, const RayNearBall<double>& near,
                 const Vec3<double>& normal, CastResult<double>& hit) {
  const double lambda = (hit.t_offset - near.t_shift) / near.t_per_length;
  const Vec3<double> x = near.s + lambda * near.r;
  const double R = shape.inner_ball().radius;
  if (!(R > 0) || !x.allFinite()) return;
  const double latest = Seen(shape, near, x, unit<double>(normal)).latest();
  if (!std::isfinite(latest)) return;
  const double digits = std::copysign(near.offset_rounding(hit.t_offset), near.t_per_length);
  hit.offset_hi = near.t_offset(lambda + std::max(latest, 0.0)) + digits;
}

}  // namespace minkray
