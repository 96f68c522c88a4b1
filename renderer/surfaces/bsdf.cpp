// SPDX-License-Identifier: MIT
#include "renderer/surfaces/bsdf.h"

#include "renderer/surfaces/coated_bsdf.h"
#include "renderer/surfaces/conductor_bsdf.h"
#include "renderer/surfaces/dielectric_bsdf.h"
#include "renderer/surfaces/principled_bsdf.h"
#include "renderer/surfaces/translucent_bsdf.h"

namespace minkray {
namespace {

/// Absorbs all light, as bodies do that only shine.
class BlackBsdf final : public Bsdf {
 public:
  Colour eval(const Shading&, const Vec3<double>&) const override { return Colour::Zero(); }
  double pdf(const Shading&, const Vec3<double>&) const override { return 0; }
  std::optional<BsdfSample> sample(const Shading&, const BsdfChoice&) const override {
    return std::nullopt;
  }
  bool is_sharp() const override { return true; }
};

/// One for each kind of material.
struct Maker {
  using Made = std::unique_ptr<const Bsdf>;

  const Material& material;

  Made operator()(const LambertMaterial& matt) const {
    return std::make_unique<CoatedBsdf>(Surface(material), matt.colour);
  }
  Made operator()(const GlossyMaterial& glossy) const {
    return std::make_unique<CoatedBsdf>(Surface(material), glossy.colour);
  }
  Made operator()(const EmissiveMaterial&) const { return std::make_unique<BlackBsdf>(); }
  Made operator()(const DielectricMaterial& glass) const {
    return std::make_unique<DielectricBsdf>(glass.roughness, glass.index_of_refraction);
  }
  Made operator()(const ConductorMaterial& metal) const { return make_conductor(metal); }
  Made operator()(const PrincipledMaterial& layers) const {
    return std::make_unique<PrincipledBsdf>(layers);
  }
  Made operator()(const TranslucentMaterial& sheet) const {
    return std::make_unique<TranslucentBsdf>(sheet);
  }
  Made operator()(const MixMaterial&) const { return std::make_unique<BlackBsdf>(); }
};

}  // namespace

std::unique_ptr<const Bsdf> make_bsdf(const Material& material) {
  return std::visit(Maker{material}, material.kind);
}

}  // namespace minkray
