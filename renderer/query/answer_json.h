// SPDX-License-Identifier: MIT
// Keys of answers that shapes and meshes have in common.
#pragma once

#include "core/pair_distance/manifold.h"
#include "core/pair_motion/impact.h"
#include "renderer/query/answer.h"

namespace minkray {

/// Status, t with its bounds, and normal.
void add_cast(Answer& answer, const CastResult<double>& result);
/// The ray's point at t, if there is a hit.
void add_hit_point(Answer& answer, const Ray<double>& ray, const CastResult<double>& result);
/// The margins of a certificate (docs/certificates.md).
void add_verdict(Answer& answer, const CertificateVerdict& verdict, Status status);

void add_normal(Answer& answer, const Vec3<double>& normal);
/// Status, value, bounds, normal and points.
void add_signed_distance(Answer& answer, const SignedDistance& result);
void add_contacts(Answer& answer, const SignedDistance& nearest, const ContactManifold& found);
void add_impact(Answer& answer, const Impact& result);

}  // namespace minkray
