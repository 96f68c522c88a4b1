// SPDX-License-Identifier: MIT
#include "renderer/surfaces/principled_bsdf.h"

#include <algorithm>
#include <numbers>

#include "renderer/rays/sampler.h"

namespace minkray {
namespace {

using std::numbers::pi;

/// The clear coat's index of refraction, as glTF has it.
constexpr double coat_eta = 1.5;

/// Reflection of a dielectric coat (renderer/surfaces/reflection.h).
class SheetBsdf final : public Bsdf {
 public:
  SheetBsdf(double eta, double roughness) : coat_(eta, alpha(roughness)) {}

  Colour eval(const Shading& at, const Vec3<double>& w_in) const override {
    if (!(at.w_out.z() > 0) || !(w_in.z() > 0)) return Colour::Zero();
    return w_in.z() * coat_.eval(at.w_out, w_in);
  }
  double pdf(const Shading& at, const Vec3<double>& w_in) const override {
    return at.w_out.z() > 0 && w_in.z() > 0 ? coat_.pdf(at.w_out, w_in) : 0;
  }
  std::optional<BsdfSample> sample(const Shading& at, const BsdfChoice& choice) const override {
    if (!(at.w_out.z() > 0)) return std::nullopt;
    const SurfaceSample drawn = coat_.sample(at.w_out, choice.u);
    if (!(drawn.w_in.z() > 0)) return std::nullopt;
    return BsdfSample{drawn.w_in, drawn.weight, pdf(at, drawn.w_in), coat_.is_smooth()};
  }
  bool is_sharp() const override { return coat_.is_smooth(); }

 private:
  static double alpha(double roughness) {
    const double of_roughness = Microfacets::alpha_of(roughness);
    return of_roughness < Microfacets::smallest_alpha ? 0 : of_roughness;
  }
  Coat coat_;
};

/// A lobe over the whole hemisphere, drawn by the cosine: of white, matt or as cloth gleams where
/// light grazes the threads (Burley 2012).
class HemisphereBsdf final : public Bsdf {
 public:
  explicit HemisphereBsdf(bool gleams) : gleams_(gleams) {}

  Colour eval(const Shading& at, const Vec3<double>& w_in) const override {
    if (!(at.w_out.z() > 0) || !(w_in.z() > 0)) return Colour::Zero();
    double value = 1 / pi;
    if (gleams_) {
      const double c = 1 - std::clamp((at.w_out + w_in).normalized().dot(w_in), 0.0, 1.0);
      value = c * c * c * c * c;
    }
    return Colour::Constant(w_in.z() * value);
  }
  double pdf(const Shading& at, const Vec3<double>& w_in) const override {
    return at.w_out.z() > 0 ? std::max(w_in.z(), 0.0) / pi : 0;
  }
  std::optional<BsdfSample> sample(const Shading& at, const BsdfChoice& choice) const override {
    const Vec3<double> w_in = cosine_direction(choice.u);
    const double density = pdf(at, w_in);
    if (!(density > 0)) return std::nullopt;
    return BsdfSample{w_in, eval(at, w_in) / density, density, false};
  }

 private:
  bool gleams_;
};

}  // namespace

Albedo::Albedo(const Bsdf& bsdf) {
  constexpr int draws = 512;
  for (int i = 0; i < cosines; ++i) {
    const double root = std::max(static_cast<double>(i) / (cosines - 1), 1e-3);
    const double cosine = root * root;
    const Shading at{{std::sqrt(1 - cosine * cosine), 0, cosine}};
    double sum = 0;
    for (int k = 0; k < draws; ++k) {
      Sampler sampler(19, i, 0, static_cast<std::uint32_t>(k));
      const auto u = sampler.next();
      const auto sample = bsdf.sample(at, {u, sampler.next()[0]});
      if (sample) sum += sample->weight.mean();
    }
    table_[static_cast<std::size_t>(i)] = std::min(sum / draws, 1.0);
  }
}

double Albedo::operator()(double cosine) const {
  const double x = std::sqrt(std::clamp(cosine, 0.0, 1.0)) * (cosines - 1);
  const auto i = static_cast<std::size_t>(std::min(static_cast<int>(x), cosines - 2));
  return table_[i] + (x - static_cast<double>(i)) * (table_[i + 1] - table_[i]);
}

PrincipledBsdf::PrincipledBsdf(const PrincipledMaterial& material)
    : material_(material),
      coat_(std::make_unique<SheetBsdf>(coat_eta, material.coat_roughness)),
      sheen_(std::make_unique<HemisphereBsdf>(true)),
      sheet_(std::make_unique<SheetBsdf>(material.index_of_refraction, material.roughness)),
      matt_(std::make_unique<HemisphereBsdf>(false)),
      metal_(material.colour, material.roughness, material.anisotropy),
      glass_(material.roughness, material.index_of_refraction, material.colour),
      of_coat_(*coat_),
      of_sheen_(*sheen_),
      of_sheet_(*sheet_) {}

PrincipledBsdf::Lobes PrincipledBsdf::lobes(const Shading& at) const {
  const auto grey = [](double value) -> Colour { return Colour::Constant(value); };
  Lobes lobes = {{{coat_.get(), grey(0), 0},
                  {sheen_.get(), grey(0), 0},
                  {&metal_, grey(0), 0},
                  {&glass_, grey(0), 0},
                  {sheet_.get(), grey(0), 0},
                  {matt_.get(), grey(0), 0}}};
  // From within there is glass alone.
  if (at.w_out.z() < 0) {
    lobes[3] = {&glass_, grey(1), 1};
    return lobes;
  }
  const double cosine = at.w_out.z();
  double left = 1;
  const auto add = [&](std::size_t lobe, const Colour& weight, double albedo) {
    lobes[lobe].weight = weight;
    lobes[lobe].chance = weight.maxCoeff() * albedo;
  };
  add(0, grey(material_.coat), of_coat_(cosine));
  left -= material_.coat * of_coat_(cosine);
  const double gleam = material_.sheen * of_sheen_(cosine);
  add(1, grey(left * material_.sheen), of_sheen_(cosine));
  left *= 1 - gleam;
  // Metal takes its colour by itself.
  add(2, grey(left * material_.metallic), 1);
  left *= 1 - material_.metallic;
  add(3, grey(left * material_.transmission), 1);
  left *= 1 - material_.transmission;
  const double mirrored = of_sheet_(cosine) * material_.specular;
  add(4, grey(left * material_.specular), of_sheet_(cosine));
  add(5, left * (1 - mirrored) * colour_of(material_.colour, at), 1);
  double sum = 0;
  for (const Lobe& lobe : lobes) sum += lobe.chance;
  for (Lobe& lobe : lobes) lobe.chance = sum > 0 ? lobe.chance / sum : 0;
  return lobes;
}

Colour PrincipledBsdf::eval(const Shading& at, const Vec3<double>& w_in) const {
  return eval_of(lobes(at), at, w_in);
}

double PrincipledBsdf::pdf(const Shading& at, const Vec3<double>& w_in) const {
  return pdf_of(lobes(at), at, w_in);
}

std::optional<BsdfSample> PrincipledBsdf::sample(const Shading& at,
                                                 const BsdfChoice& choice) const {
  return sample_of(lobes(at), at, choice);
}

}  // namespace minkray
