// SPDX-License-Identifier: MIT
#include "renderer/member_json/member_codec.h"
#include "renderer/scene_json/schema.h"

namespace minkray {
namespace {

Json list_of(const Json& item, std::size_t least = 1) {
  return {{"type", "array"}, {"items", item}, {"minItems", least}};
}

Json or_null(const Json& schema) {
  return {{"oneOf", Json::array({schema, {{"type", "null"}}})}};
}

}  // namespace

Json mesh_schema() {
  const Json number = {{"type", "integer"}, {"minimum", 0}}, numbers = schema_of_list(number, 3),
             name = {{"type", "string"}, {"minLength", 1}},
             vectors = list_of(schema_of_list({{"type", "number"}}, 3));
  Json mesh = {{"type", "object"},
               {"description", "Triangles of a file, or listed here."},
               {"required", Json::array()},
               {"additionalProperties", false}};
  Json& properties = mesh["properties"] = Json::object();
  const auto add = [&](const char* key, Json schema, const char* description) {
    schema["description"] = description;
    properties[key] = std::move(schema);
  };
  add("file", {{"type", "string"}}, "an OBJ or STL file, relative to the scene's folder");
  add("scale", schema_of_number(Range::positive), "a factor of the file's coordinates");
  add("vertices", list_of(schema_of_list({{"type", "number"}}, 3), 3), "points");
  add("triangles", list_of(numbers),
      "three numbers of vertices each, from 0 on, counter-clockwise as seen from outside");
  add("sides", {{"enum", Json::array({"both", "front"})}},
      "the sides that rays hit; \"front\" only if all triangles lie in one plane and face the same "
      "way");
  add("smooth",
      {{"oneOf", Json::array({{{"type", "boolean"}},
                              {{"type", "number"}, {"exclusiveMinimum", 0}, {"maximum", 180}}})}},
      "smooth shading by mean vertex normals: at all edges, or up to an angle between triangles in "
      "degrees; false: flat, without the file's normals");
  add("normals", vectors,
      "for shading: directions, one per vertex or as \"normal_triangles\" says");
  add("normal_triangles", list_of(or_null(numbers)), "three numbers of normals per triangle");
  add("uv", list_of(schema_of_list({{"type", "number"}}, 2)),
      "texture coordinates from the picture's top left, one per vertex or as \"uv_triangles\" "
      "says");
  add("uv_triangles", list_of(or_null(numbers)), "three numbers of coordinates per triangle");
  add("materials",
      {{"oneOf",
        Json::array({list_of(name), {{"type", "object"}, {"additionalProperties", name}}})}},
      "names of materials for \"material_of\"; with a file: replacements of its materials");
  add("material_of", list_of(or_null(number)),
      "per triangle the number of one of the materials; null: the object's");
  mesh["oneOf"] =
      Json::array({{{"required", {"file"}}}, {{"required", {"vertices", "triangles"}}}});
  return mesh;
}

}  // namespace minkray
