// SPDX-License-Identifier: MIT
#include "renderer/surfaces/coated_bsdf.h"

namespace minkray {

Colour CoatedBsdf::eval(const Shading& at, const Vec3<double>& w_in) const {
  if (!(at.w_out.z() > 0) || !(w_in.z() > 0)) return Colour::Zero();
  return w_in.z() * surface(at).eval(at.w_out, w_in);
}

double CoatedBsdf::pdf(const Shading& at, const Vec3<double>& w_in) const {
  if (!(at.w_out.z() > 0) || !(w_in.z() > 0)) return 0;
  const Surface surface = this->surface(at);
  const double coat = surface.chance_of_coat(at.w_out);
  const double of_base = (1 - coat) * surface.base().pdf(at.w_out, w_in);
  return coat > 0 ? of_base + coat * surface.coat()->pdf(at.w_out, w_in) : of_base;
}

std::optional<BsdfSample> CoatedBsdf::sample(const Shading& at, const BsdfChoice& choice) const {
  if (!(at.w_out.z() > 0)) return std::nullopt;
  const Surface surface = this->surface(at);
  const double coat = surface.chance_of_coat(at.w_out);
  const bool mirrors = choice.which < coat;
  const SurfaceSample drawn = mirrors ? surface.coat()->sample(at.w_out, choice.u)
                                      : surface.base().sample(at.w_out, choice.u);
  if (!(drawn.w_in.z() > 0)) return std::nullopt;
  // A smooth coat is drawn with its chance alone; all else shares one density.
  if (mirrors && surface.coat()->is_smooth())
    return BsdfSample{drawn.w_in, drawn.weight / coat, 0, true};
  const double density = pdf(at, drawn.w_in);
  if (!(density > 0)) return std::nullopt;
  return BsdfSample{drawn.w_in, eval(at, drawn.w_in) / density, density, false};
}

}  // namespace minkray
