// SPDX-License-Identifier: MIT
// Proves a claim about a ray and a mesh triangle by triangle: each whose box the ray meets is a
// convex shape with a certificate.
#pragma once

#include "core/proof/check_certificate.h"
#include "core/world/posed_mesh.h"

namespace minkray {

/// A hit is proven by one triangle, and by all others being missed before it. `leaves`: the ray
/// starts on the mesh, so misses are proven from leaving_mesh on. `found` receives the certificate
/// of the triangle that is hit.
CertificateVerdict verdict_of(const PosedMesh& posed, const Ray<double>& ray, const Claim& claim,
                              bool leaves = false, Certificate* found = nullptr);

}  // namespace minkray
