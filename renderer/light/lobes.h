// SPDX-License-Identifier: MIT
// Several surfaces in one: a weighted sum of them, of which one is drawn by chance.
#pragma once

#include <span>

#include "renderer/light/bsdf.h"

namespace minkray {

/// One part of a sum.
struct Lobe {
  const Bsdf* bsdf;
  Colour weight;  ///< what its value is multiplied by
  double chance;  ///< to be drawn; all of them sum up to 1
};

Colour eval_of(std::span<const Lobe> lobes, const Shading& at, const Vec3<double>& w_in);
double pdf_of(std::span<const Lobe> lobes, const Shading& at, const Vec3<double>& w_in);
std::optional<BsdfSample> sample_of(std::span<const Lobe> lobes, const Shading& at,
                                    const BsdfChoice& choice);

}  // namespace minkray
