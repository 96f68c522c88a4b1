// SPDX-License-Identifier: MIT
#include "renderer/inspect/replay_choice.h"

#include <algorithm>
#include <map>
#include <set>

namespace minkray {
namespace {

/// The coarsest grid's step.
constexpr int coarsest = 64;

/// Scenes of more objects have one of each kind taken: their shapes would fill the page.
constexpr std::size_t most_objects_told_apart = 200;

}  // namespace

std::vector<std::size_t> replay_order(const PixelAnswers& answers) {
  std::vector<std::size_t> order;
  std::vector<bool> taken(answers.shown.size());
  const auto take = [&](std::size_t pixel) {
    if (taken[pixel] || answers.shown[pixel].object == 0) return;
    taken[pixel] = true;
    order.push_back(pixel);
  };

  std::set<std::uint32_t> objects;
  for (const ShownCast& shown : answers.shown) objects.insert(shown.object);
  const bool tells_apart = objects.size() <= most_objects_told_apart;

  // One of each kind: the hardest by each solver.
  for (const auto& rays : answers.of_ray) {
    std::map<std::array<std::uint32_t, 3>, std::size_t> hardest;
    for (std::size_t i = 0; i < answers.shown.size(); ++i) {
      const ShownCast& shown = answers.shown[i];
      const auto path = static_cast<std::uint32_t>(rays[i].last_path);
      const auto [at, is_new] =
          hardest.try_emplace({shown.status, path, tells_apart ? shown.object : 0}, i);
      if (!is_new && rays[i].work.iterations > rays[at->second].work.iterations) at->second = i;
    }
    for (const auto& [kind, pixel] : hardest) take(pixel);
  }

  // Rays that pass by everything have nothing to show but that.
  const auto is_worth_it = [&](std::size_t pixel) {
    return answers.shown[pixel].status != 0 || answers.shown[pixel].iterations > 0 ||
           std::any_of(answers.of_ray.begin(), answers.of_ray.end(),
                       [&](const auto& rays) { return rays[pixel].work.iterations > 0; });
  };
  const auto& [width, height] = answers.resolution;
  for (int step = coarsest; step >= 1; step /= 2)
    for (int y = step / 2; y < height; y += step)
      for (int x = step / 2; x < width; x += step) {
        const std::size_t pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                  static_cast<std::size_t>(x);
        if (is_worth_it(pixel)) take(pixel);
      }
  return order;
}

}  // namespace minkray
