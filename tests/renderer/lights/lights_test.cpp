// SPDX-License-Identifier: MIT
#include "renderer/lights/lights.h"

#include <gtest/gtest.h>

#include "tests/support/density.h"

namespace minkray {
namespace {

const Vec3<double> somewhere(1, 2, 3);

/// Skies of every kind: even, brighter above or below, dark on one side, of changing colour.
const std::vector<EnvironmentSource> skies = {{Colour::Ones(), Colour::Ones()},
                                              {Colour::Constant(3), Colour::Constant(1)},
                                              {{0.1, 0.2, 0.3}, {1, 2, 3}},
                                              {{0.2, 0.5, 2}, Colour::Zero()},
                                              {Colour::Zero(), {1, 0, 0}}};

TEST(Lights, directions_of_a_sky_have_the_density_they_claim) {
  for (const EnvironmentSource& sky : skies)
    expect_density(check_density(
        [&](Sampler& sampler) -> std::optional<Vec3<double>> {
          const auto sample = sky.sample(somewhere, sampler);
          if (sample) return sample->direction;
          return std::nullopt;
        },
        [&](const Vec3<double>& direction) { return sky.pdf(somewhere, direction); }));
}

TEST(Lights, a_sample_of_a_sky_weighs_its_radiance_over_its_density) {
  for (const EnvironmentSource& sky : skies)
    for (std::uint32_t i = 0; i < 1000; ++i) {
      Sampler sampler(5, 0, 0, i);
      const auto sample = sky.sample(somewhere, sampler);
      ASSERT_TRUE(sample);
      EXPECT_NEAR(sample->direction.norm(), 1, 1e-12);
      EXPECT_EQ(sample->distance, std::numeric_limits<double>::infinity());
      const double density = sky.pdf(somewhere, sample->direction);
      const Colour radiance = sky.eval(sample->direction);
      EXPECT_NEAR((sample->weight * density - radiance).norm(), 0, 1e-12 * radiance.norm());
    }
}

// The irradiance of a plate that lies flat under a sky is known: of a gradient from n to z, the
// integral over the upper half is pi (5 z + n) / 6.
TEST(Lights, a_plate_under_a_sky) {
  const EnvironmentSource sky({0.2, 0.5, 2}, {0.9, 0.1, 0});
  constexpr int count = 1 << 16;
  Colour sum = Colour::Zero();
  for (std::uint32_t i = 0; i < count; ++i) {
    Sampler sampler(6, 0, 0, i);
    const auto sample = sky.sample(somewhere, sampler);
    ASSERT_TRUE(sample);
    sum += std::max(sample->direction.z(), 0.0) * sample->weight;
  }
  const Colour expected = std::numbers::pi / 6 * (5 * Colour(0.2, 0.5, 2) + Colour(0.9, 0.1, 0));
  EXPECT_NEAR((sum / count - expected).norm(), 0, 1e-3 * expected.norm());
}

TEST(Lights, a_black_sky_sends_nothing) {
  const EnvironmentSource sky(Colour::Zero(), Colour::Zero());
  Sampler sampler(7, 0, 0, 0);
  EXPECT_FALSE(sky.sample(somewhere, sampler));
  EXPECT_EQ(sky.pdf(somewhere, Vec3<double>::UnitZ()), 0);
}

TEST(Lights, a_lamp_shines_from_where_it_is) {
  const PointSource lamp(PointLight{{1, 2, 7}, Colour::Constant(8)});
  Sampler sampler(8, 0, 0, 0), untouched = sampler;
  const auto sample = lamp.sample(somewhere, sampler);
  ASSERT_TRUE(sample);
  EXPECT_EQ(sample->direction, Vec3<double>(0, 0, 1));
  EXPECT_EQ(sample->distance, 4);
  EXPECT_EQ(sample->weight, Colour::Constant(0.5));
  EXPECT_EQ(sampler.next(), untouched.next());  // needs no random numbers
  EXPECT_FALSE(lamp.sample({1, 2, 7}, sampler));
}

TEST(Lights, suns_come_before_lamps_and_skies_add_up) {
  const Lights lights({EnvironmentLight{Colour::Constant(1), Colour::Constant(1)},
                       PointLight{{1, 2, 5}, Colour::Constant(8)},
                       DirectionalLight{{0, -3, 0}, Colour::Constant(7)},
                       EnvironmentLight{Colour::Constant(4), Colour::Constant(0)}});
  ASSERT_EQ(lights.count(), 2u);
  Sampler sampler(9, 0, 0, 0);
  const auto sun = lights.sample(0, somewhere, sampler),
             lamp = lights.sample(1, somewhere, sampler);
  ASSERT_TRUE(sun && lamp);
  EXPECT_EQ(sun->direction, Vec3<double>(0, 1, 0));
  EXPECT_EQ(sun->distance, std::numeric_limits<double>::infinity());
  EXPECT_EQ(sun->weight, Colour::Constant(7));
  EXPECT_EQ(lamp->weight, Colour::Constant(2));
  EXPECT_TRUE(lights.has_environment());
  EXPECT_EQ(lights.environment(Vec3<double>::UnitZ()), Colour::Constant(5));
  EXPECT_EQ(lights.environment(-Vec3<double>::UnitZ()), Colour::Constant(1));
}

}  // namespace
}  // namespace minkray
