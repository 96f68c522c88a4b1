// SPDX-License-Identifier: MIT
// Boundary of two clear media, smooth or rough (Walter et al., "Microfacet Models for Refraction
// through Rough Surfaces", 2007). Multiple scattering between facets is restored in proportion
// (Turquin, "Practical multiple scattering compensation for microfacet models", 2019).
#pragma once

#include "renderer/surfaces/bsdf.h"
#include "renderer/surfaces/kept_energy.h"
#include "renderer/surfaces/microfacets.h"

namespace minkray {

/// The fraction of unpolarised light that is mirrored, by the cosine of incidence >= 0 and the
/// index of refraction beyond over that before; 1 where all is.
double fresnel_either_way(double cosine, double eta);

class DielectricBsdf final : public Bsdf {
 public:
  /// Light transmitted at each boundary is dimmed to the root of `tint`: twice, to its colour.
  DielectricBsdf(double roughness, double index_of_refraction, const Paint& tint = Colour::Ones());

  Colour eval(const Shading& at, const Vec3<double>& w_in) const override;
  double pdf(const Shading& at, const Vec3<double>& w_in) const override;
  std::optional<BsdfSample> sample(const Shading& at, const BsdfChoice& choice) const override;
  bool is_sharp() const override { return !rough_; }
  bool lets_through() const override { return true; }

 private:
  struct Parts;
  std::optional<Parts> parts(const Shading& at, const Vec3<double>& w_in) const;

  Colour through(const Shading& at) const { return colour_of(tint_, at).cwiseSqrt(); }

  Paint tint_;
  std::optional<Microfacets> rough_;
  std::optional<KeptEnergy> kept_;
};

}  // namespace minkray
