// SPDX-License-Identifier: MIT
#include "tests/fuzz/edited_parts.h"

#include <cstdint>
#include <sstream>

#include "renderer/film/pixel_loop.h"
#include "renderer/share/checkpoint.h"
#include "tests/support/temporary_folder.h"

namespace minkray::fuzz {
namespace {

constexpr int width = 40, height = 24, samples = 3;

Rendering rendering_of(const RenderOptions& options) {
  const PixelRect region = options.region();
  const auto image = [&](float first) {
    Image filled(region.width(), region.height());
    for (Vec3<float>& pixel : filled.pixels) pixel = {first += 0.25f, 1, 0.5f};
    return filled;
  };
  Rendering rendering;
  rendering.met.assign(image(0).pixels.size(), 2);
  rendering.complete = true;
  if (options.light_channels) rendering.direct = rendering.variance = image(0);
  const SampleBlocks blocks{options.samples};
  if (options.sample_share.is_all())
    rendering.image = image(1);
  else
    for (int block = blocks.first_of(options.sample_share);
         block < blocks.end_of(options.sample_share); ++block)
      rendering.block_sums.push_back(image(2));
  return rendering;
}

RenderOptions options_of_picture() {
  RenderOptions options;
  options.resolution = {width, height};
  options.samples = samples;
  return options;
}

/// All of common_facts(); all but three of the texts are compared.
Facts facts_of(const RenderOptions& options) {
  Facts facts;
  for (const std::string& name : common_facts()) facts[name] = "same";
  facts[fact::resolution] = std::to_string(width) + "x" + std::to_string(height);
  facts[fact::crop] = "0,0," + std::to_string(width) + "," + std::to_string(height);
  facts[fact::samples] = std::to_string(samples);
  facts[fact::tile] = options.tile.text();
  facts[fact::sample_share] = options.sample_share.text();
  return facts;
}

void set_window(ExrImage& exr, const PixelRect& window) {
  constexpr std::int64_t most_pixels = 1 << 14;
  const std::int64_t w = std::int64_t{window.x1} - window.x0,
                     h = std::int64_t{window.y1} - window.y0;
  if (w <= 0 || h <= 0 || w > most_pixels || h > most_pixels || w * h > most_pixels) return;
  exr.window = window;
  for (ExrPlane& plane : exr.planes)
    std::visit([&](auto& values) { values.resize(static_cast<std::size_t>(w * h)); }, plane.values);
}

template <class Number>
void make_plane(ExrImage& exr, const std::string& name, Number number) {
  const auto size =
      static_cast<std::size_t>(exr.window.width()) * static_cast<std::size_t>(exr.window.height());
  std::erase_if(exr.planes, [&](const ExrPlane& plane) { return plane.name == name; });
  exr.planes.push_back({name, std::vector<Number>(size, number)});
}

void edit_by_words(ExrImage& exr, const std::string& line) {
  std::istringstream in(line);
  std::string verb, name, to;
  in >> verb;
  if (verb == "w" || verb == "d") {
    PixelRect rect;
    if (!(in >> rect.x0 >> rect.y0 >> rect.x1 >> rect.y1)) return;
    if (verb == "w") set_window(exr, rect);
    if (verb == "d") exr.display = rect;
    return;
  }
  if (!(in >> name)) return;
  const auto at = std::ranges::find(exr.planes, name, &ExrPlane::name);
  if (verb == "i") make_plane<std::uint32_t>(exr, name, 1);
  if (verb == "f") make_plane<float>(exr, name, 1);
  if (at == exr.planes.end()) return;
  if (verb == ">" && in >> to && exr.find(to) == nullptr) at->name = to;
  if (double number = 0; verb == "p" && in >> number)
    std::visit(
        [&]<class Number>(std::vector<Number>& values) {
          if (number >= 0 && number < 4e9) std::ranges::fill(values, static_cast<Number>(number));
        },
        at->values);
}

}  // namespace

PartsOfPicture parts_of_kind(int kind) {
  PartsOfPicture parts;
  for (int index = 1; index <= 2; ++index) {
    RenderOptions options = options_of_picture();
    if (kind != 1) options.tile = {index, 2};
    if (kind != 0) options.sample_share = {kind == 1 ? index : 1, 2};
    Facts facts = facts_of(options);
    facts[counts_fact] = counts_text({});
    facts[cpu_seconds_fact] = "1.5";
    facts[labels_fact] = labels_text({{1, 2, "label"}});
    if (index == 1) parts.options = options, parts.facts = facts;
    parts.images.push_back(exr_of(rendering_of(options), options, facts));
  }
  return parts;
}

PartsOfPicture checkpoint_of_kind(int kind) {
  PartsOfPicture parts;
  parts.options = options_of_picture();
  parts.options.light_channels = kind == 1;
  if (kind == 2) parts.options.sample_share = {2, 2};
  parts.facts = facts_of(parts.options);
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "x.checkpoint").string();
  {
    constexpr double always = 1e-9;  // seconds
    Checkpoint checkpoint(file, parts.options, parts.facts, always);
    checkpoint.tile_finished(rendering_of(parts.options), 0);
  }
  parts.images.push_back(read_exr(file));
  return parts;
}

void edit(std::vector<ExrImage>& images, std::string_view lines) {
  ExrImage* exr = &images.front();
  while (!lines.empty()) {
    const std::string line(lines.substr(0, lines.find('\n')));
    lines.remove_prefix(std::min(line.size() + 1, lines.size()));
    if (line == "2") {
      exr = &images.back();
    } else if (const std::size_t equals = line.find('=');
               equals != std::string::npos && equals > 0) {
      exr->texts[line.substr(0, equals)] = line.substr(equals + 1);
    } else if (line.starts_with('-')) {
      const std::string name = line.substr(1);
      exr->texts.erase(name);
      std::erase_if(exr->planes, [&](const ExrPlane& plane) { return plane.name == name; });
    } else {
      edit_by_words(*exr, line);
    }
  }
}

}  // namespace minkray::fuzz
