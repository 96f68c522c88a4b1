// SPDX-License-Identifier: MIT
#include "core/parts/parts_contact.h"

#include "core/parts/one_part.h"
#include "core/parts/parts_distance.h"
#include "core/parts/parts_impact.h"

namespace minkray {
namespace {

/// Returns false if the result belongs to no pair of parts: one body is inside the other, or they
/// miss.
bool has_parts(const PartPair& parts, const PartsBody& a, const PartsBody& b) {
  return (!a.mesh() || parts.a != no_part) && (!b.mesh() || parts.b != no_part);
}

}  // namespace

ContactManifold contact_manifold(const PartsBody& a, const Affine<double>& pose_a,
                                 const PartsBody& b, const Affine<double>& pose_b) {
  PartPair parts;
  signed_distance(a, pose_a, b, pose_b, {}, &parts);
  if (!has_parts(parts, a, b)) return {};
  const OnePart of_a(a, parts.a), of_b(b, parts.b);
  return contact_manifold(of_a.shape(), pose_a, of_b.shape(), pose_b,
                          signed_distance(of_a.shape(), pose_a, of_b.shape(), pose_b));
}

PairDerivative derivative_of(const PartsBody& a, const Affine<double>& pose_a, const PartsBody& b,
                             const Affine<double>& pose_b) {
  PartPair parts;
  const SignedDistance found = signed_distance(a, pose_a, b, pose_b, {}, &parts);
  if (found.status != SignedStatus::separated || !has_parts(parts, a, b)) {
    PairDerivative none = {};
    none.is_ridge = true;
    return none;
  }
  return finest_derivative_of(OnePart(a, parts.a).shape(), pose_a, OnePart(b, parts.b).shape(),
                              pose_b);
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
  return derivative_of(OnePart(a, parts.a).shape(), motion_a, OnePart(b, parts.b).shape(), motion_b,
                       found);
}

}  // namespace minkray
