// SPDX-License-Identifier: MIT
#include "renderer/surfaces/reflection.h"

#include <numbers>

namespace minkray {
namespace {

using std::numbers::pi;

/// Below this a rough coat's highlight is narrower than a pixel of any picture, and its density a
/// number too large to be summed: the coat counts as smooth. A standard deviation of slopes.
constexpr double smallest_alpha = 1e-3;

/// Beyond this a coat mirrors all but 4e-6 of the light, and squares of it would lose what is left.
constexpr double most_refraction = 1e6;

/// The index of refraction that is reckoned with.
double eta_of(const GlossyMaterial& glossy) {
  return std::min(glossy.index_of_refraction, most_refraction);
}

/// The bases of all kinds of materials.
struct BaseOf {
  DiffuseBase operator()(const LambertMaterial& matt) const {
    return DiffuseBase(matt.colour.colour());
  }
  DiffuseBase operator()(const GlossyMaterial& glossy) const {
    return {glossy.colour.colour(), eta_of(glossy)};
  }
  DiffuseBase operator()(const EmissiveMaterial&) const { return DiffuseBase(Colour::Zero()); }
  DiffuseBase operator()(const DielectricMaterial&) const {
    return DiffuseBase(Colour::Constant(0.9));
  }
  DiffuseBase operator()(const ConductorMaterial& metal) const {
    return DiffuseBase(metal.colour.value_or(Colour::Constant(0.6)).colour());
  }
  DiffuseBase operator()(const PrincipledMaterial& layers) const {
    return DiffuseBase(layers.colour.colour());
  }
  DiffuseBase operator()(const TranslucentMaterial& sheet) const {
    return DiffuseBase(sheet.colour.colour());
  }
  DiffuseBase operator()(const MixMaterial&) const { return DiffuseBase(Colour::Constant(0.5)); }
};

std::optional<Coat> coat_of(const Material& material) {
  const auto* glossy = std::get_if<GlossyMaterial>(&material.kind);
  if (!glossy) return std::nullopt;
  // The usual reading of roughness: alpha is its square.
  const double alpha = glossy->roughness * glossy->roughness;
  return Coat(eta_of(*glossy), alpha < smallest_alpha ? 0 : alpha);
}

}  // namespace

double fresnel(double cosine, double eta) {
  const double c = std::clamp(cosine, 0.0, 1.0);
  const double g = std::sqrt(std::max(eta * eta - 1 + c * c, 0.0));  // eta * cosine of refraction
  if (!(g + c > 0)) return 1;
  const double across = (c - g) / (c + g);
  const double along = (eta * eta * c - g) / (eta * eta * c + g);
  return (across * across + along * along) / 2;
}

double mean_fresnel(double eta) {
  // The middle rule over cosine^2, in which light from all around is uniform.
  constexpr int steps = 1024;
  double sum = 0;
  for (int i = 0; i < steps; ++i) sum += fresnel(std::sqrt((i + 0.5) / steps), eta);
  return sum / steps;
}

Vec3<double> cosine_direction(const std::array<double, 2>& u) {
  const double radius = std::sqrt(u[0]), angle = 2 * pi * u[1];
  return {radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1 - u[0])};
}

double RoughMirror::density(const Vec3<double>& m) const {
  const double a2 = alpha * alpha;
  const double t = (m.x() * m.x() + m.y() * m.y()) / a2 + m.z() * m.z();
  return 1 / (pi * a2 * t * t);
}

double RoughMirror::lambda(const Vec3<double>& w) const {
  const double slope2 = (w.x() * w.x() + w.y() * w.y()) / (w.z() * w.z());
  return (std::sqrt(1 + alpha * alpha * slope2) - 1) / 2;
}

Vec3<double> RoughMirror::visible_normal(const Vec3<double>& w_out,
                                         const std::array<double, 2>& u) const {
  const Vec3<double> stretched =
      Vec3<double>(alpha * w_out.x(), alpha * w_out.y(), w_out.z()).normalized();
  const double angle = 2 * pi * u[0];
  const double z = (1 - u[1]) * (1 + stretched.z()) - stretched.z();
  const double sine = std::sqrt(std::clamp(1 - z * z, 0.0, 1.0));
  const Vec3<double> half =
      Vec3<double>(sine * std::cos(angle), sine * std::sin(angle), z) + stretched;
  return Vec3<double>(alpha * half.x(), alpha * half.y(), half.z()).normalized();
}

DiffuseBase::DiffuseBase(const Colour& colour, double eta)
    : colour_(colour), is_coated_(true), eta_(eta), scale_(1 / (1 - mean_fresnel(eta))) {}

// Light that gets into the coat, is reflected evenly by the base, and gets out again; what does not
// get out is reflected again and again. With a white base nothing is lost: the integral over all
// w_in is 1 - fresnel(w_out).
Colour DiffuseBase::weight(const Vec3<double>& w_out, const Vec3<double>& w_in) const {
  if (!is_coated_) return colour_;
  const double through = (1 - fresnel(w_out.z(), eta_)) * (1 - fresnel(w_in.z(), eta_));
  // The fraction mirrored back from within, by reciprocity (Egan and Hilgeman 1979).
  const double kept = 1 - 1 / (scale_ * eta_ * eta_);
  const Colour bounced = (colour_.array() * (1 - kept) / (1 - colour_.array() * kept)).matrix();
  return bounced * through * scale_;
}

Colour DiffuseBase::eval(const Vec3<double>& w_out, const Vec3<double>& w_in) const {
  return weight(w_out, w_in) / pi;
}

SurfaceSample DiffuseBase::sample(const Vec3<double>& w_out, const std::array<double, 2>& u) const {
  const Vec3<double> w_in = cosine_direction(u);
  return {w_in, weight(w_out, w_in)};
}

double DiffuseBase::pdf(const Vec3<double>&, const Vec3<double>& w_in) const {
  return std::max(w_in.z(), 0.0) / pi;
}

Coat::Coat(double eta, double alpha) : eta_(eta), alpha_(alpha) {}

Colour Coat::eval(const Vec3<double>& w_out, const Vec3<double>& w_in) const {
  if (is_smooth()) return Colour::Zero();
  const RoughMirror rough{alpha_};
  const Vec3<double> m = (w_out + w_in).normalized();
  return Colour::Constant(
      fresnel(m.dot(w_out), eta_) * rough.density(m) /
      ((1 + rough.lambda(w_out) + rough.lambda(w_in)) * 4 * w_out.z() * w_in.z()));
}

SurfaceSample Coat::sample(const Vec3<double>& w_out, const std::array<double, 2>& u) const {
  if (is_smooth())
    return {{-w_out.x(), -w_out.y(), w_out.z()}, Colour::Constant(fresnel(w_out.z(), eta_))};
  const RoughMirror rough{alpha_};
  const Vec3<double> m = rough.visible_normal(w_out, u);
  const Vec3<double> w_in = 2 * m.dot(w_out) * m - w_out;
  if (!(w_in.z() > 0)) return {w_in, Colour::Zero()};
  const double out = rough.lambda(w_out), in = rough.lambda(w_in);
  return {w_in, Colour::Constant(fresnel(m.dot(w_out), eta_) * (1 + out) / (1 + out + in))};
}

// The density of the normals that are seen from w_out, (m . w_out) D(m) / ((1 + Lambda) w_out.z),
// by that of directions around them, 1 / (4 m . w_out).
double Coat::pdf(const Vec3<double>& w_out, const Vec3<double>& w_in) const {
  if (is_smooth()) return 0;
  const Vec3<double> m = (w_out + w_in).normalized();
  if (!(m.z() > 0)) return 0;
  const RoughMirror rough{alpha_};
  return rough.density(m) / ((1 + rough.lambda(w_out)) * 4 * w_out.z());
}

Surface::Surface(const Material& material)
    : base_(std::visit(BaseOf(), material.kind)), coat_(coat_of(material)) {}

Colour Surface::eval(const Vec3<double>& w_out, const Vec3<double>& w_in,
                     double least_alpha) const {
  const Colour of_base = base_.eval(w_out, w_in);
  return coat_ ? Colour(of_base + coat_->roughened(least_alpha).eval(w_out, w_in)) : of_base;
}

double Surface::chance_of_coat(const Vec3<double>& w_out) const {
  if (!coat_) return 0;
  const double mirrored = coat_->mirrored(w_out);
  const double of_base = (1 - mirrored) * base_.colour().maxCoeff();
  return mirrored / (mirrored + of_base);
}

}  // namespace minkray
