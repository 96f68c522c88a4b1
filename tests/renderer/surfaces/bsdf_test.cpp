// SPDX-License-Identifier: MIT
// Surfaces of the path tracer neither gain nor lose light, and draw with the density they claim.
#include "renderer/surfaces/bsdf.h"

#include <gtest/gtest.h>

#include "renderer/surfaces/conductor_bsdf.h"
#include "renderer/surfaces/dielectric_bsdf.h"
#include "tests/support/density.h"
#include "tests/support/must_hold.h"

namespace minkray {
namespace {

Vec3<double> from(double cosine) {
  const double sine = std::sqrt(1 - cosine * cosine);
  return {sine * std::cos(0.3), sine * std::sin(0.3), cosine};
}

struct Case {
  const char* name;
  MaterialKind material;
  double eta = 1;  ///< of the inside
};

ConductorMaterial white_metal(double roughness, double anisotropy = 0) {
  return {{}, Colour::Ones(), roughness, anisotropy};
}

/// Surfaces that absorb nothing.
std::vector<Case> white_surfaces() {
  return {{"matt", LambertMaterial{Colour::Ones()}},
          {"glossy", GlossyMaterial{Colour::Ones(), 0.0, 1.5}},
          {"clear glass", DielectricMaterial{1.5}, 1.5},
          {"frosted glass", DielectricMaterial{1.5, 0.5}, 1.5},
          {"rough diamond", DielectricMaterial{2.4, 1.0}, 2.4},
          {"nothing, but rough", DielectricMaterial{1.0, 0.6}, 1.0},
          {"mirror", white_metal(0)},
          {"metal", white_metal(0.5)},
          {"rough metal", white_metal(1)},
          {"brushed metal", white_metal(0.6, 0.8)},
          {"principled", PrincipledMaterial{Colour::Ones()}},
          {"paper", TranslucentMaterial{Colour::Ones(), 0.3}},
          {"principled glass",
           PrincipledMaterial{.colour = Colour::Ones(), .roughness = 0.4, .transmission = 1}, 1.5},
          {"lacquered cloth and metal", PrincipledMaterial{.colour = Colour::Ones(),
                                                           .metallic = 0.4,
                                                           .roughness = 0.3,
                                                           .coat = 0.7,
                                                           .coat_roughness = 0.2,
                                                           .sheen = 0.5}}};
}

/// Mean weight of samples is 1, where radiance from a denser medium counts by its eta^2.
double furnace(const Bsdf& bsdf, const Shading& at) {
  constexpr int draws = 1 << 14;
  double sum = 0;
  for (int i = 0; i < draws; ++i) {
    Sampler sampler(3, 0, 0, static_cast<std::uint32_t>(i));
    const auto u = sampler.next();
    const auto sample = bsdf.sample(at, {u, sampler.next()[0]});
    if (!sample) continue;
    const bool goes_through = (sample->w_in.z() > 0) != (at.w_out.z() > 0);
    const double eta = at.w_out.z() > 0 ? at.eta_below / at.eta_above : at.eta_above / at.eta_below;
    sum += sample->weight.mean() * (goes_through ? eta * eta : 1);
  }
  return sum / draws;
}

TEST(Bsdf, white_surfaces_vanish_in_a_furnace_to_one_percent) {
  double worst = 0;
  const auto check = [&](const Bsdf& bsdf, const Shading& at) {
    const double kept = furnace(bsdf, at);
    EXPECT_NEAR(kept, 1, 0.01);
    worst = std::max(worst, std::abs(kept - 1));
  };
  for (const Case& c : white_surfaces()) {
    const auto bsdf = make_bsdf({"", c.material});
    for (const double cosine : {0.1, 0.3, 0.6, 0.95}) {
      SCOPED_TRACE(std::string(c.name) + " from " + std::to_string(cosine));
      check(*bsdf, {from(cosine), 1, c.eta});
      if (!bsdf->lets_through()) continue;
      const Vec3<double> w = from(cosine);
      check(*bsdf, {{w.x(), w.y(), -w.z()}, 1, c.eta});
    }
  }
  tell_figure("light_lost_by_white_surfaces", worst, "<= 0.01");
}

TEST(Bsdf, directions_have_the_density_they_claim) {
  const std::vector<Case> rough = {{"frosted glass", DielectricMaterial{1.5, 0.7}, 1.5},
                                   {"rough diamond", DielectricMaterial{2.4, 1.0}, 2.4},
                                   {"metal", white_metal(0.6)},
                                   {"paper", TranslucentMaterial{Colour::Ones(), 0.3}},
                                   {"brushed metal", white_metal(0.8, 0.7)},
                                   {"principled",
                                    PrincipledMaterial{.colour = Colour::Constant(0.6),
                                                       .metallic = 0.3,
                                                       .roughness = 0.6,
                                                       .transmission = 0.4,
                                                       .coat = 0.5,
                                                       .coat_roughness = 0.7,
                                                       .sheen = 0.5},
                                    1.5}};
  for (const Case& c : rough) {
    const auto bsdf = make_bsdf({"", c.material});
    for (const double cosine : {0.4, 0.9, -0.5}) {
      if (cosine < 0 && !bsdf->lets_through()) continue;
      SCOPED_TRACE(std::string(c.name) + " from " + std::to_string(cosine));
      Vec3<double> w = from(std::abs(cosine));
      if (cosine < 0) w.z() = -w.z();
      const Shading at{w, 1, c.eta};
      const DensityCheck check = check_density(
          [&](Sampler& sampler) -> std::optional<Vec3<double>> {
            const auto u = sampler.next();
            const auto sample = bsdf->sample(at, {u, sampler.next()[0]});
            return sample ? std::optional(sample->w_in) : std::nullopt;
          },
          [&](const Vec3<double>& w_in) { return bsdf->pdf(at, w_in); });
      // Light that facets reflect into the surface is not drawn, and has no density.
      EXPECT_NEAR(check.total, check.drawn, 3e-3);
      EXPECT_GT(check.drawn, 0.6);
      EXPECT_LT(check.largest_excess, 6);
      EXPECT_GT(check.cells, 50);
    }
  }
}

TEST(Bsdf, a_sample_weighs_its_value_over_its_density) {
  int counted = 0;
  for (const Case& c : white_surfaces()) {
    const auto bsdf = make_bsdf({"", c.material});
    for (const double cosine : {0.2, 0.8})
      for (std::uint32_t i = 0; i < 500; ++i) {
        const Shading at{from(cosine), 1, c.eta};
        Sampler sampler(5, 0, 0, i);
        const auto u = sampler.next();
        const auto sample = bsdf->sample(at, {u, sampler.next()[0]});
        if (!sample || sample->is_sharp) continue;
        EXPECT_NEAR(sample->w_in.norm(), 1, 1e-9);
        EXPECT_NEAR(bsdf->pdf(at, sample->w_in) / sample->pdf, 1, 1e-9) << c.name;
        const Colour value = bsdf->eval(at, sample->w_in);
        EXPECT_NEAR((value / sample->pdf - sample->weight).norm(), 0, 1e-6) << c.name;
        ++counted;
      }
  }
  EXPECT_GT(counted, 4000);
}

TEST(Bsdf, clear_glass_bends_light_by_snell_and_mirrors_all_of_it_beyond_the_critical_angle) {
  const auto glass = make_bsdf({"", DielectricMaterial{1.5}});
  const Vec3<double> w = from(0.6);
  const auto refracted = glass->sample({w, 1, 1.5}, {{0.5, 0.5}, 0.999});
  ASSERT_TRUE(refracted);
  EXPECT_LT(refracted->w_in.z(), 0);
  EXPECT_NEAR(std::sqrt(1 - std::pow(refracted->w_in.z(), 2)) * 1.5, 0.8, 1e-12);
  // From within, at a sine above 1 / 1.5.
  const auto mirrored = glass->sample({{0.8, 0, -0.6}, 1, 1.5}, {{0.5, 0.5}, 0.999});
  ASSERT_TRUE(mirrored);
  EXPECT_NEAR((mirrored->w_in - Vec3<double>(-0.8, 0, -0.6)).norm(), 0, 1e-12);
  EXPECT_EQ(fresnel_either_way(0.6, 1 / 1.5), 1);
  EXPECT_NEAR(fresnel_either_way(0.6, 1.5), fresnel(0.6, 1.5), 1e-15);
}

// Gold: the reflectance of published tables is about 1.0, 0.78, 0.34 straight ahead (Gulbrandsen,
// "Artist Friendly Metallic Fresnel", 2014, lists 1.00 0.71 0.29 of sRGB).
TEST(Bsdf, metals_have_their_colours) {
  const auto colour = [](std::string_view name) {
    for (const Metal& metal : metals)
      if (metal.name == name) return MetalFresnel(metal).straight_ahead();
    return Colour(Colour::Zero());
  };
  const Colour gold = colour("gold"), silver = colour("silver"), copper = colour("copper");
  EXPECT_GT(gold.x(), 0.9);
  EXPECT_LT(gold.z(), 0.5);
  EXPECT_GT(gold.y(), gold.z());
  EXPECT_GT(silver.minCoeff(), 0.85);
  EXPECT_GT(copper.x(), copper.y());
  for (const Metal& metal : metals)
    EXPECT_NEAR(MetalFresnel(metal)(0).minCoeff(), 1, 1e-9) << metal.name;
}

}  // namespace
}  // namespace minkray
