// SPDX-License-Identifier: MIT
#include "core/parts/parts_contact.h"

#include "core/parts/one_part.h"
#include "core/parts/other_parts.h"
#include "core/parts/parts_distance.h"
#include "core/parts/parts_impact.h"

namespace minkray {
namespace {

/// Returns false if the result belongs to no pair of parts: one body is inside the other, or they
/// miss.
bool has_parts(const PartPair& parts, const PartsBody& a, const PartsBody& b) {
  return (a.shape() || parts.a != no_part) && (b.shape() || parts.b != no_part);
}

/// True if a vertex other than the lowest one may be as low. `found` is of the posed mesh and a
/// half-space.
bool has_other_lowest(const TriangleMesh& mesh, const Affine<double>& pose,
                      const SignedDistance& found, const Drift& drift) {
  const Vec3<double> up = pose.linear.transpose() * found.normal,
                     lowest = pose.linear.transpose() * (found.point_b - pose.translation);
  constexpr double tilt = 1e-12, same = 1e-12;  // of directions; of the mesh's size
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  const double near = same * mesh.reach() + rounding * pose.translation.norm();
  for (const Corners& corners : mesh.triangles())
    for (const std::uint32_t corner : corners) {
      const Vec3<double> to = mesh.vertices()[corner] - lowest;
      const double length = to.norm();
      if (length > near && up.dot(to) <= (tilt + drift.turn) * length + near) return true;
    }
  return false;
}

/// Derivative for the lowest part of a compound; a ridge if another part may be as low.
PairDerivative derivative_of_lowest(const Vec3<double>& origin, const Compound& compound,
                                    const Affine<double>& pose, const SignedDistance& found,
                                    PairDerivativeError* error, const Drift& drift) {
  const PlacedPlane plane = {found.normal, TwoFoldVec3<double>(found.point_a)};
  const auto height_of = [&](std::size_t i) {
    const ContactShape& part = compound.contact(i);
    return distance_to_half_space(plane, part, pose.linear, placed_middle(part, pose)).value;
  };
  const double near = 1e-12 * compound.reach() + drift.turn * compound.reach() +
                      8 * std::numeric_limits<double>::epsilon() * pose.translation.norm();
  double least = std::numeric_limits<double>::infinity(), next = least;
  std::size_t lowest = 0;
  for (std::size_t i = 0; i < compound.size(); ++i) {
    const double height = height_of(i);
    if (height < least) {
      next = least;
      least = height;
      lowest = i;
    } else {
      next = std::min(next, height);
    }
  }
  PairDerivative derivative =
      derivative_at_half_space(origin, compound.contact(lowest), pose, found, error, drift);
  if (derivative.is_ridge || next > least + 2 * near) return derivative;
  derivative.is_ridge = true;
  if (error) *error = {};
  return derivative;
}

}  // namespace

PairDerivative derivative_of(const PartsBody& a, const Affine<double>& pose_a, const PartsBody& b,
                             const Affine<double>& pose_b) {
  PartPair parts;
  const SignedDistance found = signed_distance(a, pose_a, b, pose_b, {}, &parts);
  if (found.status != SignedStatus::separated || !has_parts(parts, a, b)) {
    PairDerivative none = {};
    none.is_ridge = true;
    return none;
  }
  PairDerivative derivative = finest_derivative_of(OnePart(a, parts.a).shape(), pose_a,
                                                   OnePart(b, parts.b).shape(), pose_b);
  if (!derivative.is_ridge)
    derivative.is_ridge =
        differ_in_derivative(a, pose_a, b, pose_b, parts, found.upper, derivative);
  return derivative;
}

PairDerivative derivative_at_half_space(const Vec3<double>& origin, const PartsBody& b,
                                        const Affine<double>& pose_b, const SignedDistance& found,
                                        PairDerivativeError* error, const Drift& drift) {
  if (b.shape()) return derivative_at_half_space(origin, *b.shape(), pose_b, found, error, drift);
  if (b.compound()) return derivative_of_lowest(origin, *b.compound(), pose_b, found, error, drift);
  // A half-space sees the lowest vertex only.
  static const ContactShape point{Shape(Point())};
  PairDerivative derivative = derivative_at_half_space(origin, point, pose_b, found, error, drift);
  if (derivative.is_ridge) return derivative;
  derivative.is_ridge = has_other_lowest(*b.mesh(), pose_b, found, drift);
  if (error && derivative.is_ridge) *error = {};
  return derivative;
}

PairDerivative derivative_of(const PartsBody& a, const RigidMotion& motion_a, const PartsBody& b,
                             const RigidMotion& motion_b, double t_max) {
  PartPair parts;
  const Impact found = first_impact(a, motion_a, b, motion_b, t_max, {}, &parts);
  if (!has_parts(parts, a, b)) {
    PairDerivative none = {};
    none.is_ridge = found.status != ImpactStatus::miss;
    return none;
  }
  PairDerivative derivative = derivative_of(OnePart(a, parts.a).shape(), motion_a,
                                            OnePart(b, parts.b).shape(), motion_b, found);
  if (!derivative.is_ridge && found.status == ImpactStatus::hit)
    derivative.is_ridge = differ_in_derivative(a, motion_a, b, motion_b, parts, found, derivative);
  return derivative;
}

}  // namespace minkray
