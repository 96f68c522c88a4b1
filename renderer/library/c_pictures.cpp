// SPDX-License-Identifier: MIT
// C interface: pictures.
#include <algorithm>
#include <atomic>
#include <variant>

#include "core/parallel/parallel.h"
#include "core/support/named_kind.h"
#include "renderer/base/errors.h"
#include "renderer/film/data_channels.h"
#include "renderer/film/features.h"
#include "renderer/import/scene_of_model.h"
#include "renderer/json/parse.h"
#include "renderer/library/handles/call.h"
#include "renderer/library/handles/held_scene.h"
#include "renderer/library/handles/work_on_rays.h"
#include "renderer/scene/default_light.h"
#include "renderer/scene/framing.h"
#include "renderer/scene_json/scene_json.h"

namespace minkray {
namespace {

constexpr std::string_view light_name = "rgb";
constexpr std::string_view mattes_name = "cryptomatte";  // tables in a file's header: no numbers
constexpr std::int64_t most_pixels = std::int64_t{1} << 28;
constexpr std::uint32_t most_samples = 1 << 24;

/// Part of a picture requested by a name, and the count of its numbers per pixel.
struct Channel {
  std::string_view name;  ///< empty: the light
  std::uint32_t numbers = 3;
  bool is_integer = false;
};

Channel channel_of(const char* name, const std::string& argument) {
  require(name, argument.c_str());
  if (name == light_name) return {};
  const DataChannelDescription* const known = row_named(data_channels, name);
  if (known && known->name != mattes_name)
    return {known->name, static_cast<std::uint32_t>(std::max(known->planes.size(), std::size_t{1})),
            has_integers(known->name)};
  std::vector<std::string> names = names_in(data_channels);
  std::erase(names, mattes_name);
  wrong_use(argument + ": must be one of " + std::string(light_name) + ", " + listed(names) +
            " (got \"" + printable(name, 60) + "\")");
}

/// The scene with the camera and the light of the options, or else those of its files, or of
/// robots if it has none.
Scene seen(const HeldScene& held, const minkray_picture_options& options) {
  Scene scene = held.whole();
  Json json = Json::object();
  if (options.view) {
    Mistakes mistakes("options.view");
    const auto given = parse_json(options.view, mistakes);
    if (given && !given->is_object()) mistakes.add("must be an object");
    throw_if_any(mistakes);
    json = *given;
  }
  const bool has_camera = json.contains("camera"), has_lights = json.contains("lights"),
             has_background = json.contains("background");
  // Adds all the rest that a scene file must have, as placeholders.
  json["version"] = scene_version;
  if (!has_camera) json["camera"] = {{"position", {0, -1, 0}}, {"look_at", {0, 0, 0}}};
  for (const char* key : {"lights", "materials", "objects"})
    if (!json.contains(key)) json[key] = Json::array();
  Mistakes mistakes("options.view");
  const std::optional<Scene> read = parse_scene(json.dump(), {}, mistakes);
  if (read && (!read->objects.empty() || !read->materials.empty()))
    mistakes.add("must contain only camera, lights and background");
  throw_if_any(mistakes);
  if (has_camera) {
    scene.camera = read->camera;
  } else if (!held.has_camera() || scene.camera_is_framed) {
    const auto side = [](std::uint32_t given, int or_else) {
      return given > 0 && given <= most_pixels_a_side ? static_cast<int>(given) : or_else;
    };
    const Resolution picture = {side(options.width, scene.camera.resolution.width),
                                side(options.height, scene.camera.resolution.height)};
    if (held.has_camera()) {
      scene.camera.resolution = picture;
      frame_with_own_lens(scene);
    } else {
      frame_everything(scene, picture);
    }
  }
  if (!has_lights && !held.has_camera()) light_everything(scene);
  if (has_lights) scene.lights = read->lights;
  if (has_background) scene.background = read->background;
  if (has_background || has_lights) scene.background_is_sky = read->background_is_sky;
  return scene;
}

std::uint32_t checked(std::uint32_t given, std::uint32_t or_else, std::uint32_t most,
                      const char* argument) {
  if (given > most)
    wrong_use(std::string(argument) + ": must be at most " + std::to_string(most) + " (got " +
              std::to_string(given) + ")");
  return given == 0 ? or_else : given;
}

/// Options for the picture of a scene that is seen already.
RenderOptions render_options(const Scene& scene, const minkray_picture_options& given) {
  RenderOptions options;
  const Resolution& own = scene.camera.resolution;
  options.resolution.width = static_cast<int>(checked(
      given.width, static_cast<std::uint32_t>(own.width), most_pixels_a_side, "options.width"));
  options.resolution.height = static_cast<int>(checked(
      given.height, static_cast<std::uint32_t>(own.height), most_pixels_a_side, "options.height"));
  if (std::int64_t{options.resolution.width} * options.resolution.height > most_pixels)
    wrong_use("options.width, options.height: must be of at most " + std::to_string(most_pixels) +
              " pixels");
  options.samples = static_cast<int>(checked(given.samples, 16, most_samples, "options.samples"));
  options.seed = given.seed;
  const std::string name(given.integrator ? given.integrator : integrators.front().name);
  const auto* const chosen = row_named(integrators, name);
  if (!chosen)
    wrong_use("options.integrator: must be one of " + listed(names_in(integrators)) + " (got \"" +
              printable(name, 60) + "\")");
  options.integrator.kind = settled(chosen->kind, scene);
  const auto often = [](std::int32_t number, int or_else, std::uint32_t most,
                        const char* argument) {
    if (number <= 0) return number == 0 ? or_else : 0;
    return static_cast<int>(checked(static_cast<std::uint32_t>(number), 0, most, argument));
  };
  IntegratorOptions& light = options.integrator;
  light.max_depth = often(given.max_depth, light.max_depth, 1000, "options.max_depth");
  light.bounces = often(given.bounces, light.bounces, 64, "options.bounces");
  return options;
}

/// Puts planes of one channel side by side, pixel by pixel.
void interleave(const std::vector<ExrPlane>& planes, const Channel& channel, double* values) {
  std::uint32_t put = 0;
  for (const ExrPlane& plane : planes) {
    const bool is_of =
        plane.name == channel.name ||
        (channel.numbers > 1 && plane.name.starts_with(std::string(channel.name) + "."));
    if (!is_of) continue;
    std::visit(
        [&](const auto& numbers) {
          for (std::size_t i = 0; i < numbers.size(); ++i)
            values[i * channel.numbers + put] = static_cast<double>(numbers[i]);
        },
        plane.values);
    ++put;
  }
}

void render(const HeldScene& held, const minkray_picture_options& given,
            std::span<const minkray_channel> asked, const minkray_options* how) {
  const Scene scene = seen(held, given);
  const World& world = held.world();
  RenderOptions options = render_options(scene, given);
  const auto pixels = static_cast<std::size_t>(options.resolution.width) *
                      static_cast<std::size_t>(options.resolution.height);
  std::vector<Channel> channels;
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const std::string place = "channels[" + std::to_string(i) + "].";
    channels.push_back(channel_of(asked[i].name, place + "name"));
    require(asked[i].values, (place + "values").c_str());
    if (asked[i].count != pixels * channels.back().numbers)
      wrong_use(place + "count: must be " + std::to_string(pixels * channels.back().numbers) +
                ", all numbers of all pixels (got " + std::to_string(asked[i].count) + ")");
    const std::string_view name = channels.back().name;
    if (!name.empty() && std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  const bool wants_light = are_light_channels_wanted(names) ||
                           std::ranges::find(channels, "", &Channel::name) != channels.end();
  options.light_channels = given.denoise != 0 || are_light_channels_wanted(names);
  if (given.denoise != 0 && options.samples < 2)
    wrong_use("options.samples: must be at least 2 to denoise");

  std::atomic<bool> stopped = false;
  const RenderWatch watch{[&](double done, std::uint64_t) {
                            if (wants_stop(how, done)) stopped = true;
                          },
                          [&] { return stopped.load(std::memory_order_relaxed); }};
  const auto go_on = [&] {
    if (stopped) throw CallError(MINKRAY_STOPPED, "stopped by the caller");
  };
  with_threads(threads_of(how), [&] {
    Rendering rendering;
    if (wants_light) rendering = minkray::render(scene, world, options, watch);
    go_on();
    std::vector<ExrPlane> planes;
    if (!names.empty()) planes = measure_data_channels(scene, world, names, options, watch);
    go_on();
    for (ExrPlane& plane : light_planes(rendering, names)) planes.push_back(std::move(plane));
    if (wants_light && given.denoise != 0)
      rendering.image = denoised(noisy_picture(scene, world, options, rendering, watch));
    go_on();
    for (std::size_t i = 0; i < channels.size(); ++i) {
      if (!channels[i].name.empty()) {
        interleave(planes, channels[i], asked[i].values);
        continue;
      }
      for (std::size_t p = 0; p < pixels; ++p)
        for (int k = 0; k < 3; ++k)
          asked[i].values[3 * p + static_cast<std::size_t>(k)] =
              static_cast<double>(rendering.image.pixels[p][k]);
    }
  });
  throw_if_lied(held.customs());
}

const minkray_picture_options& checked(const minkray_picture_options* options) {
  static constexpr minkray_picture_options none = {sizeof none, nullptr, 0, 0, 0,
                                                   0,           0,       0, 0, nullptr};
  if (!options) return none;
  if (options->size < sizeof(minkray_picture_options))
    wrong_use("options.size: must be sizeof(minkray_picture_options)");
  return *options;
}

}  // namespace
}  // namespace minkray

using namespace minkray;

extern "C" {

int minkray_picture_channel(const char* name, uint32_t* numbers, int32_t* is_integer) {
  return call("minkray_picture_channel", [&] {
    const Channel channel = channel_of(name, "name");
    if (numbers) *numbers = channel.numbers;
    if (is_integer) *is_integer = channel.is_integer ? 1 : 0;
  });
}

int minkray_scene_picture_size(minkray_scene scene, const minkray_picture_options* options,
                               uint32_t* width, uint32_t* height) {
  return call("minkray_scene_picture_size", [&] {
    const SceneQuery held(scene);
    const minkray_picture_options& given = checked(options);
    const Resolution found = render_options(seen(*held, given), given).resolution;
    if (width) *width = static_cast<uint32_t>(found.width);
    if (height) *height = static_cast<uint32_t>(found.height);
  });
}

int minkray_scene_render(minkray_scene scene, const minkray_picture_options* options,
                         const minkray_channel* channels, size_t count,
                         const minkray_options* how) {
  return call("minkray_scene_render", [&] {
    const SceneQuery held(scene);
    if (count > 0) require(channels, "channels");
    require_room(count, sizeof(minkray_channel), "count");
    render(*held, checked(options), {channels, count}, how);
  });
}

}  // extern "C"
