// SPDX-License-Identifier: MIT
#include "renderer/member_json/describe_member.h"

#include "renderer/json/values.h"
#include "renderer/member_json/read_colour.h"

namespace minkray {
namespace {

Json reference(const char* definition) {
  return {{"$ref", std::string("#/$defs/") + definition}};
}

Json must_have(std::initializer_list<std::string_view> keys) {
  Json names = Json::array();
  for (const std::string_view key : keys) names.push_back(std::string(key));
  return {{"required", std::move(names)}};
}

Json either(Json a, Json b) {
  return {{"oneOf", Json::array({std::move(a), std::move(b)})}};
}

/// A parameter that is one key of its own name.
MemberDescription one_key(const Parameter& parameter, std::string value, Json schema) {
  schema["description"] = std::string(parameter.doc);
  MemberDescription description;
  description.keys = std::string(parameter.name);
  description.value = std::move(value);
  description.properties[description.keys] = std::move(schema);
  if (!parameter.optional) description.allowed.push_back(must_have({parameter.name}));
  return description;
}

Json schema_of_points(std::size_t count) {
  return schema_of_list(schema_of_list(schema_of_number(Range::any), 3), count);
}

}  // namespace

std::string_view name_of(Unit unit) {
  switch (unit) {
    case Unit::none:
      return "";
    case Unit::length:
      return "length";
    case Unit::degrees:
      return "degrees";
  }
  return "";
}

Json schema_of_list(const Json& item, std::size_t count) {
  return {{"type", "array"}, {"items", item}, {"minItems", count}, {"maxItems", count}};
}

Json schema_of_number(Range range) {
  Json schema = {{"type", "number"}};
  switch (range) {
    case Range::any:
      break;
    case Range::positive:
      schema["exclusiveMinimum"] = 0;
      break;
    case Range::not_negative:
      schema["minimum"] = 0;
      break;
    case Range::at_least_one:
      schema["minimum"] = 1;
      break;
    case Range::zero_to_one:
      schema["minimum"] = 0;
      schema["maximum"] = 1;
      break;
    case Range::zero_to_180:
      schema["exclusiveMinimum"] = 0;
      schema["exclusiveMaximum"] = 180;
      break;
    case Range::brightness:
      schema["minimum"] = 0;
      schema["maximum"] = most_brightness;
      break;
  }
  return schema;
}

MemberDescription describe(const Parameter& parameter, Member<double>) {
  return one_key(parameter, "number", schema_of_number(parameter.range));
}

MemberDescription describe(const Parameter& parameter, Member<std::array<double, 2>>) {
  return one_key(parameter, "2 numbers", schema_of_list(schema_of_number(parameter.range), 2));
}

MemberDescription describe(const Parameter& parameter, Member<Vec3<double>>) {
  if (is_of_colours(parameter.range))
    return one_key(parameter, "a colour", colour_schema(parameter.range));
  return one_key(parameter, "3 numbers", schema_of_list(schema_of_number(parameter.range), 3));
}

MemberDescription describe(const Parameter& parameter, Member<std::array<Vec3<double>, 2>>) {
  return one_key(parameter, "2 points", schema_of_points(2));
}

MemberDescription describe(const Parameter& parameter, Member<std::array<Vec3<double>, 3>>) {
  return one_key(parameter, "3 points", schema_of_points(3));
}

MemberDescription describe(const Parameter& parameter, Member<PointCloud>) {
  Json points = schema_of_points(1);
  points.erase("maxItems");
  MemberDescription description = one_key(parameter, "points, or a file's name", points);
  const std::string name(parameter.name);
  description.keys = name + " or file";
  description.properties["file"] = {{"type", "string"},
                                    {"description", "a mesh file, relative to this file's folder"}};
  description.allowed = {either(must_have({name}), must_have({"file"}))};
  return description;
}

MemberDescription describe(const Parameter& parameter, Member<Nested>) {
  return one_key(parameter, "shape", reference("shape"));
}

MemberDescription describe(const Parameter& parameter, Member<ShapeList>) {
  const Json shapes = {{"type", "array"}, {"items", reference("shape")}, {"minItems", 1}};
  MemberDescription description = one_key(parameter, "list of shapes", shapes);
  description.properties["a"] = reference("shape");
  description.properties["b"] = reference("shape");
  description.keys += " (or a and b)";
  description.allowed = {either(must_have({parameter.name}), must_have({"a", "b"}))};
  return description;
}

MemberDescription describe(const Parameter&, Member<AffineMap>) {
  const Json number = schema_of_number(Range::any);
  const Json three = schema_of_list(number, 3);
  const Json four = schema_of_list(number, 4);
  MemberDescription description;
  description.keys = "translate, rotate, scale, or matrix";
  description.value = "3 numbers, a rotation, 1 or 3 numbers, or 3 rows of 3 or 4 numbers";
  description.properties = {
      {"translate", three},
      {"rotate", reference("rotation")},
      {"scale", {{"oneOf", {number, three}}}},
      {"matrix", {{"oneOf", {schema_of_list(three, 3), schema_of_list(four, 3)}}}}};
  description.properties["translate"]["description"] = "added last";
  description.properties["rotate"]["description"] =
      "a quaternion [x, y, z, w], or an axis and degrees, angles, or a point to look at";
  description.properties["scale"]["description"] = "applied first; negative numbers mirror";
  description.properties["matrix"]["description"] = "an invertible map; a fourth column is added";
  for (const char* key : {"translate", "rotate", "scale"}) {
    description.allowed.push_back({{"not", must_have({"matrix", key})}});
  }
  return description;
}

MemberDescription describe(const Parameter& parameter, Member<Resolution>) {
  const Json side = {{"type", "integer"}, {"minimum", 1}, {"maximum", most_pixels_a_side}};
  return one_key(parameter, "2 whole numbers", schema_of_list(side, 2));
}

MemberDescription describe(const Parameter& parameter, Member<std::optional<double>>) {
  return describe(parameter, Member<double>());
}

MemberDescription describe(const Parameter& parameter, Member<std::string>) {
  return one_key(parameter, "a name", {{"type", "string"}});
}

MemberDescription describe(const Parameter& parameter, Member<Paint>) {
  return one_key(parameter, "a colour, or a texture",
                 either(colour_schema(parameter.range), reference("texture")));
}

MemberDescription describe(const Parameter& parameter, Member<PaintIfAny>) {
  return describe(parameter, Member<Paint>());
}

MemberDescription describe(const Parameter& parameter, Member<PictureFile>) {
  return one_key(parameter, "a file's name", {{"type", "string"}});
}

MemberDescription describe(const Parameter& parameter, Member<TwoMaterials>) {
  return one_key(parameter, "2 names", schema_of_list({{"type", "string"}, {"minLength", 1}}, 2));
}

MemberDescription describe_name(const Parameter& parameter, std::span<const std::string_view> names,
                                std::string_view what) {
  Json known = Json::array();
  for (const std::string_view name : names) known.push_back(std::string(name));
  return one_key(parameter, "the name of " + std::string(what), {{"enum", std::move(known)}});
}

}  // namespace minkray
