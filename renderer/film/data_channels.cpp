// SPDX-License-Identifier: MIT
#include "renderer/film/data_channels.h"

#include <algorithm>
#include <limits>

#include "core/support/named_kind.h"
#include "renderer/base/errors.h"
#include "renderer/film/heatmap.h"
#include "renderer/film/pixel_loop.h"
#include "renderer/paths/inside.h"
#include "renderer/rays/camera.h"
#include "renderer/scene/scene_instances.h"
#include "renderer/surfaces/scene_surfaces.h"

namespace minkray {
namespace {

using Floats = std::vector<float>;
using Integers = std::vector<std::uint32_t>;

/// Result of the ray through a pixel's centre.
struct Found {
  Ray<double> ray;
  WorldHit hit;
  QueryCounts work;
  Colour albedo = Colour::Zero(), emission = Colour::Zero();
  double thickness = 0;
  Vec3<double> uv = Vec3<double>::Zero();
  Eigen::Vector2d motion = Eigen::Vector2d::Zero();

  bool any() const { return hit.found(); }
  double distance() const {
    return any() ? double(hit.cast.t()) : std::numeric_limits<double>::infinity();
  }
};

std::uint32_t clamped(std::uint64_t count) {
  constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
  return static_cast<std::uint32_t>(std::min(count, most));
}

std::uint32_t status_of(const Found& found) {
  const Status status = found.work.exhausted > 0 ? Status::exhausted : found.hit.cast.status;
  const auto at = std::find(heat_statuses.begin(), heat_statuses.end(), status);
  return static_cast<std::uint32_t>(at - heat_statuses.begin());
}

/// Writes one channel of one pixel to its planes, starting at `planes[0]`.
using Put = void (*)(const Found& found, const Vec3<double>& forward, std::size_t pixel,
                     ExrPlane* planes);

void put(ExrPlane& plane, std::size_t pixel, double value) {
  std::get<Floats>(plane.values)[pixel] = static_cast<float>(value);
}
void put(ExrPlane& plane, std::size_t pixel, std::uint32_t value) {
  std::get<Integers>(plane.values)[pixel] = value;
}
void put(ExrPlane* planes, std::size_t pixel, const Vec3<double>& value) {
  for (int i = 0; i < 3; ++i) put(planes[i], pixel, value[i]);
}

/// Computation of each of `data_channels`, in the same order; nothing for those from samples.
struct Filling {
  bool is_integer = false;
  Put put = nullptr;
};
constexpr std::
    array<Filling, data_channels.size()>
        fillings =
            {
                {
                    {false,
                     [](const Found& f, const Vec3<double>& forward, std::size_t i,
                        ExrPlane* planes) {
                       const double along = f.ray.direction.template cast<double>().dot(forward);
                       put(planes[0], i, f.distance() * along);
                     }},
                    {false, [](const Found& f, const Vec3<double>&, std::size_t i,
                               ExrPlane* planes) { put(planes[0], i, f.distance()); }},
                    {false,
                     [](const Found& f, const Vec3<double>&, std::size_t i, ExrPlane* planes) {
                       const Vec3<double> none = Vec3<double>::Zero();
                       put(planes, i,
                           f.any() ? Vec3<double>(f.hit.cast.normal.template cast<double>())
                                   : none);
                     }},
                    {false,
                     [](const Found& f, const Vec3<double>&, std::size_t i, ExrPlane* planes) {
                       const Vec3<double> none = Vec3<double>::Zero();
                       put(planes, i,
                           f.any() ? Vec3<double>(f.ray.at(f.hit.cast.t()).template cast<double>())
                                   : none);
                     }},
                    {true,
                     [](const Found& f, const Vec3<double>&, std::size_t i, ExrPlane* planes) {
                       put(planes[0], i, f.any() ? f.hit.instance + 1 : 0u);
                     }},
                    {true, [](const Found& f, const Vec3<double>&, std::size_t i,
                              ExrPlane* planes) { put(planes[0], i, clamped(f.work.iterations)); }},
                    {true, [](const Found& f, const Vec3<double>&, std::size_t i,
                              ExrPlane* planes) { put(planes[0], i, clamped(f.work.supports)); }},
                    {false,
                     [](const Found& f, const Vec3<double>&, std::size_t i, ExrPlane* planes) {
                       const bool is_hit = f.any() && f.hit.cast.status == Status::hit;
                       put(planes[0], i,
                           is_hit ? double(f.hit.cast.offset_hi - f.hit.cast.offset_lo) : 0.0);
                     }},
                    {false, [](const Found& f, const Vec3<double>&, std::size_t i,
                               ExrPlane* planes) { put(planes, i, f.albedo); }},
                    {false, [](const Found& f, const Vec3<double>&, std::size_t i,
                               ExrPlane* planes) { put(planes, i, f.emission); }},
                    {false, [](const Found& f, const Vec3<double>&, std::size_t i,
                               ExrPlane* planes) { put(planes[0], i, f.thickness); }},
                    {false,
                     [](const Found& f, const Vec3<double>&, std::size_t i, ExrPlane* planes) {
                       for (int k = 0; k < 2; ++k) put(planes[k], i, f.uv[k]);
                     }},
                    {false,
                     [](const Found& f, const Vec3<double>&, std::size_t i, ExrPlane* planes) {
                       for (int k = 0; k < 2; ++k) put(planes[k], i, f.motion[k]);
                     }},
                    {},
                    {},
                    {},
                    {},
                    {true, [](const Found& f, const Vec3<double>&, std::size_t i,
                              ExrPlane* planes) { put(planes[0], i, status_of(f)); }},
                }};

/// Motion of the hit point in the picture between the shutter's opening and closing.
Eigen::Vector2d motion_of(const Scene& scene, const Camera& camera, const Found& found) {
  if (found.hit.cast.status != Status::hit) return Eigen::Vector2d::Zero();
  const Movement<double> movement = instance_movement(scene, found.hit.instance);
  if (movement.stands()) return Eigen::Vector2d::Zero();
  const Vec3<double> point = found.ray.at(found.hit.cast.t()).template cast<double>();
  const auto before = camera.seen_at(point), after = camera.seen_at(movement.moved(point, 1));
  return before && after ? Eigen::Vector2d(*after - *before) : Eigen::Vector2d::Zero();
}

std::size_t index_of(std::string_view name) {
  const DataChannelDescription* const row = row_named(data_channels, name);
  return row ? static_cast<std::size_t>(row - data_channels.data()) : data_channels.size();
}

}  // namespace

std::vector<std::string_view> parse_data_channels(const std::string& list) {
  std::vector<std::string_view> names;
  const auto add = [&](std::string_view name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const std::string& name : pieces_of(list, ',')) {
    const std::size_t i = index_of(name);
    if (name == "all") {
      for (const DataChannelDescription& channel : data_channels) add(channel.name);
    } else if (i < data_channels.size()) {
      add(data_channels[i].name);
    } else {
      throw WrongUsage("--aov: must be some of " + listed(names_in(data_channels)) +
                       ", all, between commas (got \"" + name + "\")");
    }
  }
  return names;
}

bool has_integers(std::string_view channel) {
  const std::size_t i = index_of(channel);
  return i < fillings.size() && fillings[i].is_integer;
}

bool are_light_channels_wanted(const std::vector<std::string_view>& channels) {
  return std::any_of(channels.begin(), channels.end(), [](std::string_view name) {
    return name == "direct" || name == "indirect" || name == "variance";
  });
}

std::vector<ExrPlane> light_planes(const Rendering& rendering,
                                   const std::vector<std::string_view>& channels) {
  ExrImage planes;
  for (const std::string_view name : channels) {
    if (name == "direct") add_colour_planes(planes, rendering.direct, "direct.");
    if (name == "variance") add_colour_planes(planes, rendering.variance, "variance.");
    if (name != "indirect") continue;
    Image indirect = rendering.image;
    for (std::size_t i = 0; i < indirect.pixels.size(); ++i)
      indirect.pixels[i] -= rendering.direct.pixels[i];
    add_colour_planes(planes, indirect, "indirect.");
  }
  return planes.planes;
}

std::vector<ExrPlane> measure_data_channels(const Scene& scene, const World& world,
                                            const std::vector<std::string_view>& channels,
                                            const RenderOptions& options,
                                            const RenderWatch& watch) {
  const Camera camera(scene.camera, options.resolution);
  const Vec3<double> forward =
      camera.ray(0.5 * options.resolution.width, 0.5 * options.resolution.height).direction;
  const PixelRect region = options.region();
  const std::size_t pixels = pixel_count(region);

  struct Wanted {
    Put put;
    std::size_t first_plane;
  };
  std::vector<Wanted> wanted;
  std::vector<ExrPlane> planes;
  for (const std::string_view name : channels) {
    const std::size_t i = index_of(name);
    if (!fillings[i].put) continue;
    wanted.push_back({fillings[i].put, planes.size()});
    const auto add = [&](const std::string& plane) {
      if (fillings[i].is_integer)
        planes.push_back({plane, Integers(pixels)});
      else
        planes.push_back({plane, Floats(pixels)});
    };
    if (data_channels[i].planes.empty()) add(std::string(name));
    for (const char suffix : data_channels[i].planes) add(std::string(name) + "." + suffix);
  }

  const auto is_wanted = [&](std::string_view name) {
    return std::find(channels.begin(), channels.end(), name) != channels.end();
  };
  const bool wants_colours = is_wanted("albedo") || is_wanted("emission");
  const SceneSurfaces surfaces(scene);
  RayCounts counts;
  for_pixels(region, counts, watch, [&](const Pixel& pixel, RayCounts& of_tile) {
    Found found{camera.ray(pixel.x + 0.5, pixel.y + 0.5), {}, {}};
    found.hit = world.closest_hit({found.ray, no_instance, 0, camera_rays}, found.work);
    ++of_tile.camera;
    of_tile.work += found.work;
    if (wants_colours)
      surfaces.describe(world, found.ray, camera.cone(pixel.x + 0.5, pixel.y + 0.5), found.hit,
                        found.albedo, found.emission);
    if (is_wanted("uv")) found.uv = surfaces.uv(world, found.ray, found.hit);
    if (is_wanted("motion")) found.motion = motion_of(scene, camera, found);
    if (is_wanted("thickness")) found.thickness = length_within(world, found.ray, found.hit);
    for (const Wanted& channel : wanted)
      channel.put(found, forward, pixel.index, &planes[channel.first_plane]);
  });
  return planes;
}

}  // namespace minkray
