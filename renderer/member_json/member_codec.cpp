// SPDX-License-Identifier: MIT
#include "renderer/member_json/member_codec.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "renderer/member_json/spelling.h"

namespace minkray {
namespace {

/// "radius, its radius, > 0": what a missing key should have held.
std::string expectation(const Parameter& parameter) {
  std::string text(parameter.doc);
  if (!constraint(parameter.range).empty()) {
    text += ", " + std::string(constraint(parameter.range));
  }
  return text;
}

/// Finds the key and, if it is there, assigns what `read(json, path)` returns.
template <class M, class Read>
bool read_key(ObjectReader& object, const Parameter& parameter, M& member, Read&& read) {
  const Json* json = object.find(parameter.name);
  if (!json && parameter.optional) return true;
  if (!json) {
    object.require(parameter.name, expectation(parameter));
    return false;
  }
  auto value = read(*json, object.path(parameter.name));
  if (!value) return false;
  member = std::move(*value);
  return true;
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

}  // namespace

template <>
struct Spelling<PointCloud> {
  static bool read_object(ObjectReader& object, const Parameter& parameter, PointCloud& member,
                          MeshFiles& meshes) {
    Mistakes& mistakes = object.mistakes();
    const Json* file = object.find("file");
    const Json* inline_points = object.find(parameter.name);
    if (!file) {
      return read_key(object, parameter, member,
                      [&](const Json& json, const JsonPath& path) -> std::optional<PointCloud> {
                        auto points = read_points(json, path, mistakes, 1,
                                                  std::numeric_limits<std::size_t>::max());
                        if (!points) return std::nullopt;
                        try {
                          return PointCloud(std::move(*points));
                        } catch (const std::runtime_error& error) {
                          mistakes.add(path, error.what());
                          return std::nullopt;
                        }
                      });
    }
    if (inline_points) {
      mistakes.add(object.path(), "must have either \"" + std::string(parameter.name) +
                                      "\" or \"file\" (got both)");
      return false;
    }
    const auto name = read_string(*file, object.path("file"), mistakes);
    if (!name) return false;
    auto points = meshes.read(*name, object.path("file"), mistakes);
    if (!points) return false;
    member = std::move(*points);
    return true;
  }
  static void write_object(Json& object, std::string_view name, const PointCloud& member) {
    if (member.source().empty())
      object[std::string(name)] = list_of_points(member.points());
    else
      object["file"] = member.source();
  }
  static MemberDescription describe(const Parameter& parameter) {
    Json points = schema_of_points(1);
    points.erase("maxItems");
    MemberDescription description = one_key(parameter, "points, or a file's name", points);
    const std::string name(parameter.name);
    description.keys = name + " or file";
    description.properties["file"] = {
        {"type", "string"}, {"description", "a mesh file, relative to this file's folder"}};
    description.allowed = {either(must_have({name}), must_have({"file"}))};
    return description;
  }
};

/// Two operands may be called a and b, too.
template <>
struct Spelling<ShapeList> {
  static bool read_object(ObjectReader& object, const Parameter& parameter, ShapeList& member,
                          MeshFiles& meshes) {
    const Json* a = object.find("a");
    const Json* b = object.find("b");
    if (a && b && !object.find(parameter.name)) {
      const auto shape_a = read_shape(*a, object.path("a"), object.mistakes(), meshes);
      const auto shape_b = read_shape(*b, object.path("b"), object.mistakes(), meshes);
      if (!shape_a || !shape_b) return false;
      member = {*shape_a, *shape_b};
      return true;
    }
    if (a || b) {
      object.mistakes().add(object.path(), "must have either \"" + std::string(parameter.name) +
                                               "\" or both \"a\" and \"b\"");
      return false;
    }
    return read_key(object, parameter, member, [&](const Json& json, const JsonPath& path) {
      return read_shapes(json, path, object.mistakes(), meshes, 1);
    });
  }
  static void write_object(Json& object, std::string_view name, const ShapeList& member) {
    Json list = Json::array();
    for (const Nested& shape : member) list.push_back(write_shape(*shape));
    object[std::string(name)] = std::move(list);
  }
  static MemberDescription describe(const Parameter& parameter) {
    const Json shape = Spelling<Nested>::schema(Range::any);
    MemberDescription description = one_key(parameter, "list of shapes",
                                            {{"type", "array"}, {"items", shape}, {"minItems", 1}});
    description.properties["a"] = shape;
    description.properties["b"] = shape;
    description.keys += " (or a and b)";
    description.allowed = {either(must_have({parameter.name}), must_have({"a", "b"}))};
    return description;
  }
};

template <>
struct Spelling<AffineMap> {
  static bool read_object(ObjectReader& object, const Parameter&, AffineMap& member, MeshFiles&) {
    const auto map = read_affine(object);
    if (map) member = AffineMap(*map);
    return map.has_value();
  }
  static void write_object(Json& object, std::string_view, const AffineMap& member) {
    const Affine<double>& map = member.affine();
    Json rows = Json::array();
    for (int i = 0; i < 3; ++i) {
      rows.push_back({map.linear(i, 0), map.linear(i, 1), map.linear(i, 2), map.translation[i]});
    }
    object["matrix"] = std::move(rows);
  }
  static MemberDescription describe(const Parameter&) {
    const Json number = schema_of_number(Range::any);
    const Json three = schema_of_list(number, 3);
    const Json four = schema_of_list(number, 4);
    MemberDescription description;
    description.keys = "translate, rotate, scale, or matrix";
    description.value = "3 numbers, a rotation, 1 or 3 numbers, or 3 rows of 3 or 4 numbers";
    description.properties = {
        {"translate", three},
        {"rotate", {{"$ref", "#/$defs/rotation"}}},
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
};

template <class M>
bool MemberCodec<M>::read(ObjectReader& object, const Parameter& parameter, M& member,
                          MeshFiles& files) {
  if constexpr (requires { &Spelling<M>::read_object; })
    return Spelling<M>::read_object(object, parameter, member, files);
  else
    return read_key(object, parameter, member, [&](const Json& json, const JsonPath& path) {
      return Spelling<M>::read({json, path, object.mistakes(), parameter.range, files});
    });
}

template <class M>
void MemberCodec<M>::write(Json& object, std::string_view name, const M& member) {
  if constexpr (requires { &Spelling<M>::write_object; }) {
    Spelling<M>::write_object(object, name, member);
  } else {
    if constexpr (requires { Spelling<M>::is_absent(member); })
      if (Spelling<M>::is_absent(member)) return;
    object[std::string(name)] = Spelling<M>::write(member);
  }
}

template <class M>
MemberDescription MemberCodec<M>::describe(const Parameter& parameter) {
  if constexpr (requires { &Spelling<M>::describe; })
    return Spelling<M>::describe(parameter);
  else
    return one_key(parameter, Spelling<M>::text(parameter.range),
                   Spelling<M>::schema(parameter.range));
}

template struct MemberCodec<double>;
template struct MemberCodec<std::array<double, 2>>;
template struct MemberCodec<Vec3<double>>;
template struct MemberCodec<std::array<Vec3<double>, 2>>;
template struct MemberCodec<std::array<Vec3<double>, 3>>;
template struct MemberCodec<PointCloud>;
template struct MemberCodec<Nested>;
template struct MemberCodec<ShapeList>;
template struct MemberCodec<AffineMap>;
template struct MemberCodec<Resolution>;
template struct MemberCodec<std::optional<double>>;
template struct MemberCodec<std::string>;
template struct MemberCodec<Paint>;
template struct MemberCodec<PaintIfAny>;
template struct MemberCodec<PictureFile>;
template struct MemberCodec<TwoMaterials>;

bool NameCodec::read(ObjectReader& object, const Parameter& parameter, std::string& member) const {
  return read_key(object, parameter, member,
                  [&](const Json& json, const JsonPath& path) -> std::optional<std::string> {
                    const auto name = read_string(json, path, object.mistakes());
                    if (!name) return std::nullopt;
                    if (std::ranges::find(names, *name) != names.end()) return *name;
                    object.mistakes().add(
                        path, "must be the name of " + std::string(what) + " (" + found(json) +
                                  "; " + suggestion(*name, {names.begin(), names.end()}) + ")");
                    return std::nullopt;
                  });
}

MemberDescription NameCodec::describe(const Parameter& parameter) const {
  Json known = Json::array();
  for (const std::string_view name : names) known.push_back(std::string(name));
  return one_key(parameter, "the name of " + std::string(what), {{"enum", std::move(known)}});
}

}  // namespace minkray
