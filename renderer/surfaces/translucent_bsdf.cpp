// SPDX-License-Identifier: MIT
#include "renderer/surfaces/translucent_bsdf.h"

#include <cmath>
#include <numbers>

namespace minkray {

Colour TranslucentBsdf::eval(const Shading& at, const Vec3<double>& w_in) const {
  return pdf(at, w_in) * colour_of(material_.colour, at);
}

double TranslucentBsdf::pdf(const Shading& at, const Vec3<double>& w_in) const {
  return part(at, w_in) * std::abs(w_in.z()) / std::numbers::pi;
}

std::optional<BsdfSample> TranslucentBsdf::sample(const Shading& at,
                                                  const BsdfChoice& choice) const {
  const bool goes_through = choice.which < material_.transmission;
  Vec3<double> w_in = cosine_direction(choice.u);
  if (!(w_in.z() > 0)) return std::nullopt;
  if ((at.w_out.z() > 0) == goes_through) w_in.z() = -w_in.z();
  return BsdfSample{w_in, colour_of(material_.colour, at), pdf(at, w_in)};
}

}  // namespace minkray
