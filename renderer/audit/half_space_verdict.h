// SPDX-License-Identifier: MIT
// A half-space is its own proof: what is claimed of a ray is looked up in its inequality, in long
// double.
#pragma once

#include "core/proof/check_certificate.h"
#include "core/world/half_space.h"

namespace minkray {

CertificateVerdict verdict_of(const HalfSpaceBody<double>& half_space, const Ray<double>& ray,
                              const Claim& claim);

}  // namespace minkray
