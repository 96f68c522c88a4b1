// SPDX-License-Identifier: MIT
// Weighted sum of several BSDFs; sampling picks one at random.
#pragma once

#include <span>

#include "renderer/surfaces/bsdf.h"

namespace minkray {

/// One part of a sum.
struct Lobe {
  const Bsdf* bsdf;
  Colour weight;  ///< factor of its value
  double chance;  ///< to be drawn; all of them sum up to 1
};

Colour eval_of(std::span<const Lobe> lobes, const Shading& at, const Vec3<double>& w_in);
double pdf_of(std::span<const Lobe> lobes, const Shading& at, const Vec3<double>& w_in);
std::optional<BsdfSample> sample_of(std::span<const Lobe> lobes, const Shading& at,
                                    const BsdfChoice& choice);

}  // namespace minkray
