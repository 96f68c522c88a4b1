// SPDX-License-Identifier: MIT
#include "tests/proof/certified_casts.h"

#include "core/cast/cast.h"

namespace minkray::testing {

CertifiedCasts& CertifiedCasts::operator+=(const CertifiedCasts& other) {
  hits += other.hits;
  misses += other.misses;
  insides += other.insides;
  exhausted += other.exhausted;
  failed += other.failed;
  gap = std::max(gap, other.gap);
  lateral = std::max(lateral, other.lateral);
  margin = std::max(margin, other.margin);
  claim_error = std::max(claim_error, other.claim_error);
  t_error = std::max(t_error, other.t_error);
  supports += other.supports;
  for (const FailedCertificate& failure : other.first_failures)
    if (first_failures.size() < 3) first_failures.push_back(failure);
  return *this;
}

CertifiedCasts certified_casts(const Shape& shape, RayFamily family, int rays, std::uint64_t seed,
                               const Solver* solver) {
  const PreparedShape prepared(shape);
  const SupportFunction support = supports_of(shape);
  const CastOptions options{solver};
  FamilyRays source(shape, family, seed);
  CertifiedCasts all;
  for (int i = 0; i < rays; ++i) {
    const Ray<double> ray = source.next();
    const Claim claim = claim_of(cast_ray(prepared, ray, options));
    if (claim.status == Status::exhausted) {
      ++all.exhausted;
      if (all.first_failures.size() < 3)
        all.first_failures.push_back({ray, claim, {}, Vec3<double>::Zero()});
      continue;
    }
    const Certificate certificate = certify(support, ray, claim);
    const CertificateVerdict verdict = check_certificate(support, ray, claim, certificate);
    all.supports += certificate.supports;
    ++(claim.status == Status::hit ? all.hits
                                   : (claim.status == Status::miss ? all.misses : all.insides));
    if (!verdict.holds) {
      ++all.failed;
      if (all.first_failures.size() < 3)
        all.first_failures.push_back({ray, claim, verdict, certificate.plane});
      continue;
    }
    const double unit_length = verdict.allowed / certificate_rounding;
    if (claim.status == Status::miss) {
      all.margin = std::max(all.margin, -verdict.margin / unit_length);
      continue;
    }
    all.lateral = std::max(all.lateral, verdict.lateral / unit_length);
    all.gap = std::max(all.gap, verdict.gap / unit_length);
    all.claim_error = std::max(all.claim_error, verdict.claim_error / unit_length);
    if (claim.status != Status::hit) continue;
    const double late = verdict.late * std::abs(claim.normal.dot(ray.direction.normalized()));
    all.t_error = std::max(all.t_error, late / unit_length);
  }
  return all;
}

}  // namespace minkray::testing
