// SPDX-License-Identifier: MIT
#include "renderer/surfaces/dielectric_bsdf.h"

#include <algorithm>

namespace minkray {
namespace {

/// Surface as seen from the side of w_out, which is above.
struct Seen {
  Vec3<double> w_out;
  double sign;  ///< of z
  double eta;   ///< beyond over before

  explicit Seen(const Shading& at)
      : w_out(at.w_out.z() < 0 ? Vec3<double>(at.w_out.x(), at.w_out.y(), -at.w_out.z())
                               : at.w_out),
        sign(at.w_out.z() < 0 ? -1 : 1),
        eta(at.w_out.z() < 0 ? at.eta_above / at.eta_below : at.eta_below / at.eta_above) {}

  Vec3<double> back(const Vec3<double>& w) const { return {w.x(), w.y(), sign * w.z()}; }
};

/// The direction beyond, of light that leaves along w through a facet m; its cosine is given.
Vec3<double> refracted(const Vec3<double>& w, const Vec3<double>& m, double eta,
                       double cosine_beyond) {
  return (w.dot(m) / eta - cosine_beyond) * m - w / eta;
}

double cosine_beyond(double cosine, double eta) {
  return std::sqrt(std::max(1 - (1 - cosine * cosine) / (eta * eta), 0.0));
}

}  // namespace

double fresnel_either_way(double cosine, double eta) {
  const double c = std::clamp(cosine, 0.0, 1.0);
  const double g2 = eta * eta - 1 + c * c;  // of eta times the cosine beyond
  if (!(g2 > 0)) return eta == 1 ? 0 : 1;
  const double g = std::sqrt(g2);
  const double across = (c - g) / (c + g);
  const double along = (eta * eta * c - g) / (eta * eta * c + g);
  return (across * across + along * along) / 2;
}

DielectricBsdf::DielectricBsdf(double roughness, double index_of_refraction, const Paint& tint)
    : tint_(tint) {
  const double alpha = Microfacets::alpha_of(roughness);
  if (alpha < Microfacets::smallest_alpha) return;
  rough_ = Microfacets{alpha, alpha};
  kept_ = KeptEnergy::of_boundary(*rough_, index_of_refraction);
}

/// Parts of the result for one pair of directions.
struct DielectricBsdf::Parts {
  double value;    ///< eval
  double density;  ///< pdf
};

// Radiance gathers in the denser medium: what comes from beyond is divided by eta^2.
std::optional<DielectricBsdf::Parts> DielectricBsdf::parts(const Shading& at,
                                                           const Vec3<double>& w) const {
  if (!rough_) return std::nullopt;
  const Seen seen(at);
  const Vec3<double>& w_out = seen.w_out;
  const Vec3<double> w_in = seen.back(w);
  const bool mirrors = w_in.z() > 0;
  if (w_in.z() == 0 || seen.eta == 1) return std::nullopt;
  Vec3<double> m = mirrors ? Vec3<double>(w_out + w_in) : Vec3<double>(w_out + seen.eta * w_in);
  if (!(m.squaredNorm() > 0)) return std::nullopt;
  m.normalize();
  if (m.z() < 0) m = -m;
  const double c_out = m.dot(w_out), c_in = m.dot(w_in);
  if (!(c_out > 0) || (c_in > 0) != mirrors) return std::nullopt;
  const double F = fresnel_either_way(c_out, seen.eta);
  const double visible = rough_->visible_density(w_out, m);
  const double shown = rough_->shadowing(w_out, w_in) / (*kept_)(w_out, seen.eta);
  double density = 0, value = 0;
  if (mirrors) {
    density = F * visible / (4 * c_out);
    value = density * shown;
  } else {
    const double stretch = c_in + c_out / seen.eta;
    density = (1 - F) * visible * -c_in / (stretch * stretch);
    value = density * shown / (seen.eta * seen.eta);
  }
  return Parts{value, density};
}

Colour DielectricBsdf::eval(const Shading& at, const Vec3<double>& w_in) const {
  const auto p = parts(at, w_in);
  if (!p) return Colour::Zero();
  const bool mirrors = (at.w_out.z() > 0) == (w_in.z() > 0);
  return mirrors ? Colour(Colour::Constant(p->value)) : Colour(p->value * through(at));
}

double DielectricBsdf::pdf(const Shading& at, const Vec3<double>& w_in) const {
  const auto p = parts(at, w_in);
  return p ? p->density : 0;
}

std::optional<BsdfSample> DielectricBsdf::sample(const Shading& at,
                                                 const BsdfChoice& choice) const {
  const Seen seen(at);
  // Between equal media there is no boundary, however rough.
  if (seen.eta == 1) return BsdfSample{-at.w_out, through(at), 0, true};
  const Vec3<double> m =
      rough_ ? rough_->visible_normal(seen.w_out, choice.u) : Vec3<double>(Vec3<double>::UnitZ());
  const double c = m.dot(seen.w_out);
  const double F = fresnel_either_way(c, seen.eta);
  const bool mirrors = choice.which < F;
  const Vec3<double> w_in = mirrors
                                ? Vec3<double>(2 * c * m - seen.w_out)
                                : refracted(seen.w_out, m, seen.eta, cosine_beyond(c, seen.eta));
  if ((w_in.z() > 0) != mirrors || w_in.z() == 0) return std::nullopt;
  const Colour gathered =
      mirrors ? Colour(Colour::Ones()) : Colour(through(at) / (seen.eta * seen.eta));
  if (!rough_) return BsdfSample{seen.back(w_in), gathered, 0, true};
  const double shown = rough_->shadowing(seen.w_out, w_in) / (*kept_)(seen.w_out, seen.eta);
  const double density = pdf(at, seen.back(w_in));
  if (!(density > 0)) return std::nullopt;
  return BsdfSample{seen.back(w_in), gathered * shown, density, false};
}

}  // namespace minkray
