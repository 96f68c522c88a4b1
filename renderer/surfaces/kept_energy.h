// SPDX-License-Identifier: MIT
// Fraction of light that rough boundaries scatter without a second facet. Dividing by it restores
// the energy of multiple scattering.
#pragma once

#include <vector>

#include "renderer/surfaces/microfacets.h"

namespace minkray {

/// A table over the cosine and, of mirrors, the angle around the normal, or of boundaries that also
/// let through the relative index of refraction.
class KeptEnergy {
 public:
  static KeptEnergy of_mirror(const Microfacets& rough);
  /// The boundary is the same for all angles; this is exact for this index of refraction and its
  /// inverse.
  static KeptEnergy of_boundary(const Microfacets& rough, double eta);

  /// The part for light that leaves along w_out, z > 0.
  double operator()(const Vec3<double>& w_out, double eta = 1) const;

 private:
  static constexpr int cosines = 32;

  KeptEnergy(const Microfacets& rough, bool mirrors, int rows, double step);
  double row_of(const Vec3<double>& w_out, double eta) const;

  bool mirrors_;
  int rows_;
  double step_;                ///< between rows: of the angle, or of the index's logarithm
  std::vector<double> table_;  ///< by row, then by the cosine's square root, evenly
};

}  // namespace minkray
