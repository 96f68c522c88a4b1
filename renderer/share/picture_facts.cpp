// SPDX-License-Identifier: MIT
#include "renderer/share/picture_facts.h"

#include <algorithm>

#include "core/files/text.h"
#include "core/support/named_kind.h"
#include "renderer/base/build.h"
#include "renderer/base/errors.h"
#include "renderer/json/json.h"
#include "renderer/paper/solvers.h"

namespace minkray {
namespace {

[[noreturn]] void unusable(const Facts& facts, const std::string& name) {
  throw BadInput("its header has no usable " + name + " (got \"" + text_of(facts, name) + "\")");
}

/// Whole numbers between separators, nothing else around them.
std::vector<int> integers(const Facts& facts, const std::string& name, char separator,
                          std::size_t count) {
  const auto numbers = numbers_between<int>(text_of(facts, name), separator);
  if (!numbers || numbers->size() != count) unusable(facts, name);
  return *numbers;
}

/// "ambient", "path 16": its depth counts for paths alone.
std::string integrator_text(const Scene& scene, const IntegratorOptions& options) {
  const IntegratorKind kind = settled(options.kind, scene);
  const std::string text(name_in(integrators, kind));
  return kind == IntegratorKind::path ? text + " " + std::to_string(options.max_depth) : text;
}

}  // namespace

Facts picture_facts(const Scene& scene, const World& world, const RenderOptions& options) {
  const PixelRect picture = options.picture();
  const auto number = [](auto value) { return std::to_string(value); };
  return {
      {fact::software, std::string(version_and_commit())},
      {fact::scene, scene.hash},
      {fact::resolution,
       number(options.resolution.width) + "x" + number(options.resolution.height)},
      {fact::crop, number(picture.x0) + "," + number(picture.y0) + "," + number(picture.x1) + "," +
                       number(picture.y1)},
      {fact::samples, number(options.samples)},
      {fact::seed, number(options.seed)},
      {fact::solver, std::string(name_in(named_solvers, world.options().solver))},
      {fact::bounces, number(options.integrator.bounces)},
      {fact::integrator, integrator_text(scene, options.integrator)},
      {fact::limits,
       "clamp " + Json(options.integrator.clamp).dump() + " noise " + Json(options.noise).dump()},
  };
}

std::vector<std::string> common_facts() {
  return {fact::software, fact::scene,   fact::resolution, fact::crop,   fact::samples, fact::seed,
          fact::solver,   fact::bounces, fact::integrator, fact::limits, fact::aov};
}

std::string difference(const Facts& found, const Facts& wanted,
                       const std::vector<std::string>& names) {
  std::string differences;
  for (const std::string& name : names) {
    const std::string a = text_of(found, name), b = text_of(wanted, name);
    if (a == b) continue;
    differences += (differences.empty() ? "" : ", ") + name + " is " + (a.empty() ? "missing" : a) +
                   ", not " + (b.empty() ? "missing" : b);
  }
  return differences;
}

Resolution resolution_of(const Facts& facts) {
  const std::vector<int> numbers = integers(facts, fact::resolution, 'x', 2);
  if (numbers[0] < 1 || numbers[1] < 1) unusable(facts, fact::resolution);
  return {numbers[0], numbers[1]};
}

PixelRect crop_of(const Facts& facts) {
  const std::vector<int> numbers = integers(facts, fact::crop, ',', 4);
  // Pixels of the picture: so no width or height is beyond any int.
  if (std::ranges::any_of(numbers, [](int number) { return number < 0; }))
    unusable(facts, fact::crop);
  return {numbers[0], numbers[1], numbers[2], numbers[3]};
}

int samples_of(const Facts& facts) {
  const int samples = integers(facts, fact::samples, ' ', 1)[0];
  if (samples < 1) unusable(facts, fact::samples);
  return samples;
}

std::string text_of(const Facts& facts, const std::string& name) {
  const auto at = facts.find(name);
  return at == facts.end() ? std::string() : at->second;
}

}  // namespace minkray
