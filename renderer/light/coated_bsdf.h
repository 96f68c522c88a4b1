// SPDX-License-Identifier: MIT
// Matt and glossy surfaces (renderer/light/reflection.h) as the path tracer asks for them.
#pragma once

#include "renderer/light/bsdf.h"

namespace minkray {

class CoatedBsdf final : public Bsdf {
 public:
  explicit CoatedBsdf(const Surface& surface) : surface_(surface) {}

  Colour eval(const Shading& at, const Vec3<double>& w_in) const override;
  double pdf(const Shading& at, const Vec3<double>& w_in) const override;
  std::optional<BsdfSample> sample(const Shading& at, const BsdfChoice& choice) const override;

 private:
  Surface surface_;
};

}  // namespace minkray
