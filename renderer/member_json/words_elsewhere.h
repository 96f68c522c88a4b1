// SPDX-License-Identifier: MIT
// Words of other programs for what scene files call by another name.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/json/object_reader.h"

namespace minkray {

struct WordElsewhere {
  std::string_view word;
  std::string_view name;          ///< in Minkray; distinguishes shapes, materials and lights
  std::string_view instead = "";  ///< text to write, if the name alone is not enough
};

inline constexpr WordElsewhere words_elsewhere[] = {
    {"cube", "box"},
    {"cuboid", "box"},
    {"block", "box"},
    {"ball", "sphere"},
    {"pyramid", "hull", "use \"hull\" with the five corners as \"points\""},
    {"mesh", "hull", "an object has a \"mesh\" instead of a \"shape\"; \"hull\" is convex"},
    {"polyhedron", "hull"},
    {"convex", "hull"},
    {"torus", "hull", "a torus is not convex: use a \"mesh\", or several capsules"},
    {"union", "hull_of", "shapes are convex: a union is several objects, or \"hull_of\" them"},
    {"plane", "hull",
     "a plane is unbounded, so it cannot be an operand; an object's shape may be one"},
    {"half_space", "plane"},
    {"halfspace", "plane"},
    {"ground", "plane"},
    {"floor", "plane"},
    {"area light", "emissive"},
    {"area_light", "emissive"},
    {"area", "emissive"},
    {"glass", "dielectric"},
    {"water", "dielectric"},
    {"metal", "conductor"},
    {"mirror", "conductor"},
    {"gold", "conductor"},
    {"plastic", "glossy"},
    {"phong", "glossy"},
    {"diffuse", "lambert"},
    {"matte", "lambert"},
    {"pbr", "principled"},
    {"disney", "principled"},
    {"emission", "emissive"},
    {"emitter", "emissive"},
    {"light", "emissive"},
    {"area light", "point", "an area light is an object with an \"emissive\" material"},
    {"area_light", "point", "an area light is an object with an \"emissive\" material"},
    {"rect", "point", "an area light is an object with an \"emissive\" material"},
    {"sphere", "point", "an area light is an object with an \"emissive\" material"},
    {"area", "point", "an area light is an object with an \"emissive\" material"},
    {"spot", "point",
     "there are no spot lights: use \"point\", or an object with an \"emissive\" material"},
    {"sun", "directional", "use \"directional\", or \"sun_sky\" for a sun in its sky"},
    {"distant", "directional"},
    {"ambient", "environment"},
    {"sky", "environment", "use \"environment\", or \"sun_sky\" for the sky of a day"},
    {"hdri", "environment", "use \"environment\" with the picture as its \"file\""},
};

/// Returns the likely meaning of an unknown name.
inline std::string name_meant(const std::string& written, const std::vector<std::string>& names) {
  for (const WordElsewhere& one : words_elsewhere)
    if (one.word == written && std::ranges::find(names, one.name) != names.end())
      return one.instead.empty() ? "did you mean \"" + std::string(one.name) + "\"?"
                                 : std::string(one.instead);
  return suggestion(written, names);
}

}  // namespace minkray
