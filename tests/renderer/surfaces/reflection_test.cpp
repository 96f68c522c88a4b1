// SPDX-License-Identifier: MIT
#include "renderer/surfaces/reflection.h"

#include <gtest/gtest.h>

#include <numbers>

#include "renderer/rays/sampler.h"
#include "tests/support/density.h"

namespace minkray {
namespace {

constexpr double pi = std::numbers::pi;

Vec3<double> from_above(double cosine, double angle = 0.3) {
  const double sine = std::sqrt(1 - cosine * cosine);
  return {sine * std::cos(angle), sine * std::sin(angle), cosine};
}

/// The mean of f(u) over the unit square.
template <class F>
auto mean(const F& f, int count = 1 << 14) {
  auto sum = f(Sampler(1, 0, 0, 0).next());
  for (int i = 1; i < count; ++i) sum += f(Sampler(1, 0, 0, static_cast<std::uint32_t>(i)).next());
  return decltype(sum)(sum / count);
}

TEST(Reflection, fresnel_where_it_is_known) {
  EXPECT_NEAR(fresnel(1, 1.5), 0.04, 1e-15);
  EXPECT_NEAR(fresnel(0, 1.5), 1, 1e-15);
  EXPECT_NEAR(fresnel(0.5, 1), 0, 1e-15);
  // Brewster's angle, tan = eta: the component along the plane of incidence vanishes.
  const double cosine = 1 / std::sqrt(1 + 1.5 * 1.5), across = (1 - 2.25) / (1 + 2.25);
  EXPECT_NEAR(fresnel(cosine, 1.5), across * across / 2, 1e-15);
  // Egan and Hilgeman's table (1979) has 0.0918 for an index of 1.5.
  EXPECT_NEAR(mean_fresnel(1.5), 0.0918, 1e-4);
}

TEST(Reflection, cosine_directions_have_the_density_they_claim) {
  EXPECT_NEAR(mean([](const auto& u) { return cosine_direction(u).norm(); }), 1, 1e-12);
  // E[z] = 2/3 and E[x^2] = 1/4 for density z / pi.
  EXPECT_NEAR(mean([](const auto& u) { return cosine_direction(u).z(); }), 2.0 / 3, 1e-4);
  EXPECT_NEAR(mean([](const auto& u) { return std::pow(cosine_direction(u).x(), 2); }), 0.25, 1e-4);
}

// With a white base nothing is absorbed: what the coat does not mirror comes back from the base,
// seen from any side.
TEST(Reflection, a_white_coated_surface_gives_back_all_light) {
  for (const double eta : {1.0, 1.33, 1.5, 2.4}) {
    const minkray::Surface surface({"", GlossyMaterial{Colour::Ones(), 0.0, eta}});
    for (const double cosine : {0.05, 0.3, 0.7, 1.0}) {
      const Vec3<double> w_out = from_above(cosine);
      const Colour base =
          mean([&](const auto& u) { return surface.base().sample(w_out, u).weight; });
      const Colour mirrored = surface.coat()->sample(w_out, {0.5, 0.5}).weight;
      EXPECT_NEAR(base.x() + mirrored.x(), 1, 2e-3) << eta << " " << cosine;
    }
  }
}

/// An index of 1e20 made pixels that were no numbers.
TEST(Reflection, any_index_of_refraction_gives_numbers) {
  for (const double eta : {1.0, 1e3, 1e8, 1e16, 1e20, 1e200, 1e308}) {
    const minkray::Surface surface({"", GlossyMaterial{Colour::Constant(0.7), 0.1, eta}});
    const Vec3<double> w_out = from_above(0.4), w_in = from_above(0.8);
    EXPECT_TRUE(surface.base().eval(w_out, w_in).allFinite()) << eta;
    EXPECT_GE(surface.coat()->sample(w_out, {0.5, 0.5}).weight.minCoeff(), 0) << eta;
    EXPECT_LE(surface.coat()->sample(w_out, {0.5, 0.5}).weight.maxCoeff(), 1) << eta;
  }
}

TEST(Reflection, light_may_go_either_way) {
  const minkray::Surface surface({"", GlossyMaterial{{0.8, 0.5, 0.1}, 0.4, 1.5}});
  const Vec3<double> a = from_above(0.3, 1.0), b = from_above(0.8, 4.0);
  EXPECT_NEAR((surface.base().eval(a, b) - surface.base().eval(b, a)).norm(), 0, 1e-15);
  EXPECT_NEAR((surface.coat()->eval(a, b) - surface.coat()->eval(b, a)).norm(), 0, 1e-12);
  EXPECT_EQ(surface.eval(a, b), surface.base().eval(a, b) + surface.coat()->eval(a, b));
}

// The directions drawn and the closed form of the highlight are two ways to the same integral: the
// light mirrored out of an evenly lit hemisphere.
TEST(Reflection, drawn_mirror_directions_agree_with_the_highlight) {
  for (const double roughness : {0.5, 0.7, 1.0}) {
    const minkray::Surface surface({"", GlossyMaterial{Colour::Zero(), roughness, 1.5}});
    for (const double cosine : {0.3, 0.9}) {
      const Vec3<double> w_out = from_above(cosine);
      const double drawn =
          mean([&](const auto& u) { return surface.coat()->sample(w_out, u).weight.x(); });
      const double summed = mean(
          [&](const auto& u) {
            const Vec3<double> w_in = cosine_direction(u);
            return pi * surface.coat()->eval(w_out, w_in).x();
          },
          1 << 18);
      EXPECT_NEAR(drawn / summed, 1, 0.01) << roughness << " " << cosine;
      EXPECT_GT(drawn, 0.01);
    }
  }
}

/// Every part of a surface that has a density: bases with and without a coat, coats of every
/// roughness that cells of the sphere can distinguish from a mirror.
template <class Visit>
void for_each_part(const Visit& visit) {
  visit("matt", minkray::Surface({"", LambertMaterial{{0.8, 0.5, 0.1}}}).base());
  visit("coated", minkray::Surface({"", GlossyMaterial{{0.8, 0.5, 0.1}, 0.5, 1.5}}).base());
  for (const double roughness : {0.5, 0.7, 1.0})
    visit("coat", *minkray::Surface({"", GlossyMaterial{Colour::Zero(), roughness, 1.5}}).coat());
}

TEST(Reflection, directions_have_the_density_they_claim) {
  for (const double cosine : {0.1, 0.4, 0.9})
    for_each_part([&](const char* name, const auto& part) {
      SCOPED_TRACE(std::string(name) + " from " + std::to_string(cosine));
      const Vec3<double> w_out = from_above(cosine);
      expect_density(check_density(
          [&](Sampler& sampler) -> std::optional<Vec3<double>> {
            return part.sample(w_out, sampler.next()).w_in;
          },
          [&](const Vec3<double>& w_in) { return part.pdf(w_out, w_in); }));
    });
}

TEST(Reflection, a_sample_weighs_the_value_times_the_cosine_over_the_density) {
  int counted = 0, into_surface = 0;
  for (const double cosine : {0.1, 0.4, 0.9})
    for_each_part([&](const char* name, const auto& part) {
      const Vec3<double> w_out = from_above(cosine);
      for (std::uint32_t i = 0; i < 1000; ++i) {
        const SurfaceSample sample = part.sample(w_out, Sampler(4, 0, 0, i).next());
        EXPECT_NEAR(sample.w_in.norm(), 1, 1e-12);
        if (!(sample.w_in.z() > 0)) {
          EXPECT_EQ(sample.weight, Colour::Zero());
          ++into_surface;
          continue;
        }
        const Colour expected =
            part.eval(w_out, sample.w_in) * sample.w_in.z() / part.pdf(w_out, sample.w_in);
        EXPECT_NEAR((sample.weight - expected).norm(), 0, 1e-9 * (1e-3 + expected.norm()))
            << name << " from " << cosine;
        ++counted;
      }
    });
  EXPECT_GT(counted, 10000);
  EXPECT_GT(into_surface, 100);
}

TEST(Reflection, a_smooth_coat_mirrors_in_one_direction_only) {
  const Coat coat(1.5, 0);
  const Vec3<double> w_out = from_above(0.6);
  const Vec3<double> mirrored(-w_out.x(), -w_out.y(), w_out.z());
  const SurfaceSample sample = coat.sample(w_out, {0.2, 0.9});
  EXPECT_EQ(sample.w_in, mirrored);
  EXPECT_EQ(sample.weight, Colour::Constant(fresnel(0.6, 1.5)));
  EXPECT_EQ(coat.eval(w_out, mirrored), Colour::Zero());
  EXPECT_EQ(coat.pdf(w_out, mirrored), 0);
  // Roughened, it has a highlight there; one that is rougher already stays as it is.
  EXPECT_GT(coat.roughened(0.3).eval(w_out, mirrored).x(), 0.01);
  EXPECT_EQ(Coat(1.5, 0.5).roughened(0.3).eval(w_out, mirrored),
            Coat(1.5, 0.5).eval(w_out, mirrored));
}

TEST(Reflection, microfacets_cover_their_surface) {
  // The facets' areas, projected, make up the surface: the integral of D(m) m.z is 1.
  for (const double alpha : {0.2, 0.5, 1.0}) {
    const RoughMirror rough{alpha};
    const double projected =
        mean([&](const auto& u) { return pi * rough.density(cosine_direction(u)); }, 1 << 16);
    EXPECT_NEAR(projected, 1, 2e-3) << alpha;
  }
}

}  // namespace
}  // namespace minkray
