// SPDX-License-Identifier: MIT
// Spelling of values of members, by their type: the text for people, the schema, how they are read
// and written. Used by member_codec.cpp only.
#pragma once

#include <algorithm>
#include <memory>

#include "renderer/json/values.h"
#include "renderer/member_json/member_codec.h"
#include "renderer/member_json/read_colour.h"
#include "renderer/member_json/read_paint.h"
#include "renderer/member_json/shape_json.h"

namespace minkray {

/// A value in a file, and what its reader needs.
struct Written {
  const Json& json;
  JsonPath path;
  Mistakes& mistakes;
  Range range;
  MeshFiles& files;
};

/// Spelling of a value: text for people, schema, read() and write(). Members that are spelled with
/// other keys than their own name have functions for the object instead.
template <class M>
struct Spelling;

template <>
struct Spelling<double> {
  static std::string text(Range) { return "number"; }
  static Json schema(Range range) { return schema_of_number(range); }
  static std::optional<double> read(const Written& in) {
    return read_number(in.json, in.path, in.mistakes, in.range);
  }
  static Json write(double member) { return member; }
};

template <>
struct Spelling<std::array<double, 2>> {
  static std::string text(Range) { return "2 numbers"; }
  static Json schema(Range range) { return schema_of_list(schema_of_number(range), 2); }
  static std::optional<std::array<double, 2>> read(const Written& in) {
    const auto numbers = read_numbers(in.json, in.path, in.mistakes, 2, in.range);
    if (!numbers) return std::nullopt;
    return std::array<double, 2>{(*numbers)[0], (*numbers)[1]};
  }
  static Json write(const std::array<double, 2>& member) { return {member[0], member[1]}; }
};

template <>
struct Spelling<Vec3<double>> {
  static std::string text(Range range) { return is_of_colours(range) ? "a colour" : "3 numbers"; }
  static Json schema(Range range) {
    return is_of_colours(range) ? colour_schema(range) : schema_of_list(schema_of_number(range), 3);
  }
  static std::optional<Vec3<double>> read(const Written& in) {
    return is_of_colours(in.range) ? read_colour(in.json, in.path, in.mistakes, in.range)
                                   : read_vector(in.json, in.path, in.mistakes, in.range);
  }
  static Json write(const Vec3<double>& member) { return to_json(member); }
};

inline Json schema_of_points(std::size_t count) {
  return schema_of_list(schema_of_list(schema_of_number(Range::any), 3), count);
}

template <class Points>
Json list_of_points(const Points& points) {
  Json list = Json::array();
  for (const Vec3<double>& point : points) list.push_back(to_json(point));
  return list;
}

template <std::size_t N>
struct Spelling<std::array<Vec3<double>, N>> {
  static std::string text(Range) { return std::to_string(N) + " points"; }
  static Json schema(Range) { return schema_of_points(N); }
  static std::optional<std::array<Vec3<double>, N>> read(const Written& in) {
    const auto points = read_points(in.json, in.path, in.mistakes, N, N);
    if (!points) return std::nullopt;
    std::array<Vec3<double>, N> fixed;
    std::copy(points->begin(), points->end(), fixed.begin());
    return fixed;
  }
  static Json write(const std::array<Vec3<double>, N>& member) { return list_of_points(member); }
};

template <>
struct Spelling<Nested> {
  static std::string text(Range) { return "shape"; }
  static Json schema(Range) { return {{"$ref", "#/$defs/shape"}}; }
  static std::optional<Shape> read(const Written& in) {
    return read_shape(in.json, in.path, in.mistakes, in.files);
  }
  static Json write(const Nested& member) { return write_shape(*member); }
};

template <>
struct Spelling<Resolution> {
  static std::string text(Range) { return "2 whole numbers"; }
  static Json schema(Range) {
    return schema_of_list({{"type", "integer"}, {"minimum", 1}, {"maximum", most_pixels_a_side}},
                          2);
  }
  static std::optional<Resolution> read(const Written& in) {
    if (!in.json.is_array() || in.json.size() != 2) {
      in.mistakes.add(
          in.path, "must be a list of 2 whole numbers: width and height (" + found(in.json) + ")");
      return std::nullopt;
    }
    const auto side = [&](std::size_t i) {
      return read_integer(in.json[i], in.path / i, in.mistakes, 1, most_pixels_a_side);
    };
    const auto width = side(0), height = side(1);
    if (!width || !height) return std::nullopt;
    return Resolution{*width, *height};
  }
  static Json write(const Resolution& member) { return {member.width, member.height}; }
};

template <>
struct Spelling<std::string> {
  static std::string text(Range) { return "a name"; }
  static Json schema(Range) { return {{"type", "string"}}; }
  static std::optional<std::string> read(const Written& in) {
    return read_string(in.json, in.path, in.mistakes);
  }
  static Json write(const std::string& member) { return member; }
  static bool is_absent(const std::string& member) { return member.empty(); }
};

template <>
struct Spelling<Paint> {
  static std::string text(Range) { return "a colour, or a texture"; }
  static Json schema(Range range) {
    return {{"oneOf", Json::array({colour_schema(range), {{"$ref", "#/$defs/texture"}}})}};
  }
  static std::optional<Paint> read(const Written& in) {
    return read_paint(in.json, in.path, in.mistakes, in.range, in.files);
  }
  static Json write(const Paint& member) { return write_paint(member); }
};

template <>
struct Spelling<PictureFile> {
  static std::string text(Range) { return "a file's name"; }
  static Json schema(Range) { return {{"type", "string"}}; }
  static std::optional<PictureFile> read(const Written& in) {
    const auto name = read_string(in.json, in.path, in.mistakes);
    if (!name) return std::nullopt;
    auto image = in.files.read_picture(*name, in.path, in.mistakes);
    if (!image) return std::nullopt;
    return PictureFile{in.files.from_scene(*name), std::move(image)};
  }
  static Json write(const PictureFile& member) { return member.file; }
};

template <>
struct Spelling<TwoMaterials> {
  static std::string text(Range) { return "2 names"; }
  static Json schema(Range) { return schema_of_list({{"type", "string"}, {"minLength", 1}}, 2); }
  static std::optional<TwoMaterials> read(const Written& in) {
    if (!in.json.is_array() || in.json.size() != 2) {
      in.mistakes.add(in.path, "must be a list of 2 names (" + found(in.json) + ")");
      return std::nullopt;
    }
    const auto first = read_string(in.json[0], in.path / std::size_t{0}, in.mistakes);
    const auto second = read_string(in.json[1], in.path / std::size_t{1}, in.mistakes);
    if (!first || !second) return std::nullopt;
    return TwoMaterials{std::make_shared<const std::array<std::string, 2>>(
        std::array<std::string, 2>{*first, *second})};
  }
  static Json write(const TwoMaterials& member) {
    return Json::array({(*member.names)[0], (*member.names)[1]});
  }
};

/// A value, or none.
template <class M, class Of>
struct OptionalSpelling : Spelling<Of> {
  static Json write(const M& member) { return Spelling<Of>::write(*member); }
  static bool is_absent(const M& member) { return !member; }
};
template <>
struct Spelling<std::optional<double>> : OptionalSpelling<std::optional<double>, double> {};
template <>
struct Spelling<PaintIfAny> : OptionalSpelling<PaintIfAny, Paint> {};

}  // namespace minkray
