// SPDX-License-Identifier: MIT
#include "renderer/surfaces/lobes.h"

#include <algorithm>

namespace minkray {

Colour eval_of(std::span<const Lobe> lobes, const Shading& at, const Vec3<double>& w_in) {
  Colour sum = Colour::Zero();
  for (const Lobe& lobe : lobes)
    if (lobe.chance > 0) sum += lobe.weight.cwiseProduct(lobe.bsdf->eval(at, w_in));
  return sum;
}

double pdf_of(std::span<const Lobe> lobes, const Shading& at, const Vec3<double>& w_in) {
  double sum = 0;
  for (const Lobe& lobe : lobes)
    if (lobe.chance > 0) sum += lobe.chance * lobe.bsdf->pdf(at, w_in);
  return sum;
}

std::optional<BsdfSample> sample_of(std::span<const Lobe> lobes, const Shading& at,
                                    const BsdfChoice& choice) {
  double left = choice.which;
  const Lobe* chosen = nullptr;
  for (const Lobe& lobe : lobes) {
    if (!(lobe.chance > 0)) continue;
    chosen = &lobe;
    if (left < lobe.chance) break;
    left -= lobe.chance;
  }
  if (!chosen) return std::nullopt;
  // The remainder of the number chooses within the lobe.
  const double which = std::clamp(left / chosen->chance, 0.0, 1.0 - 0x1p-53);
  auto sample = chosen->bsdf->sample(at, {choice.u, which});
  if (!sample) return std::nullopt;
  if (sample->is_sharp) {
    sample->weight = sample->weight.cwiseProduct(chosen->weight) / chosen->chance;
    return sample;
  }
  sample->pdf = pdf_of(lobes, at, sample->w_in);
  if (!(sample->pdf > 0)) return std::nullopt;
  sample->weight = eval_of(lobes, at, sample->w_in) / sample->pdf;
  return sample;
}

}  // namespace minkray
