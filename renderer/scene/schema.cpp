// SPDX-License-Identifier: MIT
#include "renderer/scene/schema.h"

#include "renderer/scene/describe_member.h"
#include "renderer/scene/particles.h"
#include "renderer/scene/read_split.h"
#include "renderer/scene/read_visible_to.h"
#include "renderer/scene/scene_json.h"
#include "renderer/scene/shape_json.h"
#include "renderer/scene/tagged_json.h"

namespace minkray {
namespace {

/// An object that has no keys but the given ones.
Json object_schema(std::string_view doc) {
  return {{"type", "object"},
          {"description", std::string(doc)},
          {"properties", Json::object()},
          {"required", Json::array()},
          {"additionalProperties", false}};
}

/// Adds the parameters of a described struct to the schema of its object.
template <class S>
void add_members(Json& object) {
  for_each_description<S>([&](const Parameter&, const MemberDescription& member) {
    for (const Json::Member& property : member.properties.members()) {
      object["properties"][property.key] = property.value;
    }
    for (const Json& condition : member.allowed) {
      if (condition.contains("required")) {
        object["required"].push_back(condition["required"][0]);
      } else {
        object["allOf"].push_back(condition);
      }
    }
  });
}

/// The schema of one of several described structs; `amend(schema of S's object)` adds what they
/// have beside their own parameters.
template <class Variant, class Amend>
Json tagged_schema(std::string_view doc, Amend&& amend) {
  Json any_of = Json::array();
  for_each_alternative(std::type_identity<Variant>(), [&]<class S>() {
    Json object = object_schema(S::doc);
    object["properties"]["type"] = {{"const", std::string(S::name)}};
    object["required"].push_back("type");
    add_members<S>(object);
    amend.template operator()<S>(object);
    any_of.push_back(std::move(object));
  });
  return {{"description", std::string(doc)}, {"oneOf", std::move(any_of)}};
}

/// A shape with several operands of their own names takes them as a list, too.
template <class S>
void allow_list_of_operands(Json& object) {
  constexpr std::size_t count = operand_count<S>();
  if constexpr (takes_list_of_operands<S>()) {
    Json names = Json::array();
    for_each_field<S>([&](const auto& field) { names.push_back(std::string(field.name)); });
    object["properties"]["shapes"] = schema_of_list({{"$ref", "#/$defs/shape"}}, count);
    object["required"] = {"type"};
    object["allOf"].push_back(
        {{"oneOf", Json::array({{{"required", names}}, {{"required", {"shapes"}}}})}});
  }
}

Json list_of(const char* definition) {
  return {{"type", "array"}, {"items", {{"$ref", std::string("#/$defs/") + definition}}}};
}

Json described_object(Json schema, auto add) {
  add(schema);
  return schema;
}

}  // namespace

Json scene_schema() {
  const Json text = {{"type", "string"}};
  const Json name = {{"type", "string"}, {"minLength", 1}};
  const Json colour = schema_of_list(schema_of_number(Range::brightness), 3);
  const Json background =
      described_object(object_schema(Background::doc), [](Json& o) { add_members<Background>(o); });

  Json object = object_schema("A thing in the scene.");
  Json split_names = Json::array();
  for (const MeshSplitName& split : mesh_split_names)
    split_names.push_back(std::string(split.name));
  object["properties"] = {
      {"name", name},
      {"shape",
       {{"anyOf", Json::array({{{"$ref", "#/$defs/shape"}}, {{"$ref", "#/$defs/half_space"}}})}}},
      {"mesh", {{"$ref", "#/$defs/mesh"}}},
      {"height_field", {{"$ref", "#/$defs/height_field"}}},
      {"material", name},
      {"transform", {{"$ref", "#/$defs/transform"}}},
      {"visible_to", visible_to_schema()},
      {"split",
       {{"description",
         "makes an object of each part of the shape's mesh file: the parts that it names, or those "
         "that hang together"},
        {"enum", split_names}}},
      {"keys",
       {{"type", "array"},
        {"description", "where it is when, with rising times"},
        {"items", {{"$ref", "#/$defs/key"}}},
        {"minItems", 1}}}};
  object["required"] = {"name", "material"};
  object["oneOf"] = Json::array(
      {{{"required", {"shape"}}}, {{"required", {"mesh"}}}, {{"required", {"height_field"}}}});

  Json key = object_schema("Where an object is at a time, after its transform.");
  key["properties"] = {{"time", {{"type", "number"}, {"description", "in seconds"}}},
                       {"translate", schema_of_list({{"type", "number"}}, 3)},
                       {"rotate", schema_of_list({{"type", "number"}}, 4)}};
  key["properties"]["rotate"]["description"] = "a quaternion [x, y, z, w] of any length but zero";
  key["required"] = {"time"};

  Json column_names = Json::array();
  std::string column_docs = "what each row's numbers are, in their order";
  for (const ParticleColumnDescription& column : particle_columns) {
    column_names.push_back(std::string(column.name));
    column_docs += "; " + std::string(column.name) + ": " + std::string(column.doc);
  }
  Json particles = object_schema("One shape, posed many times.");
  particles["properties"] = {
      {"name", name},
      {"shape", {{"$ref", "#/$defs/shape"}}},
      {"columns",
       {{"type", "array"},
        {"description", column_docs},
        {"items", {{"enum", column_names}}},
        {"contains", {{"const", "position"}}},
        {"uniqueItems", true}}},
      {"material", name},
      {"materials", {{"type", "array"}, {"items", name}, {"minItems", 1}}},
      {"visible_to", visible_to_schema()},
      {"count", {{"type", "integer"}, {"minimum", 1}, {"description", "how many rows there are"}}},
      {"poses",
       {{"type", "array"},
        {"items", {{"type", "array"}, {"items", {{"type", "number"}}}}},
        {"minItems", 1}}},
      {"file",
       {{"type", "string"}, {"pattern", "\\.(csv|f32|f64)$"}, {"description", "holds the rows"}}}};
  particles["required"] = {"name", "shape"};
  particles["allOf"] = Json::array(
      {{{"oneOf", Json::array({{{"required", {"poses"}}}, {{"required", {"file"}}}})}},
       {{"oneOf", Json::array({{{"required", {"material"}}}, {{"required", {"materials"}}}})}}});

  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                 {"title", "Minkray scene"}};
  const Json of_object = object_schema("Shapes, their materials, lights, and a camera.");
  for (const auto& [keyword, value] : of_object.members()) schema[keyword] = value;
  schema["properties"] = {
      {"$schema", text},
      {"version", {{"const", scene_version}}},
      {"description", text},
      {"labels", {{"type", "boolean"}, {"description", "draw the objects' names"}}},
      {"camera", {{"$ref", "#/$defs/camera"}}},
      {"lights", list_of("light")},
      {"materials", list_of("material")},
      {"objects", list_of("object")},
      {"particles", list_of("particles")},
      {"background", {{"oneOf", {colour, background}}}}};
  schema["required"] = {"version", "camera", "lights", "materials", "objects"};

  Json& definitions = schema["$defs"];
  definitions["camera"] = described_object(object_schema(CameraDescription::doc),
                                           [](Json& o) { add_members<CameraDescription>(o); });
  definitions["light"] = tagged_schema<Light>("A light.", []<class S>(Json& light) {
    light["properties"]["intensity"] = schema_of_number(Range::brightness);
    light["properties"]["intensity"]["description"] = "multiplies its colours";
  });
  definitions["material"] =
      tagged_schema<MaterialKind>("A material.", [&]<class S>(Json& material) {
        material["properties"]["name"] = name;
        material["required"].push_back("name");
        add_members<Relief>(material);
        material["properties"]["visible_to"] = visible_to_schema();
      });
  definitions["texture"] = tagged_schema<TextureKind>("A texture.", []<class S>(Json&) {});
  definitions["object"] = std::move(object);
  Json half_space = object_schema("All points x with normal . x <= offset: a plane, solid below.");
  half_space["properties"] = {{"type", {{"const", std::string(half_space_name)}}},
                              {"normal", schema_of_list({{"type", "number"}}, 3)},
                              {"offset", {{"type", "number"}}}};
  half_space["properties"]["normal"]["description"] =
      "of any length but zero; [0, 0, 1] if left out";
  half_space["properties"]["offset"]["description"] = "along the normal, as if that had length 1";
  half_space["required"] = {"type"};
  definitions["half_space"] = std::move(half_space);
  Json mesh = object_schema("Triangles as they are: of a file, or of vertices.");
  mesh["properties"] = {
      {"file", {{"type", "string"}}},
      {"scale", schema_of_number(Range::positive)},
      {"vertices",
       {{"type", "array"}, {"items", schema_of_list({{"type", "number"}}, 3)}, {"minItems", 3}}},
      {"triangles",
       {{"type", "array"},
        {"items", schema_of_list({{"type", "integer"}, {"minimum", 0}}, 3)},
        {"minItems", 1}}},
      {"sides", {{"enum", Json::array({"both", "front"})}}}};
  mesh["properties"]["sides"]["description"] =
      "from where rays meet the triangles; \"front\" if all lie in one plane and look the same way";
  mesh["properties"]["file"]["description"] = "of OBJ or STL, relative to the scene's folder";
  mesh["properties"]["scale"]["description"] = "what multiplies the file's coordinates";
  mesh["properties"]["triangles"]["description"] =
      "three numbers of vertices each, from 0 on, counter-clockwise as seen from outside";
  mesh["oneOf"] =
      Json::array({{{"required", {"file"}}}, {{"required", {"vertices", "triangles"}}}});
  definitions["mesh"] = std::move(mesh);
  Json terrain = object_schema("A terrain: heights over a grid with its middle above the origin.");
  terrain["properties"] = {
      {"file", {{"type", "string"}}},
      {"heights",
       {{"type", "array"},
        {"items", {{"type", "array"}, {"items", {{"type", "number"}}}, {"minItems", 2}}},
        {"minItems", 2}}},
      {"size",
       {{"type", "array"},
        {"items", schema_of_number(Range::positive)},
        {"minItems", 2},
        {"maxItems", 3}}},
      {"bottom", {{"type", "number"}}}};
  terrain["properties"]["file"]["description"] = "a picture, relative to the scene's folder";
  terrain["properties"]["heights"]["description"] = "rows along x, the one of the least y first";
  terrain["properties"]["size"]["description"] =
      "along x and along y; with a file also the height of white";
  terrain["properties"]["bottom"]["description"] = "the z at which walls and a bottom close it";
  terrain["required"] = {"size"};
  terrain["oneOf"] = Json::array({{{"required", {"file"}}}, {{"required", {"heights"}}}});
  definitions["height_field"] = std::move(terrain);
  definitions["key"] = std::move(key);
  definitions["particles"] = std::move(particles);
  definitions["transform"] =
      described_object(object_schema("Where an object stands."), [](Json& transform) {
        const auto pose = describe(Parameter(), Member<AffineMap<double>>());
        transform["properties"] = pose.properties;
        transform["allOf"] = pose.allowed;
      });
  definitions["shape"] = tagged_schema<ShapeVariant<double>>(
      "A convex shape.", []<class S>(Json& shape) { allow_list_of_operands<S>(shape); });
  return schema;
}

}  // namespace minkray
