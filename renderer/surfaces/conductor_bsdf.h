// SPDX-License-Identifier: MIT
// Metals, smooth or rough: Fresnel's law with a complex index of refraction, or Schlick's
// approximation from a colour. Multiple scattering between facets is restored (Turquin 2019).
#pragma once

#include "renderer/surfaces/bsdf.h"
#include "renderer/surfaces/kept_energy.h"
#include "renderer/surfaces/microfacets.h"

namespace minkray {

/// The fraction of light that a metal mirrors in air.
double fresnel_of_metal(double cosine, double eta, double k);

/// Reflectance of a metal by the cosine of incidence.
class MetalFresnel {
 public:
  explicit MetalFresnel(const Colour& straight_ahead) : straight_ahead_(straight_ahead) {}
  explicit MetalFresnel(const Metal& metal);

  Colour operator()(double cosine) const;
  const Colour& straight_ahead() const { return straight_ahead_; }

 private:
  const Metal* metal_ = nullptr;  ///< null: by colour alone
  Colour straight_ahead_;
};

class ConductorBsdf final : public Bsdf {
 public:
  /// Metal given by its table, or by a colour.
  ConductorBsdf(const MetalFresnel& fresnel, double roughness, double anisotropy);
  ConductorBsdf(const Paint& colour, double roughness, double anisotropy);

  Colour eval(const Shading& at, const Vec3<double>& w_in) const override;
  double pdf(const Shading& at, const Vec3<double>& w_in) const override;
  std::optional<BsdfSample> sample(const Shading& at, const BsdfChoice& choice) const override;
  bool is_sharp() const override { return !rough_; }
  bool has_grain() const override { return rough_ && rough_->alpha_x != rough_->alpha_y; }

 private:
  Colour weight(const Shading& at, const Vec3<double>& w_in, double cosine) const;
  MetalFresnel fresnel(const Shading& at) const;

  MetalFresnel fresnel_;
  std::optional<Paint> colour_;
  std::optional<Microfacets> rough_;
  std::optional<KeptEnergy> kept_;
};

/// As a material describes it.
std::unique_ptr<const Bsdf> make_conductor(const ConductorMaterial& material);

}  // namespace minkray
