// SPDX-License-Identifier: MIT
#include "renderer/cli/words_meant.h"

#include <algorithm>
#include <optional>
#include <span>

#include "renderer/json/closest_word.h"

namespace minkray {
namespace {

/// A word of other programs, and its equivalent here.
struct Meaning {
  std::string_view typed, name, rest = "";
};

constexpr Meaning commands_elsewhere[] = {{"draw", "render"},
                                          {"view", "render", " with --preview"},
                                          {"show", "render", " with --preview"},
                                          {"trace-scene", "render"},
                                          {"convert", "import"},
                                          {"load", "info"},
                                          {"lidar", "scan"},
                                          {"ray", "cast"},
                                          {"raycast", "cast"},
                                          {"query", "cast"},
                                          {"shapes", "info", " --shapes"},
                                          {"schema", "info", " --schema"},
                                          {"collide", "clearance"},
                                          {"collision", "clearance"},
                                          {"sdf", "field"},
                                          {"benchmark", "heatmap"},
                                          {"version", "--version"},
                                          {"-v", "--version"},
                                          {"-V", "--version"},
                                          {"-version", "--version"},
                                          {"-help", "help"},
                                          {"-?", "help"},
                                          {"--list", "help"}};

constexpr Meaning options_elsewhere[] = {{"--samples", "--spp", " N"},
                                         {"--sample", "--spp", " N"},
                                         {"--width", "--resolution", " WIDTHxHEIGHT"},
                                         {"--height", "--resolution", " WIDTHxHEIGHT"},
                                         {"--size", "--resolution", " WIDTHxHEIGHT"},
                                         {"--res", "--resolution", " WIDTHxHEIGHT"},
                                         {"-w", "--resolution", " WIDTHxHEIGHT"},
                                         {"-n", "--spp", " N"},
                                         {"-j", "--threads", " N"},
                                         {"--jobs", "--threads", " N"},
                                         {"--out", "--output", " FILE"},
                                         {"--out-file", "--output", " FILE"},
                                         {"--region", "--crop", " X0,Y0,X1,Y1"},
                                         {"--roi", "--crop", " X0,Y0,X1,Y1"},
                                         {"--depth", "--max-depth", " N"},
                                         {"--gamma", "--tonemap"},
                                         {"--frame", "--frames", " A..B"},
                                         {"--fps", "--rate", " N"},
                                         {"--passes", "--aov", " NAMES"},
                                         {"--viewer", "--preview"},
                                         {"--view", "--preview"},
                                         {"--package-path", "--package-dir", " FOLDER"},
                                         {"--pose", "--joint", " NAME=VALUE"},
                                         {"--sensor", "--pattern"},
                                         {"--obstacles", "--obstacle", " FILE"}};

/// Options that no command has, since the scene contains them.
constexpr Meaning of_the_scene[] = {
    {"--camera", "\"camera\": {\"position\": [x, y, z], \"look_at\": [x, y, z]}"},
    {"--position", "\"camera\": {\"position\": [x, y, z], \"look_at\": [x, y, z]}"},
    {"--look-at", "\"camera\": {\"position\": [x, y, z], \"look_at\": [x, y, z]}"},
    {"--lookat", "\"camera\": {\"position\": [x, y, z], \"look_at\": [x, y, z]}"},
    {"--fov", "\"camera\": {\"fov_y_degrees\": 40, ...}"},
    {"--background", "\"background\": [red, green, blue]"},
    {"--light", "\"lights\": [{\"type\": \"point\", ...}]"},
    {"--material", "\"materials\": [{\"name\": ..., \"type\": ...}]"}};

constexpr Meaning values_elsewhere[] = {
    {"aces", "filmic"},       {"reinhard", "filmic"},  {"linear", "srgb"},
    {"none", "srgb"},         {"depth", "Z"},          {"z", "Z"},
    {"distance", "dist"},     {"normal", "N"},         {"normals", "N"},
    {"position", "P"},        {"points", "P"},         {"diffuse", "albedo"},
    {"color", "albedo"},      {"id", "object"},        {"ids", "object"},
    {"objects", "object"},    {"mask", "cryptomatte"}, {"masks", "cryptomatte"},
    {"velocity", "motion"},   {"flow", "motion"},      {"pathtracing", "path"},
    {"path-tracing", "path"}, {"pt", "path"},          {"ao", "ambient"},
    {"gjk", "paper"},         {"fast", "speed"},       {"single", "float"},
    {"float32", "float"},     {"float64", "double"}};

/// Returns the equivalent of another program's word, if it is among the names.
std::optional<std::string> elsewhere(std::span<const Meaning> meanings, std::string_view typed,
                                     const std::vector<std::string>& names) {
  for (const Meaning& one : meanings)
    if (one.typed == typed && std::ranges::find(names, one.name) != names.end())
      return std::string(one.name) + std::string(one.rest);
  return std::nullopt;
}

std::string meant(std::span<const Meaning> meanings, std::string_view typed,
                  const std::vector<std::string>& names) {
  std::optional<std::string> word = elsewhere(meanings, typed, names);
  if (!word) word = closest_word(typed, names);
  if (!word) {
    // Words of other programs may be mistyped, too.
    std::vector<std::string> others;
    for (const Meaning& one : meanings) others.emplace_back(one.typed);
    if (const auto closest = closest_word(typed, others))
      word = elsewhere(meanings, *closest, names);
  }
  return word ? "did you mean `" + *word + "`?" : "";
}

}  // namespace

std::string command_meant(std::string_view typed, const std::vector<std::string>& commands) {
  return meant(commands_elsewhere, typed, commands);
}

std::string option_meant(std::string_view typed, const std::vector<std::string>& options) {
  for (const Meaning& one : of_the_scene)
    if (one.typed == typed) return "set it in the scene file: " + std::string(one.name);
  return meant(options_elsewhere, typed, options);
}

std::string value_meant(std::string_view typed, const std::vector<std::string>& values) {
  return meant(values_elsewhere, typed, values);
}

}  // namespace minkray
