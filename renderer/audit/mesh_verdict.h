// SPDX-License-Identifier: MIT
// What is claimed of a ray at a mesh, proven part by part: each triangle whose box the ray meets is
// a convex shape with certificates of its own.
#pragma once

#include "core/proof/check_certificate.h"
#include "core/world/posed_mesh.h"

namespace minkray {

/// A hit is proven by one triangle, and by all others being missed before it. `found` receives the
/// certificate of the triangle that is hit.
CertificateVerdict verdict_of(const PosedMesh& posed, const Ray<double>& ray, const Claim& claim,
                              Certificate* found = nullptr);

}  // namespace minkray
