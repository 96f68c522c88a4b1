// SPDX-License-Identifier: MIT
#include "renderer/surfaces/conductor_bsdf.h"

#include <algorithm>

namespace minkray {
namespace {

/// Largest anisotropy: the roughnesses along and across then have the ratio 1 / (1 - this) (Burley,
/// "Physically Based Shading at Disney", 2012).
constexpr double most_anisotropy = 0.9;

}  // namespace

double fresnel_of_metal(double cosine, double eta, double k) {
  const double c = std::clamp(cosine, 0.0, 1.0), c2 = c * c, s2 = 1 - c2;
  const double t0 = eta * eta - k * k - s2;
  const double a2_plus_b2 = std::sqrt(t0 * t0 + 4 * eta * eta * k * k);
  const double a = std::sqrt(std::max((a2_plus_b2 + t0) / 2, 0.0));
  const double t1 = a2_plus_b2 + c2, t2 = 2 * c * a;
  const double across = (t1 - t2) / (t1 + t2);
  const double t3 = c2 * a2_plus_b2 + s2 * s2, t4 = t2 * s2;
  const double along = across * (t3 - t4) / (t3 + t4);
  return (across + along) / 2;
}

MetalFresnel::MetalFresnel(const Metal& metal) : metal_(&metal) {
  for (int i = 0; i < 3; ++i)
    straight_ahead_[i] = fresnel_of_metal(1, metal.eta[static_cast<std::size_t>(i)],
                                          metal.k[static_cast<std::size_t>(i)]);
}

Colour MetalFresnel::operator()(double cosine) const {
  const double c = std::clamp(cosine, 0.0, 1.0);
  if (!metal_) {
    const double grazing = (1 - c) * (1 - c) * (1 - c) * (1 - c) * (1 - c);
    return straight_ahead_ + grazing * (Colour::Ones() - straight_ahead_);
  }
  return {fresnel_of_metal(c, metal_->eta[0], metal_->k[0]),
          fresnel_of_metal(c, metal_->eta[1], metal_->k[1]),
          fresnel_of_metal(c, metal_->eta[2], metal_->k[2])};
}

ConductorBsdf::ConductorBsdf(const MetalFresnel& fresnel, double roughness, double anisotropy)
    : fresnel_(fresnel) {
  const double alpha = Microfacets::alpha_of(roughness);
  if (alpha < Microfacets::smallest_alpha) return;
  const double aspect = std::sqrt(1 - most_anisotropy * anisotropy);
  rough_ = Microfacets{std::min(alpha / aspect, 1.0),
                       std::max(alpha * aspect, Microfacets::smallest_alpha)};
  kept_ = KeptEnergy::of_mirror(*rough_);
}

ConductorBsdf::ConductorBsdf(const Paint& colour, double roughness, double anisotropy)
    : ConductorBsdf(MetalFresnel(colour.colour()), roughness, anisotropy) {
  colour_ = colour;
}

MetalFresnel ConductorBsdf::fresnel(const Shading& at) const {
  return colour_ ? MetalFresnel(colour_of(*colour_, at)) : fresnel_;
}

Colour ConductorBsdf::weight(const Shading& at, const Vec3<double>& w_in, double cosine) const {
  const MetalFresnel fresnel = this->fresnel(at);
  const double kept = (*kept_)(at.w_out);
  const Colour put_back = Colour::Ones() + (1 / kept - 1) * fresnel.straight_ahead();
  return rough_->shadowing(at.w_out, w_in) * fresnel(cosine).cwiseProduct(put_back);
}

double ConductorBsdf::pdf(const Shading& at, const Vec3<double>& w_in) const {
  if (!rough_ || !(at.w_out.z() > 0) || !(w_in.z() > 0)) return 0;
  const Vec3<double> m = (at.w_out + w_in).normalized();
  return rough_->visible_density(at.w_out, m) / (4 * m.dot(at.w_out));
}

Colour ConductorBsdf::eval(const Shading& at, const Vec3<double>& w_in) const {
  const double density = pdf(at, w_in);
  if (!(density > 0)) return Colour::Zero();
  const Vec3<double> m = (at.w_out + w_in).normalized();
  return density * weight(at, w_in, m.dot(w_in));
}

std::optional<BsdfSample> ConductorBsdf::sample(const Shading& at, const BsdfChoice& choice) const {
  const Vec3<double>& w_out = at.w_out;
  if (!(w_out.z() > 0)) return std::nullopt;
  if (!rough_)
    return BsdfSample{{-w_out.x(), -w_out.y(), w_out.z()}, fresnel(at)(w_out.z()), 0, true};
  const Vec3<double> m = rough_->visible_normal(w_out, choice.u);
  const Vec3<double> w_in = 2 * m.dot(w_out) * m - w_out;
  const double density = pdf(at, w_in);
  if (!(w_in.z() > 0) || !(density > 0)) return std::nullopt;
  return BsdfSample{w_in, weight(at, w_in, m.dot(w_in)), density, false};
}

std::unique_ptr<const Bsdf> make_conductor(const ConductorMaterial& material) {
  const auto metal = std::find_if(metals.begin(), metals.end(), [&](const Metal& known) {
    return known.name == material.metal.name;
  });
  if (metal != metals.end())
    return std::make_unique<ConductorBsdf>(MetalFresnel(*metal), material.roughness,
                                           material.anisotropy);
  return std::make_unique<ConductorBsdf>(material.colour.value_or(Colour::Ones()),
                                         material.roughness, material.anisotropy);
}

}  // namespace minkray
