// SPDX-License-Identifier: MIT
// Principled BSDF after Burley ("Physically Based Shading at Disney", 2012, and "Extending the
// Disney BRDF", 2015), in layers: a clear coat over sheen over a mixture of metal, clear glass and
// a coated matt base. Each layer dims those below by its albedo for light that leaves along w_out
// (as in glTF and OpenPBR), so white surfaces lose no energy.
#pragma once

#include "renderer/surfaces/conductor_bsdf.h"
#include "renderer/surfaces/dielectric_bsdf.h"
#include "renderer/surfaces/lobes.h"

namespace minkray {

/// Share of an even light that a surface reflects along w_out, a table over its cosine.
class Albedo {
 public:
  explicit Albedo(const Bsdf& bsdf);
  double operator()(double cosine) const;

 private:
  static constexpr int cosines = 64;
  std::array<double, cosines> table_;  ///< by the cosine's square root, evenly
};

class PrincipledBsdf final : public Bsdf {
 public:
  explicit PrincipledBsdf(const PrincipledMaterial& material);

  Colour eval(const Shading& at, const Vec3<double>& w_in) const override;
  double pdf(const Shading& at, const Vec3<double>& w_in) const override;
  std::optional<BsdfSample> sample(const Shading& at, const BsdfChoice& choice) const override;
  bool lets_through() const override { return material_.transmission > 0; }
  bool has_grain() const override { return metal_.has_grain(); }

 private:
  using Lobes = std::array<Lobe, 6>;
  Lobes lobes(const Shading& at) const;

  PrincipledMaterial material_;
  std::unique_ptr<const Bsdf> coat_, sheen_, sheet_, matt_;
  ConductorBsdf metal_;
  DielectricBsdf glass_;
  Albedo of_coat_, of_sheen_, of_sheet_;
};

}  // namespace minkray
