// SPDX-License-Identifier: MIT
// Matt and glossy surfaces (renderer/surfaces/reflection.h) as BSDFs of the path tracer.
#pragma once

#include "renderer/surfaces/bsdf.h"

namespace minkray {

class CoatedBsdf final : public Bsdf {
 public:
  CoatedBsdf(const Surface& surface, const Paint& colour) : surface_(surface), colour_(colour) {}

  Colour eval(const Shading& at, const Vec3<double>& w_in) const override;
  double pdf(const Shading& at, const Vec3<double>& w_in) const override;
  std::optional<BsdfSample> sample(const Shading& at, const BsdfChoice& choice) const override;

 private:
  Surface surface(const Shading& at) const {
    return at.place && colour_.texture() ? surface_.recoloured(colour_of(colour_, at)) : surface_;
  }

  Surface surface_;
  Paint colour_;
};

}  // namespace minkray
