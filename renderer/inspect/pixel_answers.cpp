// SPDX-License-Identifier: MIT
#include "renderer/inspect/pixel_answers.h"

#include <algorithm>
#include <chrono>

#include "renderer/film/heatmap.h"
#include "renderer/film/pixel_loop.h"
#include "renderer/rays/camera.h"

namespace minkray {
namespace {

/// Number of casts of a ray to measure its time; other programs run on the machine, too.
constexpr int tries = 3;

RayCost cost_of(const SceneCasts& casts, const Ray<double>& ray) {
  using Clock = std::chrono::steady_clock;
  RayCost cost;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < tries; ++i) {
    const auto begin = Clock::now();
    const SceneAnswer answer = casts.answer(ray);
    const std::chrono::duration<double, std::nano> taken = Clock::now() - begin;
    least = std::min(least, taken.count());
    cost.work = answer.work;
    cost.last_path = answer.work.furthest_path();
  }
  cost.nanoseconds = least;
  return cost;
}

std::uint8_t number_of(Status status) {
  const auto at = std::find(heat_statuses.begin(), heat_statuses.end(), status);
  return static_cast<std::uint8_t>(at - heat_statuses.begin());
}

/// Work of another solver for the cast that is shown.
ShownWork work_of(const SceneCasts& casts, const ShownCast& shown, const Ray<double>& ray) {
  if (!shown.has_steps) return {};
  const CastResult<double> result = casts.trace(shown.shown(), ray).result;
  return {result.iterations, result.supports};
}

template <class Count>
std::uint16_t in_16_bits(Count count) {
  return static_cast<std::uint16_t>(
      std::min<std::uint64_t>(static_cast<std::uint64_t>(count), 65535));
}

template <class From, class Get>
auto plane_of(const std::vector<From>& from, const Get& get) {
  std::vector<decltype(get(from.front()))> plane;
  plane.reserve(from.size());
  for (const From& pixel : from) plane.push_back(get(pixel));
  return plane;
}

}  // namespace

ShownCast shown_cast(const SceneCasts& casts, const Ray<double>& ray, std::size_t most_looked_at) {
  const SceneAnswer answer = casts.answer(ray);
  ShownCast shown;
  const auto part = casts.shown(ray, answer, most_looked_at);
  // Without iterations to show it is the picture's own answer.
  const CastResult<double> result = part ? casts.trace(*part, ray).result : answer.hit.cast;
  shown.has_steps = part.has_value();
  if (part) shown.object = static_cast<std::uint32_t>(part->instance + 1);
  if (!part && answer.hit.found()) shown.object = answer.hit.instance + 1;
  shown.part = part ? part->part : answer.hit.part;
  shown.status = number_of(result.status);
  if (result.found()) {
    shown.t = result.t_base + result.t_offset;
    shown.below = result.t_offset - result.offset_lo;
    shown.above = result.offset_hi - result.t_offset;
  }
  shown.normal = result.normal;
  shown.iterations = result.iterations;
  shown.supports = result.supports;
  return shown;
}

PixelAnswers measure_pixels(const Scene& scene, const std::vector<const SceneCasts*>& solvers,
                            const Resolution& resolution, const RenderWatch& watch) {
  const Camera camera(scene.camera, resolution);
  const PixelRect all{0, 0, resolution.width, resolution.height};
  PixelAnswers answers;
  answers.resolution = resolution;
  answers.shown.resize(pixel_count(all));
  answers.work.assign(solvers.size(), std::vector<ShownWork>(pixel_count(all)));
  answers.of_ray.assign(solvers.size(), std::vector<RayCost>(pixel_count(all)));
  RayCounts counts;
  answers.complete = for_pixels(all, counts, watch, [&](const Pixel& pixel, RayCounts& of_tile) {
    const Ray<double> ray = camera.ray(pixel.x + 0.5, pixel.y + 0.5);
    const ShownCast shown = shown_cast(*solvers.front(), ray, most_looked_at_in_picture);
    answers.shown[pixel.index] = shown;
    for (std::size_t k = 0; k < solvers.size(); ++k) {
      answers.work[k][pixel.index] =
          k == 0 ? ShownWork{shown.iterations, shown.supports} : work_of(*solvers[k], shown, ray);
      answers.of_ray[k][pixel.index] = cost_of(*solvers[k], ray);
    }
    ++of_tile.camera;
  });
  return answers;
}

PackedPlanes packed(const PixelAnswers& answers) {
  const auto& shown = answers.shown;
  PackedPlanes planes;
  planes.add("object", plane_of(shown, [](const ShownCast& c) { return c.object; }));
  if (std::ranges::any_of(shown, [](const ShownCast& c) { return c.part != no_part; }))
    planes.add("triangle", plane_of(shown, [](const ShownCast& c) { return c.part; }));
  planes.add("status", plane_of(shown, [](const ShownCast& c) { return c.status; }));
  planes.add("t", plane_of(shown, [](const ShownCast& c) { return c.t; }));
  planes.add("below",
             plane_of(shown, [](const ShownCast& c) { return length_in_16_bits(c.below); }));
  planes.add("above",
             plane_of(shown, [](const ShownCast& c) { return length_in_16_bits(c.above); }));
  for (const std::size_t i : {0u, 1u})
    planes.add(i == 0 ? "normal_u" : "normal_v", plane_of(shown, [&](const ShownCast& c) {
                 return direction_in_32_bits(c.normal)[i];
               }));
  for (std::size_t k = 0; k < answers.of_ray.size(); ++k) {
    const auto& rays = answers.of_ray[k];
    const auto name_of_plane = [&](const char* name) {
      return name + std::string(":") + std::to_string(k);
    };
    const auto add_work = [&](const char* name, const auto& get) {
      planes.add(name_of_plane(name), plane_of(answers.work[k], get));
    };
    add_work("iterations", [](const ShownWork& w) { return in_16_bits(w.iterations); });
    add_work("supports", [](const ShownWork& w) { return in_16_bits(w.supports); });
    const auto add = [&](const char* name, const auto& get) {
      planes.add(name_of_plane(name), plane_of(rays, get));
    };
    add("ray_iterations", [](const RayCost& c) { return in_16_bits(c.work.iterations); });
    add("ray_supports", [](const RayCost& c) { return in_16_bits(c.work.supports); });
    add("ray_nodes", [](const RayCost& c) { return in_16_bits(c.work.nodes); });
    add("ray_casts", [](const RayCost& c) { return in_16_bits(c.work.casts); });
    add("ray_path", [](const RayCost& c) { return static_cast<std::uint8_t>(c.last_path); });
    add("ray_time", [](const RayCost& c) { return time_in_8_bits(c.nanoseconds); });
  }
  return planes;
}

}  // namespace minkray
