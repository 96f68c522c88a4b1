// SPDX-License-Identifier: MIT
// Pictures of the scene that all threads query at once, whole and stopped half-way.
#include "tests/soak/work.h"

namespace soak {
namespace {

mk::PictureOptions small_picture() {
  mk::PictureOptions options;
  options.view = R"({"camera": {"position": [-3, -6, 3], "look_at": [0, 0, 0.3]}})";
  options.width = 64;
  options.height = 36;
  options.samples = 2;
  return options;
}

void render(const Common& common, const mk::PictureOptions& options,
            std::initializer_list<const char*> names, Answers& answers) {
  std::vector<std::vector<double>> values;
  std::vector<mk::Channel> channels;
  for (const char* name : names) {
    std::uint32_t numbers = 0;
    if (minkray_picture_channel(name, &numbers, nullptr) != MINKRAY_OK)
      throw mk::Error(MINKRAY_WRONG_USE);
    values.emplace_back(std::size_t{options.width} * options.height * numbers);
    channels.push_back({name, values.back().data(), values.back().size()});
  }
  common.scene.render(options, channels, {.threads = common.threads});
  for (const std::vector<double>& numbers : values) answers.add_all(numbers);
}

}  // namespace

void pictures(const Common& common, Answers& answers) {
  mk::PictureOptions options = small_picture();
  render(common, options, {"rgb", "Z", "N", "id.object", "status"}, answers);
  options.denoise = true;
  options.seed = 7;
  render(common, options, {"rgb", "albedo"}, answers);
}

void paths_of_light(const Common& common, Answers& answers) {
  mk::PictureOptions options = small_picture();
  options.integrator = "path";
  options.max_depth = 6;
  render(common, options, {"rgb", "direct", "variance"}, answers);
}

void stopped_pictures(const Common& common, Answers& answers) {
  mk::PictureOptions options = small_picture();
  options.width = 160;
  options.height = 90;
  options.samples = 4;
  std::vector<double> light(std::size_t{options.width} * options.height * 3);
  const mk::Channel channel[] = {{"rgb", light.data(), light.size()}};
  for (const char* integrator : {"ambient", "path"}) {
    options.integrator = integrator;
    const bool stopped = stopped_after(0.3, common.threads, [&](const mk::Options& how) {
      common.scene.render(options, channel, how);
    });
    common.stopped += stopped;
  }
  // Later results are unaffected.
  render(common, small_picture(), {"rgb"}, answers);
}

}  // namespace soak
