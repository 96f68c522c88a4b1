// SPDX-License-Identifier: MIT
#include "renderer/info/scene_info.h"

#include <cstdio>

#include "renderer/film/render.h"
#include "renderer/json/mistakes.h"
#include "renderer/json/values.h"
#include "renderer/member_json/member_codec.h"
#include "renderer/member_json/tagged_json.h"
#include "renderer/scene/summary.h"
#include "renderer/scene_json/half_space_json.h"
#include "renderer/scene_json/schema.h"

namespace minkray {
namespace {

constexpr int json_indent = 2;

std::string pretty(const Json& json) {
  return json.dump(json_indent) + "\n";
}

std::string text_of(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", number);
  return text;
}

std::string text_of(const Vec3<double>& v) {
  return "(" + text_of(v.x()) + ", " + text_of(v.y()) + ", " + text_of(v.z()) + ")";
}

/// "scene      12 objects": a line with its title.
std::string line(std::string_view title, const std::string& value) {
  std::string text(title);
  text.resize(std::max<std::size_t>(text.size(), 12), ' ');
  return text + value + "\n";
}

std::string bytes_text(std::size_t bytes) {
  if (bytes < 10000) return std::to_string(bytes) + " bytes";
  if (bytes < 10000000) return std::to_string((bytes + 512) / 1024) + " KiB";
  return std::to_string((bytes + (1 << 19)) >> 20) + " MiB";
}

/// "> 0", or what else the parameter must be; "-" if anything will do.
std::string constraint_text(const Parameter& parameter) {
  return constraint(parameter.range).empty() ? "-" : std::string(constraint(parameter.range));
}

std::string unit_text(const Parameter& parameter) {
  return name_of(parameter.unit).empty() ? "-" : std::string(name_of(parameter.unit));
}

/// The text in a cell of a Markdown table.
std::string cell(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

/// Calls visit.operator()<S>() for all shapes of scene files, and for planes, which are objects'
/// only.
template <class Visit>
void for_each_listed_shape(Visit&& visit) {
  for_each_alternative(std::type_identity<ShapeVariant>(), visit);
  visit.template operator()<HalfSpaceDescription>();
}

template <class S>
Json tagged_json(const S& described) {
  Json json = {{"type", std::string(S::name)}};
  write_members(json, described);
  return json;
}

}  // namespace

std::string info_as_json(const Scene& scene, Json model, Json meshes, Json other_models) {
  const SceneSummary summary = summarise(scene);
  Json json;
  json["description"] = scene.description;
  if (!model.is_null()) json["model"] = std::move(model);
  if (!other_models.empty()) json["other_models"] = std::move(other_models);
  json["objects"] = summary.instances;
  json["particles"] = summary.particles;
  json["shapes"] = Json::object();
  for (const KindCount& kind : summary.kinds) {
    json["shapes"][std::string(kind.name)] = {{"objects", kind.objects},
                                              {"operands", kind.operands}};
  }
  json["hull_points"] = summary.hull_points;
  if (!meshes.is_null()) json["meshes"] = std::move(meshes);
  json["bytes"] = summary.bytes;
  const World world = make_world(scene);
  json["world_bytes"] = world.bytes();
  json["hierarchy_bytes"] = world.bvh().bytes();
  json["bounds"] = nullptr;
  if (!summary.bounds.empty()) {
    json["bounds"] = {{"lower", to_json(summary.bounds.lower)},
                      {"upper", to_json(summary.bounds.upper)}};
  }
  json["materials"] = Json::array();
  for (const Material& material : scene.materials) {
    Json described = std::visit([](const auto& kind) { return tagged_json(kind); }, material.kind);
    described["name"] = material.name;
    json["materials"].push_back(std::move(described));
  }
  json["lights"] = Json::array();
  for (const Light& light : scene.lights) {
    json["lights"].push_back(std::visit([](const auto& kind) { return tagged_json(kind); }, light));
  }
  json["camera"] = Json::object();
  write_members(json["camera"], scene.camera);
  return pretty(json);
}

std::string info_as_text(const Scene& scene) {
  const SceneSummary summary = summarise(scene);
  std::string text;
  if (!scene.description.empty()) text += line("scene", printable(scene.description, 400));
  text += line("objects", std::to_string(summary.instances));
  if (summary.particles > 0)
    text += line("", std::to_string(summary.particles) + " of them particles");
  for (const KindCount& kind : summary.kinds) {
    std::string count;
    if (kind.objects > 0) count = std::to_string(kind.objects) + " " + std::string(kind.name);
    if (kind.operands > 0)
      count += (count.empty() ? std::to_string(kind.operands) + " " + std::string(kind.name)
                              : ", and " + std::to_string(kind.operands)) +
               " inside other shapes";
    text += line("", count);
  }
  if (summary.hull_points > 0) text += line("hull points", std::to_string(summary.hull_points));
  if (!summary.bounds.empty()) {
    text += line("bounds", text_of(summary.bounds.lower) + " to " + text_of(summary.bounds.upper));
  }
  // Memory of the scene as read, and of the structures for rays.
  const World world = make_world(scene);
  const auto per_object = [&](std::size_t bytes) {
    const std::size_t objects = std::max<std::size_t>(summary.instances, 1);
    return std::to_string((bytes + objects / 2) / objects);
  };
  text +=
      line("memory", "scene " + bytes_text(summary.bytes) + ", world " + bytes_text(world.bytes()));
  text += line("an object", per_object(summary.bytes) + " bytes in the scene, " +
                                per_object(world.instances().bytes()) + " posed, " +
                                per_object(world.bvh().bytes()) + " in the hierarchy");
  for (const Material& material : scene.materials) {
    text += line(
        "material",
        printable(material.name, 60) + ": " +
            std::visit([](const auto& kind) { return tagged_json(kind).dump(); }, material.kind));
  }
  for (const Light& light : scene.lights) {
    text +=
        line("light", std::visit([](const auto& kind) { return tagged_json(kind).dump(); }, light));
  }
  const CameraDescription& camera = scene.camera;
  text += line("camera", "at " + text_of(camera.position) + ", looks at " +
                             text_of(camera.look_at) + ", " + text_of(camera.fov_y_degrees) +
                             " degrees high, " + std::to_string(camera.resolution.width) + "x" +
                             std::to_string(camera.resolution.height) + " pixels");
  return text;
}

std::string shapes_as_json() {
  Json shapes = Json::array();
  for_each_listed_shape([&]<class S>() {
    Json parameters = Json::array();
    for_each_description<S>([&](const Parameter& parameter, const MemberDescription& member) {
      parameters.push_back({{"keys", member.keys},
                            {"value", member.value},
                            {"unit", std::string(name_of(parameter.unit))},
                            {"constraint", std::string(constraint(parameter.range))},
                            {"optional", parameter.optional},
                            {"doc", std::string(parameter.doc)}});
    });
    shapes.push_back({{"name", std::string(S::name)},
                      {"doc", std::string(S::doc)},
                      {"parameters", std::move(parameters)}});
  });
  return pretty(shapes);
}

std::string shapes_as_text() {
  std::string text;
  for_each_listed_shape([&]<class S>() {
    text += std::string(S::name) + ": " + std::string(S::doc) + "\n";
    for_each_description<S>([&](const Parameter& parameter, const MemberDescription& member) {
      text += "    " + member.keys + ": " + member.value;
      if (parameter.range != Range::any) text += " " + constraint_text(parameter);
      if (parameter.unit != Unit::none) text += " (" + unit_text(parameter) + ")";
      if (parameter.optional) text += ", optional";
      text += "; " + std::string(parameter.doc) + "\n";
    });
  });
  return text;
}

std::string shapes_as_markdown() {
  std::string text =
      "| shape | parameter | value | unit | constraint | meaning |\n"
      "|---|---|---|---|---|---|\n";
  for_each_listed_shape([&]<class S>() {
    text += "| `" + std::string(S::name) + "` | | | | | " + cell(S::doc) + " |\n";
    for_each_description<S>([&](const Parameter& parameter, const MemberDescription& member) {
      text += "| | " + member.keys + (parameter.optional ? " (optional)" : "") + " | " +
              member.value + " | " + unit_text(parameter) + " | " + constraint_text(parameter) +
              " | " + cell(parameter.doc) + " |\n";
    });
  });
  return text;
}

std::string schema_text() {
  return pretty(scene_schema());
}

}  // namespace minkray
