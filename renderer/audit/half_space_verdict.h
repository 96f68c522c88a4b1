// SPDX-License-Identifier: MIT
// Checks a claim about a ray and a half-space by the half-space's inequality, in long double.
#pragma once

#include "core/proof/check_certificate.h"
#include "core/world/half_space.h"

namespace minkray {

CertificateVerdict verdict_of(const HalfSpaceBody<double>& half_space, const Ray<double>& ray,
                              const Claim& claim);

}  // namespace minkray
