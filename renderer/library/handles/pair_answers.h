// SPDX-License-Identifier: MIT
// Queries and results on pairs of shapes in the C interface's types.
#pragma once

#include <algorithm>

#include "core/pair_distance/manifold.h"
#include "core/pair_distance/signed_distance.h"
#include "core/pair_motion/impact.h"
#include "renderer/library/handles/c_header.h"

namespace minkray {

/// Reads options, which may be null. Throws CallError if they are invalid.
SignedDistanceOptions distance_options(const minkray_distance_options* given);

minkray_distance_status code_of(SignedStatus status);
minkray_impact_status code_of(ImpactStatus status);

minkray_distance plain_distance(const SignedDistance& found);
minkray_impact plain_impact(const Impact& found);
minkray_manifold plain_manifold(const SignedDistance& nearest, const ContactManifold& found);

/// Throws CallError unless there is one time for each pair, or one for all, finite and at least 0.
void check_ends(const double* t_max, std::size_t have, std::size_t pairs);

/// The time at which they touch; infinite if nothing is known of it.
inline double end_of(const Impact& found) {
  const bool touch = found.status == ImpactStatus::hit || found.status == ImpactStatus::inside;
  return touch ? found.t_hi : std::numeric_limits<double>::infinity();
}

/// Three numbers of an array of threes. Not by std::copy_n, which is a call.
inline void put(const Vec3<double>& from, double* to, std::size_t i = 0) {
  if (!to) return;
  for (std::size_t k = 0; k < 3; ++k) to[3 * i + k] = from[static_cast<Eigen::Index>(k)];
}

}  // namespace minkray
