// SPDX-License-Identifier: MIT
#include "core/proof/proven_cast.h"

#include <algorithm>
#include <cmath>

#include "core/proof/check_certificate.h"
#include "core/query/near_segment.h"
#include "core/query/tolerances.h"

namespace minkray {

ProvenCast proven(const Shape& shape, const Ball<double>& ball, const RayNearBall<double>& near,
                  const CastResult<double>& answer, bool before) {
  ProvenCast proof{answer};
  if (answer.status == Status::exhausted) return proof;
  const double reach = tolerance::proof_reach * ball.radius;
  const double begin = std::clamp(near.lambda_min, -reach, reach);
  const double end = std::clamp(near.lambda_max, -reach, reach);
  const Ray<double> ray{ball.centre + near.s + begin * near.r, near.r, end - begin};

  Claim claim = claim_of(answer);
  claim.epsilon *= tolerance::proof_roundings;
  claim.t_base = 0;
  claim.t_offset = (answer.t_offset - near.t_shift) / near.t_per_length - begin;
  const SupportFunction support = supports_of(shape);
  const double size = near_segment(support, ray).size,
               slope = std::max(-answer.normal.dot(near.r), tolerance::least_slope<double>);
  if (before) claim.t_offset -= tolerance::proof_good_enough * claim.epsilon * size / slope;
  const Certificate certificate = certify(support, ray, claim);
  proof.answer.supports += certificate.supports;
  CertificateVerdict verdict = check_certificate(support, ray, claim, certificate);
  const bool is_bounded = verdict.lateral <= verdict.allowed && verdict.gap <= verdict.allowed;
  if (answer.status == Status::hit && is_bounded) {
    const double first = verdict.t_base + verdict.offset_planes,
                 spanned = verdict.t_base + verdict.offset_spanned;
    claim.t_offset = std::clamp(spanned, 0.0, ray.t_max);
    verdict = check_certificate(support, ray, claim, certificate);
    if (verdict.holds) {
      // Bounds the displacement along the ray due to the point's distance from the ray and the
      // plane's rounding.
      const double along =
          (verdict.lateral + tolerance::plane_rounding<double> * size + near.loss) / slope;
      proof.answer.t_offset = near.t_offset(begin + claim.t_offset);
      const double digits =
          std::copysign(near.offset_rounding(proof.answer.t_offset), near.t_per_length);
      proof.answer.offset_lo =
          near.t_offset(begin + std::min(first, claim.t_offset) - along) - digits;
      proof.answer.offset_hi = near.t_offset(begin + claim.t_offset + along) + digits;
    }
  }
  proof.holds = verdict.holds;
  const double off = answer.status == Status::miss ? -verdict.margin : verdict.lateral;
  proof.is_sharp = verdict.holds && tolerance::proof_roundings * off <= verdict.allowed;
  return proof;
}

}  // namespace minkray
