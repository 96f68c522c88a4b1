// SPDX-License-Identifier: MIT
// How surfaces reflect: Fresnel's equations, the rough mirror, and the diffuse base under a
// dielectric coat. Directions point away from the surface, in a frame whose z is the normal.
#pragma once

#include <array>

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

/// A surface ready to be shaded.
class Surface {
 public:
  explicit Surface(const Material& material);

  const Colour& colour() const { return colour_; }
  bool has_coat() const { return has_coat_; }
  double eta() const { return eta_; }

  /// Reflected radiance per irradiance of light from w_in (z > 0) by the base.
  Colour base(const Vec3<double>& w_out, const Vec3<double>& w_in) const;
  /// The same by the rough coat, taken to be at least as rough as least_alpha. A smooth coat has no
  /// highlight from point-like lights.
  double highlight(const Vec3<double>& w_out, const Vec3<double>& w_in, double least_alpha) const;

  /// The factor that remains when w_in is drawn with density cosine / pi for the base.
  Colour base_weight(const Vec3<double>& w_out, const Vec3<double>& w_in) const;

  /// Light mirrored by the coat: where it comes from, and its weight; weight 0: nowhere.
  struct Mirrored {
    Vec3<double> w_in;
    double weight;
  };
  Mirrored mirror(const Vec3<double>& w_out, const std::array<double, 2>& u) const;

 private:
  Colour colour_;
  bool has_coat_ = false;
  double eta_ = 1;
  double alpha_ = 0;       ///< 0: a smooth coat
  double base_scale_ = 1;  ///< 1 / the mean of what gets through the coat
};

}  // namespace minkray
