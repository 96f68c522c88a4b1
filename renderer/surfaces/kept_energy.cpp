// SPDX-License-Identifier: MIT
#include "renderer/surfaces/kept_energy.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/rays/sampler.h"
#include "renderer/surfaces/dielectric_bsdf.h"

namespace minkray {
namespace {

/// Draws per number of the table: errors are below half a percent.
constexpr int draws = 512;

/// Indices of refraction further apart than these by their logarithm count as these: air and
/// diamond are 0.9 apart.
constexpr double most_log_eta = 1.0;

/// Share of light that leaves along w_out, for one facet.
double kept(const Microfacets& rough, const Vec3<double>& w_out, const Vec3<double>& m,
            bool mirrors, double eta) {
  const double c = m.dot(w_out);
  if (!(c > 0)) return 0;
  const Vec3<double> mirrored = 2 * c * m - w_out;
  const double from_mirror = mirrored.z() > 0 ? rough.shadowing(w_out, mirrored) : 0;
  if (mirrors) return from_mirror;
  const double F = fresnel_either_way(c, eta);
  if (!(F < 1)) return from_mirror;
  const double cosine_beyond = std::sqrt(std::max(1 - (1 - c * c) / (eta * eta), 0.0));
  const Vec3<double> beyond = (c / eta - cosine_beyond) * m - w_out / eta;
  const double from_beyond = beyond.z() < 0 ? rough.shadowing(w_out, beyond) : 0;
  return F * from_mirror + (1 - F) * from_beyond;
}

}  // namespace

// The shape of the distribution has two planes of symmetry.
KeptEnergy KeptEnergy::of_mirror(const Microfacets& rough) {
  const int rows = rough.alpha_x == rough.alpha_y ? 1 : 17;
  return {rough, true, rows, std::numbers::pi / 2 / 16};
}

KeptEnergy KeptEnergy::of_boundary(const Microfacets& rough, double eta) {
  const double log_eta = std::abs(std::log(eta));
  const double steps = std::max(std::round(log_eta * 12 / most_log_eta), 1.0);
  const double step = log_eta > 0.02 ? log_eta / steps : most_log_eta / 12;
  const int half = static_cast<int>(std::ceil(most_log_eta / step));
  return {rough, false, 2 * std::min(half, 64) + 1, step};
}

KeptEnergy::KeptEnergy(const Microfacets& rough, bool mirrors, int rows, double step)
    : mirrors_(mirrors), rows_(rows), step_(step) {
  table_.resize(static_cast<std::size_t>(rows) * cosines);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < cosines; ++column) {
      const double eta = mirrors ? 1 : std::exp(step * (row - rows / 2));
      const double angle = mirrors ? step * row : 0;
      const double root = std::max(static_cast<double>(column) / (cosines - 1), 1e-3);
      const double cosine = root * root, sine = std::sqrt(1 - cosine * cosine);
      const Vec3<double> w_out(sine * std::cos(angle), sine * std::sin(angle), cosine);
      double sum = 0;
      for (int i = 0; i < draws; ++i) {
        const auto u = Sampler(17, row, column, static_cast<std::uint32_t>(i)).next();
        sum += kept(rough, w_out, rough.visible_normal(w_out, u), mirrors, eta);
      }
      table_[static_cast<std::size_t>(row * cosines + column)] = sum / draws;
    }
}

double KeptEnergy::row_of(const Vec3<double>& w_out, double eta) const {
  if (!mirrors_) return std::log(eta) / step_ + rows_ / 2;
  return rows_ > 1 ? std::atan2(std::abs(w_out.y()), std::abs(w_out.x())) / step_ : 0;
}

double KeptEnergy::operator()(const Vec3<double>& w_out, double eta) const {
  const double x = std::sqrt(std::clamp(w_out.z(), 0.0, 1.0)) * (cosines - 1);
  const double y = std::clamp(row_of(w_out, eta), 0.0, rows_ - 1.0);
  const int x0 = std::min(static_cast<int>(x), cosines - 2);
  const int y0 = std::min(static_cast<int>(y), std::max(rows_ - 2, 0));
  const auto row = [&](int r) {
    const double* const at = &table_[static_cast<std::size_t>(r * cosines + x0)];
    return at[0] + (x - x0) * (at[1] - at[0]);
  };
  const double lower = row(y0);
  return rows_ > 1 ? lower + (y - y0) * (row(y0 + 1) - lower) : lower;
}

}  // namespace minkray
