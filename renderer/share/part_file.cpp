// SPDX-License-Identifier: MIT
#include "renderer/share/part_file.h"

#include <array>
#include <utility>

#include "renderer/base/errors.h"
#include "renderer/json/parse.h"

namespace minkray {
namespace {

const std::vector<float>& floats_of(const ExrImage& exr, const std::string& name) {
  const ExrPlane* plane = exr.find(name);
  const auto* values = plane ? std::get_if<std::vector<float>>(&plane->values) : nullptr;
  if (values == nullptr) throw BadInput("has no channel " + name + " of floats");
  return *values;
}

constexpr std::array<std::pair<const char*, std::uint64_t RayCounts::*>, 7> ray_members = {{
    {"camera", &RayCounts::camera},
    {"shadow", &RayCounts::shadow},
    {"ambient", &RayCounts::ambient},
    {"scattered", &RayCounts::scattered},
    {"mirrored", &RayCounts::mirrored},
    {"background", &RayCounts::background},
    {"from_inside", &RayCounts::from_inside},
}};
constexpr std::array<std::pair<const char*, std::uint64_t QueryCounts::*>, 5> work_members = {{
    {"nodes", &QueryCounts::nodes},
    {"casts", &QueryCounts::casts},
    {"iterations", &QueryCounts::iterations},
    {"supports", &QueryCounts::supports},
    {"exhausted", &QueryCounts::exhausted},
}};

}  // namespace

std::string block_plane_name(int block, char channel) {
  const std::string number = std::to_string(block);
  return "block" + std::string(number.size() < 2 ? 1 : 0, '0') + number + "." + channel;
}

std::vector<float> coverage(const std::vector<std::uint32_t>& met, int samples) {
  std::vector<float> alpha;
  alpha.reserve(met.size());
  for (const std::uint32_t count : met)
    alpha.push_back(static_cast<float>(static_cast<double>(count) / samples));
  return alpha;
}

ExrImage exr_of(const Rendering& rendering, const RenderOptions& options, Facts facts) {
  ExrImage exr{{0, 0, options.resolution.width, options.resolution.height},
               options.region(),
               {},
               std::move(facts)};
  if (options.sample_share.is_all()) {
    add_colour_planes(exr, rendering.image);
    exr.planes.push_back({"A", coverage(rendering.met, options.samples)});
    return exr;
  }
  const int first = SampleBlocks{options.samples}.first_of(options.sample_share);
  for (std::size_t i = 0; i < rendering.block_sums.size(); ++i) {
    add_colour_planes(exr, rendering.block_sums[i]);
    for (ExrPlane& plane : exr.planes)
      if (plane.name.size() == 1)
        plane.name = block_plane_name(first + static_cast<int>(i), plane.name[0]);
  }
  exr.planes.push_back({met_plane, rendering.met});
  return exr;
}

Image image_of(const ExrImage& exr, const std::string& red, const std::string& green,
               const std::string& blue) {
  const std::array planes = {&floats_of(exr, red), &floats_of(exr, green), &floats_of(exr, blue)};
  Image image(exr.window.width(), exr.window.height());
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = {(*planes[0])[i], (*planes[1])[i], (*planes[2])[i]};
  return image;
}

Image image_of(const ExrImage& exr, const std::string& name) {
  return image_of(exr, name + ".R", name + ".G", name + ".B");
}

const std::vector<std::uint32_t>& integers_of(const ExrImage& exr, const std::string& name) {
  const ExrPlane* plane = exr.find(name);
  const auto* values = plane ? std::get_if<std::vector<std::uint32_t>>(&plane->values) : nullptr;
  if (values == nullptr) throw BadInput("has no channel " + name + " of integers");
  return *values;
}

std::string counts_text(const RayCounts& counts) {
  Json json;
  for (const auto& [name, member] : ray_members) json[name] = counts.*member;
  for (const auto& [name, member] : work_members) json[name] = counts.work.*member;
  return json.dump();
}

RayCounts counts_of(const Facts& facts) {
  RayCounts counts;
  Mistakes mistakes(counts_fact);
  const std::optional<Json> json = parse_json(text_of(facts, counts_fact), mistakes);
  const auto number = [&](const char* name) -> std::uint64_t {
    const Json* value = json ? json->find(name) : nullptr;
    if (value == nullptr || !value->is_number_unsigned())
      throw BadInput(std::string("its header has no usable ") + counts_fact);
    return value->get<std::uint64_t>();
  };
  for (const auto& [name, member] : ray_members) counts.*member = number(name);
  for (const auto& [name, member] : work_members) counts.work.*member = number(name);
  return counts;
}

std::string labels_text(const std::vector<Label>& labels) {
  Json list = Json::array();
  for (const Label& label : labels) list.push_back({label.x, label.y, label.text});
  return list.dump();
}

std::vector<Label> labels_of(const Facts& facts) {
  std::vector<Label> labels;
  Mistakes mistakes(labels_fact);
  const std::optional<Json> list = parse_json(text_of(facts, labels_fact), mistakes);
  if (!list) return labels;
  for (const Json& label : *list) {
    if (!label.is_array() || label.size() != 3 || !label[0].is_number() || !label[1].is_number() ||
        !label[2].is_string())
      throw BadInput(std::string("its header has no usable ") + labels_fact);
    labels.push_back({label[0].get<double>(), label[1].get<double>(), label[2].get<std::string>()});
  }
  return labels;
}

}  // namespace minkray
