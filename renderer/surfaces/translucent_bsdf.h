// SPDX-License-Identifier: MIT
// Thin sheet that scatters light evenly to both sides: paper, a leaf, a lampshade.
#pragma once

#include "renderer/surfaces/bsdf.h"

namespace minkray {

class TranslucentBsdf final : public Bsdf {
 public:
  explicit TranslucentBsdf(const TranslucentMaterial& material) : material_(material) {}

  Colour eval(const Shading& at, const Vec3<double>& w_in) const override;
  double pdf(const Shading& at, const Vec3<double>& w_in) const override;
  std::optional<BsdfSample> sample(const Shading& at, const BsdfChoice& choice) const override;
  bool lets_through() const override { return true; }

 private:
  /// Share of the scattered light that goes to the side of w_in.
  double part(const Shading& at, const Vec3<double>& w_in) const {
    const bool goes_through = (w_in.z() > 0) != (at.w_out.z() > 0);
    return goes_through ? material_.transmission : 1 - material_.transmission;
  }

  TranslucentMaterial material_;
};

}  // namespace minkray
