// SPDX-License-Identifier: MIT
// Rough boundaries as microfacets: the GGX distribution of Walter et al. (2007), anisotropic where
// brushed, with Smith's height-correlated shadowing (Heitz, "Understanding the Masking-Shadowing
// Function", 2014).
#pragma once

#include <array>

#include "core/math/vec.h"

namespace minkray {

/// Directions are in the surface's frame; w_out.z > 0.
struct Microfacets {
  double alpha_x, alpha_y;  ///< widths of the slopes' distribution, > 0

  /// Below this a highlight is narrower than a pixel of any picture, and its density too large a
  /// number to be summed: the boundary counts as smooth. A standard deviation of slopes.
  static constexpr double smallest_alpha = 1e-3;

  /// The usual reading of roughness: alpha is its square.
  static double alpha_of(double roughness) { return roughness * roughness; }

  /// Density of facets with normal m.
  double density(const Vec3<double>& m) const;
  /// Smith's Lambda; the fraction of facets seen from w is 1 / (1 + Lambda).
  double lambda(const Vec3<double>& w) const;
  /// The density over solid angle of the normals that `visible_normal` draws.
  double visible_density(const Vec3<double>& w_out, const Vec3<double>& m) const;
  /// A facet's normal as seen from w_out, by the spherical caps of Dupuy and Benyoub (2023).
  Vec3<double> visible_normal(const Vec3<double>& w_out, const std::array<double, 2>& u) const;
  /// The part of what is seen from w_out that is not hidden from w_in (whose z may be negative).
  double shadowing(const Vec3<double>& w_out, const Vec3<double>& w_in) const;
};

}  // namespace minkray
