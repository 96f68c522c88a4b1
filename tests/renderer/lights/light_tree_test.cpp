// SPDX-License-Identifier: MIT
// Many lights are chosen among with the chances that are claimed, near ones more often.
#include "renderer/lights/light_tree.h"

#include <gtest/gtest.h>

#include <cmath>

#include "renderer/rays/sampler.h"

namespace minkray {
namespace {

std::vector<LightTree::Light> lights(int count) {
  std::vector<LightTree::Light> made;
  for (int i = 0; i < count; ++i) {
    Sampler sampler(3, i, 0, 0);
    const auto [x, y] = sampler.next();
    const auto [z, power] = sampler.next();
    made.push_back({{20 * x, 20 * y, z}, 0.1, 0.5 + power});
  }
  return made;
}

TEST(LightTree, chances_add_up_to_one_and_are_those_of_the_draws) {
  for (const int count : {1, 2, 17, 100}) {
    const LightTree tree(lights(count));
    const Vec3<double> point(3, 7, 1);
    double sum = 0;
    std::vector<int> drawn(static_cast<std::size_t>(count));
    constexpr int draws = 1 << 16;
    for (std::uint32_t i = 0; i < draws; ++i) {
      Sampler sampler(4, 0, 0, i);
      ++drawn[tree.choose(point, sampler.next()[0])];
    }
    for (std::size_t light = 0; light < drawn.size(); ++light) {
      const double chance = tree.chance(point, light);
      EXPECT_GT(chance, 0);
      sum += chance;
      EXPECT_NEAR(drawn[light], draws * chance, 5 + 0.02 * draws * chance) << count;
    }
    EXPECT_NEAR(sum, 1, 1e-12);
  }
}

// The spread of contribution over probability, compared with choosing by power alone.
TEST(LightTree, near_lights_are_drawn_so_much_more_often_that_there_is_a_quarter_of_the_variance) {
  const std::vector<LightTree::Light> all = lights(1000);
  const LightTree tree(all);
  double power = 0;
  for (const auto& light : all) power += light.power;
  for (const Vec3<double>& point : {Vec3<double>(3, 7, 1), {10, 10, -1}, {19, 1, 0.5}}) {
    double sum = 0, by_tree = 0, by_power = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const double sent = all[i].power / (all[i].centre - point).squaredNorm();
      sum += sent;
      by_tree += sent * sent / tree.chance(point, i);
      by_power += sent * sent * power / all[i].power;
    }
    EXPECT_LT(by_tree - sum * sum, (by_power - sum * sum) / 4);
  }
}

}  // namespace
}  // namespace minkray
