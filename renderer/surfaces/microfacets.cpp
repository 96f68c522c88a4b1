// SPDX-License-Identifier: MIT
#include "renderer/surfaces/microfacets.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace minkray {

double Microfacets::density(const Vec3<double>& m) const {
  const double x = m.x() / alpha_x, y = m.y() / alpha_y;
  const double t = x * x + y * y + m.z() * m.z();
  return 1 / (std::numbers::pi * alpha_x * alpha_y * t * t);
}

double Microfacets::lambda(const Vec3<double>& w) const {
  const double x = alpha_x * w.x(), y = alpha_y * w.y();
  return (std::sqrt(1 + (x * x + y * y) / (w.z() * w.z())) - 1) / 2;
}

double Microfacets::visible_density(const Vec3<double>& w_out, const Vec3<double>& m) const {
  const double seen = m.dot(w_out);
  if (!(seen > 0) || !(m.z() > 0)) return 0;
  return density(m) * seen / ((1 + lambda(w_out)) * w_out.z());
}

Vec3<double> Microfacets::visible_normal(const Vec3<double>& w_out,
                                         const std::array<double, 2>& u) const {
  const Vec3<double> stretched =
      Vec3<double>(alpha_x * w_out.x(), alpha_y * w_out.y(), w_out.z()).normalized();
  const double angle = 2 * std::numbers::pi * u[0];
  const double z = (1 - u[1]) * (1 + stretched.z()) - stretched.z();
  const double sine = std::sqrt(std::clamp(1 - z * z, 0.0, 1.0));
  const Vec3<double> half =
      Vec3<double>(sine * std::cos(angle), sine * std::sin(angle), z) + stretched;
  return Vec3<double>(alpha_x * half.x(), alpha_y * half.y(), half.z()).normalized();
}

double Microfacets::shadowing(const Vec3<double>& w_out, const Vec3<double>& w_in) const {
  const double out = lambda(w_out);
  return (1 + out) / (1 + out + lambda(w_in));
}

}  // namespace minkray
