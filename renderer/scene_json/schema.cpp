// SPDX-License-Identifier: MIT
#include "renderer/scene_json/schema.h"

#include "core/support/named_kind.h"
#include "renderer/member_json/member_codec.h"
#include "renderer/member_json/read_colour.h"
#include "renderer/member_json/read_rotation.h"
#include "renderer/member_json/shape_json.h"
#include "renderer/member_json/tagged_json.h"
#include "renderer/scene/member_keys.h"
#include "renderer/scene/particles.h"
#include "renderer/scene_json/half_space_json.h"
#include "renderer/scene_json/read_split.h"
#include "renderer/scene_json/read_visible_to.h"
#include "renderer/scene_json/scene_json.h"
#include "renderer/scene_json/version_one.h"

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

/// Schema of one of several described structs. `amend(schema of S's object)` adds keys that are not
/// parameters.
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

/// Schema of the keys of a described struct: its parameters that can change.
template <class S>
Json keys_schema(bool has_intensity) {
  Json key = object_schema("Values at a time; linear between keys.");
  key["properties"]["time"] = {{"type", "number"}, {"description", "in seconds"}};
  for_each_field<S>([&](const auto& field) {
    using M = typename std::remove_cvref_t<decltype(field)>::Member;
    if constexpr (can_be_keyed<M>) {
      if (keeps_still(field.name)) return;
      const MemberDescription member = MemberCodec<M>::describe(parameter_of(field));
      for (const Json::Member& property : member.properties.members())
        key["properties"][property.key] = property.value;
    }
  });
  if (has_intensity) key["properties"]["intensity"] = schema_of_number(Range::brightness);
  key["required"] = {"time"};
  return {{"type", "array"}, {"items", std::move(key)}, {"minItems", 1}};
}

/// Keys that version 1 requires and later versions do not. Keys of later versions are rejected when
/// a file is read.
Json version_one_schema() {
  Json schema;
  schema["required"] = {"camera", "lights", "materials", "objects"};
  schema["properties"]["camera"] = {{"required", {"position", "look_at"}}};
  schema["properties"]["objects"] = {{"items", {{"required", {"name", "material"}}}}};
  for (const auto& [of, in, key] : later_keys) {
    Json& holder = of == LaterKey::Of::file ? schema : schema["properties"][in];
    Json& keyed = of == LaterKey::Of::items ? holder["items"] : holder;
    keyed["properties"][key] = false;
  }
  return schema;
}

Json described_object(Json schema, auto add) {
  add(schema);
  return schema;
}

}  // namespace

Json scene_schema() {
  const Json text = {{"type", "string"}};
  const Json name = {{"type", "string"}, {"minLength", 1}};
  const Json include = {{"description", "scene files to include, relative to this one"},
                        {"oneOf", Json::array({name, {{"type", "array"}, {"items", name}}})}};
  const Json colour = colour_schema(Range::brightness);
  const Json background =
      described_object(object_schema(Background::doc), [](Json& o) { add_members<Background>(o); });

  Json object = object_schema("An object of the scene.");
  object["properties"] = {
      {"name", name},
      {"shape",
       {{"anyOf", Json::array({{{"$ref", "#/$defs/shape"}}, {{"$ref", "#/$defs/half_space"}}})}}},
      {"mesh", {{"$ref", "#/$defs/mesh"}}},
      {"height_field", {{"$ref", "#/$defs/height_field"}}},
      {"material", name},
      {"color",
       {{"oneOf",
         Json::array({colour_schema(Range::zero_to_one), {{"$ref", "#/$defs/texture"}}})}}},
      {"transform", {{"$ref", "#/$defs/transform"}}},
      {"pivot", schema_of_list({{"type", "number"}}, 3)},
      {"visible_to", visible_to_schema()},
      {"split",
       {{"description",
         "one object per part of the shape's mesh file: its named parts, or its connected "
         "components"},
        {"enum", names_in(mesh_splits_of_files)}}},
      {"keys",
       {{"type", "array"},
        {"description", "poses at increasing times"},
        {"items", {{"$ref", "#/$defs/key"}}},
        {"minItems", 1}}}};
  object["properties"]["color"]["description"] =
      "instead of a material: a diffuse one of this colour";
  object["properties"]["pivot"]["description"] =
      "the pivot of its keys, in the frame around it; by default its origin";
  object["not"] = {{"required", {"material", "color"}}};
  object["oneOf"] = Json::array(
      {{{"required", {"shape"}}}, {{"required", {"mesh"}}}, {{"required", {"height_field"}}}});

  Json key = object_schema(
      "Pose of an object at a time: rotated about its origin and translated, relative to its "
      "transform (version 1: about the world's origin, after its transform).");
  key["properties"] = {{"time", {{"type", "number"}, {"description", "in seconds"}}},
                       {"translate", schema_of_list({{"type", "number"}}, 3)},
                       {"rotate", {{"$ref", "#/$defs/rotation"}}}};
  key["properties"]["rotate"]["description"] = "relative to its transform";
  key["required"] = {"time"};

  std::string column_docs = "the meaning of each row's numbers, in order";
  for (const ParticleColumnDescription& column : particle_columns)
    column_docs += "; " + std::string(column.name) + ": " + std::string(column.doc);
  Json particles = object_schema("One shape with many poses.");
  particles["properties"] = {
      {"name", name},
      {"shape", {{"$ref", "#/$defs/shape"}}},
      {"columns",
       {{"type", "array"},
        {"description", column_docs},
        {"items", {{"enum", names_in(particle_columns)}}},
        {"contains", {{"const", "position"}}},
        {"uniqueItems", true}}},
      {"material", name},
      {"materials", {{"type", "array"}, {"items", name}, {"minItems", 1}}},
      {"visible_to", visible_to_schema()},
      {"count", {{"type", "integer"}, {"minimum", 1}, {"description", "the number of rows"}}},
      {"poses",
       {{"type", "array"},
        {"items", {{"type", "array"}, {"items", {{"type", "number"}}}}},
        {"minItems", 1}}},
      {"file",
       {{"type", "string"},
        {"pattern", "\\.(csv|f32|f64)$"},
        {"description", "the file of the rows"}}}};
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
      {"version", {{"enum", Json::array({scene_version, newest_scene_version})}}},
      {"description", text},
      {"labels", {{"type", "boolean"}, {"description", "draw the objects' names"}}},
      {"camera", {{"$ref", "#/$defs/camera"}}},
      {"lights", list_of("light")},
      {"materials", list_of("material")},
      {"include", include},
      {"objects", {{"$ref", "#/$defs/objects"}}},
      {"particles", list_of("particles")},
      {"background", {{"oneOf", {colour, background}}}}};
  schema["required"] = {"version"};
  const Json of_version_one = {{"properties", {{"version", {{"const", scene_version}}}}}};
  schema["if"] = of_version_one;
  schema["then"] = version_one_schema();

  Json& definitions = schema["$defs"];
  definitions["camera"] = described_object(object_schema(CameraDescription::doc), [](Json& o) {
    add_members<CameraDescription>(o);
    o["required"] = Json::array();  // version_one_schema() has those of version 1
    o["properties"]["keys"] = keys_schema<CameraDescription>(false);
  });
  definitions["rotation"] = rotation_schema();
  definitions["objects"] = {
      {"type", "array"},
      {"items",
       {{"anyOf", Json::array({{{"$ref", "#/$defs/object"}}, {{"$ref", "#/$defs/group"}}})}}}};
  Json group = object_schema("Objects in one frame, from a file or listed here.");
  group["properties"] = {{"name", text},
                         {"transform", {{"$ref", "#/$defs/transform"}}},
                         {"include", name},
                         {"objects", {{"$ref", "#/$defs/objects"}}}};
  group["properties"]["name"]["description"] = "prefix of its objects' names, with a slash";
  group["properties"]["include"]["description"] =
      "a scene file, relative to this one: its materials and objects";
  group["anyOf"] = Json::array({{{"required", {"include"}}}, {{"required", {"objects"}}}});
  definitions["group"] = std::move(group);
  definitions["light"] = tagged_schema<Light>("A light.", []<class S>(Json& light) {
    light["properties"]["intensity"] = schema_of_number(Range::brightness);
    light["properties"]["intensity"]["description"] = "multiplies its colours";
    light["properties"]["keys"] = keys_schema<S>(true);
  });
  definitions["material"] =
      tagged_schema<MaterialKind>("A material.", [&]<class S>(Json& material) {
        material["properties"]["name"] = name;
        material["required"].push_back("name");
        add_members<Relief>(material);
        material["properties"]["visible_to"] = visible_to_schema();
        material["properties"]["keys"] = keys_schema<S>(false);
      });
  definitions["texture"] = tagged_schema<TextureKind>("A texture.", []<class S>(Json&) {});
  definitions["object"] = std::move(object);
  Json half_space = object_schema(HalfSpaceDescription::doc);
  half_space["properties"]["type"] = {{"const", std::string(half_space_name)}};
  half_space["required"] = {"type"};
  add_members<HalfSpaceDescription>(half_space);
  definitions["half_space"] = std::move(half_space);
  definitions["mesh"] = mesh_schema();
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
  terrain["properties"]["bottom"]["description"] = "the z of a bottom that closes it, with walls";
  terrain["required"] = {"size"};
  terrain["oneOf"] = Json::array({{{"required", {"file"}}}, {{"required", {"heights"}}}});
  definitions["height_field"] = std::move(terrain);
  definitions["key"] = std::move(key);
  definitions["particles"] = std::move(particles);
  definitions["transform"] =
      described_object(object_schema("Pose of an object."), [](Json& transform) {
        const auto pose = MemberCodec<AffineMap>::describe(Parameter());
        transform["properties"] = pose.properties;
        transform["allOf"] = pose.allowed;
      });
  definitions["shape"] = tagged_schema<ShapeVariant>(
      "A convex shape.", []<class S>(Json& shape) { allow_list_of_operands<S>(shape); });
  return schema;
}

}  // namespace minkray
