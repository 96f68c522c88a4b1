// SPDX-License-Identifier: MIT
// Reflection at surfaces: Fresnel's equations, the rough mirror, and the diffuse base under a
// dielectric coat. For each part, eval is its value, sample draws a direction that light comes
// from, pdf is the density of the draws over solid angle. Directions point away from the surface,
// in a frame whose z is the normal.
#pragma once

#include <array>
#include <optional>

#include "renderer/scene/scene.h"

namespace minkray {

/// The fraction of unpolarised light that a dielectric mirrors, by the cosine of incidence from
/// outside (Fresnel). `eta` is the index of refraction relative to the outside, >= 1.
double fresnel(double cosine, double eta);

/// The mean of `fresnel` over light that comes evenly from all of the hemisphere.
double mean_fresnel(double eta);

/// A direction of the hemisphere with density cosine / pi.
Vec3<double> cosine_direction(const std::array<double, 2>& u);

/// An isotropic rough mirror: the microfacets of Walter et al. (2007, "GGX") with Smith's
/// height-correlated shadowing.
struct RoughMirror {
  double alpha;  ///< width of the slopes' distribution, > 0

  /// Density of microfacet normals m.
  double density(const Vec3<double>& m) const;
  /// Smith's Lambda; the fraction of facets seen from w is 1 / (1 + Lambda).
  double lambda(const Vec3<double>& w) const;
  /// A microfacet normal as seen from w_out (w_out.z > 0), by the spherical caps of Dupuy and
  /// Benyoub (2023).
  Vec3<double> visible_normal(const Vec3<double>& w_out, const std::array<double, 2>& u) const;
};

/// A direction that light comes from, drawn at random.
struct SurfaceSample {
  Vec3<double> w_in;
  Colour weight;  ///< eval * cosine / pdf; zero where w_in does not count
};

/// Reflects evenly, by Lambert's law; under a coat what gets through it, there and back.
class DiffuseBase {
 public:
  explicit DiffuseBase(const Colour& colour) : colour_(colour) {}
  /// The base lies under a dielectric coat.
  DiffuseBase(const Colour& colour, double eta);

  const Colour& colour() const { return colour_; }
  DiffuseBase recoloured(const Colour& colour) const {
    DiffuseBase other = *this;
    other.colour_ = colour;
    return other;
  }

  /// Reflected radiance per irradiance of light from w_in (z > 0).
  Colour eval(const Vec3<double>& w_out, const Vec3<double>& w_in) const;
  SurfaceSample sample(const Vec3<double>& w_out, const std::array<double, 2>& u) const;
  /// The density of what `sample` draws, over all of the sphere.
  double pdf(const Vec3<double>& w_out, const Vec3<double>& w_in) const;

 private:
  Colour weight(const Vec3<double>& w_out, const Vec3<double>& w_in) const;

  Colour colour_;
  bool is_coated_ = false;
  double eta_ = 1;
  double scale_ = 1;  ///< 1 / the mean of what gets through the coat
};

/// Reflection of a dielectric coat: in one direction if smooth, around it if rough.
class Coat {
 public:
  Coat(double eta, double alpha);

  /// The fraction of light from w_out that a smooth coat mirrors.
  double mirrored(const Vec3<double>& w_out) const { return fresnel(w_out.z(), eta_); }
  /// This is the coat, but at least as rough as alpha.
  Coat roughened(double alpha) const { return {eta_, std::max(alpha_, alpha)}; }

  /// These mean what they do of DiffuseBase. A smooth coat is drawn surely in its only direction:
  /// elsewhere nothing is mirrored, and there is no density. Some of what is drawn of a rough one
  /// points into the surface and weighs nothing.
  Colour eval(const Vec3<double>& w_out, const Vec3<double>& w_in) const;
  SurfaceSample sample(const Vec3<double>& w_out, const std::array<double, 2>& u) const;
  double pdf(const Vec3<double>& w_out, const Vec3<double>& w_in) const;

  bool is_smooth() const { return alpha_ == 0; }

 private:
  double eta_;
  double alpha_;  ///< 0: smooth
};

/// A surface ready to be shaded: a base, and a coat over it if there is one. Materials of other
/// kinds are taken for matt ones of about their colour.
class Surface {
 public:
  explicit Surface(const Material& material);

  const DiffuseBase& base() const { return base_; }
  const std::optional<Coat>& coat() const { return coat_; }

  /// Reflected radiance per irradiance of light from w_in by both, the coat taken to be at least as
  /// rough as least_alpha.
  Colour eval(const Vec3<double>& w_out, const Vec3<double>& w_in, double least_alpha = 0) const;
  /// Same surface with another base colour.
  Surface recoloured(const Colour& colour) const {
    Surface other = *this;
    other.base_ = base_.recoloured(colour);
    return other;
  }
  /// Probability of continuing with the coat where one of the two is drawn: its part of the sum
  /// that both reflect.
  double chance_of_coat(const Vec3<double>& w_out) const;

 private:
  DiffuseBase base_;
  std::optional<Coat> coat_;
};

}  // namespace minkray
