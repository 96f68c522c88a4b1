// SPDX-License-Identifier: MIT
// Many rays at one shape, each answer certified and checked.
#pragma once

#include <string>
#include <vector>

#include "core/proof/check_certificate.h"
#include "renderer/paper/solvers.h"
#include "tests/support/ray_families.h"

namespace minkray::testing {

struct FailedCertificate {
  Ray<double> ray;
  Claim claim;
  CertificateVerdict verdict;
  Vec3<double> plane;
};

/// Extremes are in units of machine epsilon times the size (NearSegment::size); they are over the
/// certificates that hold.
struct CertifiedCasts {
  int hits = 0, misses = 0, insides = 0, exhausted = 0;
  int failed = 0;
  double gap = 0, lateral = 0, margin = 0, claim_error = 0;
  double t_error = 0;   ///< of the claimed t beyond [t_lo, t_hi], times cosine
  double supports = 0;  ///< for the certificates, in all
  std::vector<FailedCertificate> first_failures;  ///< at most three

  int rays() const { return hits + misses + insides + exhausted; }
  CertifiedCasts& operator+=(const CertifiedCasts& other);
};

/// Casts in T at the shape rounded to T, with rays rounded to T; proofs in double.
CertifiedCasts certified_casts(const Shape& shape, RayFamily family, int rays, std::uint64_t seed,
                               const Solver* solver = &solver::automatic);

}  // namespace minkray::testing
