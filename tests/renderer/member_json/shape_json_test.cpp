// SPDX-License-Identifier: MIT
#include "renderer/member_json/shape_json.h"

#include <gtest/gtest.h>

#include <random>

#include "renderer/json/parse.h"
#include "renderer/query/query_json.h"
#include "renderer/scene_json/scene_json.h"
#include "tests/support/messages.h"

namespace minkray {
namespace {

std::optional<Shape> shape_of(std::string_view text, Mistakes& mistakes) {
  MeshFiles meshes(".");
  const auto json = parse_json(text, mistakes);
  if (!json) return std::nullopt;
  return read_shape(*json, JsonPath(), mistakes, meshes);
}

Shape good_shape(std::string_view text) {
  Mistakes mistakes("shape");
  auto shape = shape_of(text, mistakes);
  EXPECT_TRUE(shape) << mistakes.text();
  return shape.value();
}

std::string complaint(std::string_view text) {
  Mistakes mistakes("shape");
  EXPECT_FALSE(shape_of(text, mistakes));
  return mistakes.text();
}

/// Equal in every bit of the supports in many directions.
void expect_same(const Shape& a, const Shape& b) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 100; ++i) {
    const Vec3<double> n(normal(random), normal(random), normal(random));
    EXPECT_EQ(a.support(n), b.support(n));
  }
}

TEST(ShapeJson, what_is_written_reads_as_the_same_shape) {
  const std::vector<std::string> texts = {
      R"({"type": "point", "position": [0.1, 0.2, 0.3]})",
      R"({"type": "segment", "points": [[0, 0, 0.1], [0.3, 0, 1e-300]]})",
      R"({"type": "triangle", "points": [[0, 0, 0], [1, 0, 0], [0, 1, 0]]})",
      R"({"type": "sphere", "radius": 0.3333333333333333})",
      R"({"type": "ellipsoid", "radii": [1, 2, 3]})",
      R"({"type": "box", "half_extents": [1, 2, 0]})",
      R"({"type": "disk", "radius": 2})",
      R"({"type": "cylinder", "radius": 2, "half_height": 0.1})",
      R"({"type": "cut_cylinder", "radius": 2, "heights": [-1, 0.5], "upper_slope": [0.1, -0.7]})",
      R"({"type": "cone", "radius": 2, "half_height": 0.1})",
      R"({"type": "capsule", "radius": 2, "half_height": 0.1})",
      R"({"type": "tapered_capsule", "radii": [2, 1], "half_height": 3})",
      R"({"type": "frustum", "radii": [2, 1], "half_height": 3})",
      R"({"type": "superellipsoid", "radii": [2, 1, 1], "exponent": 3.5})",
      R"({"type": "hull", "points": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.1, 0.1, 3]]})",
      R"({"type": "rounded", "radius": 0.1, "shape": {"type": "box", "half_extents": [1, 1, 1]}})",
      R"({"type": "minkowski_sum", "shapes": [{"type": "sphere", "radius": 1},
                                              {"type": "disk", "radius": 2}]})",
      R"({"type": "minkowski_difference", "a": {"type": "cone", "radius": 1, "half_height": 1},
          "b": {"type": "disk", "radius": 2}})",
      R"({"type": "hull_of", "shapes": [{"type": "sphere", "radius": 1},
                                        {"type": "point", "position": [3, 0, 0]}]})",
      R"({"type": "transform", "shape": {"type": "sphere", "radius": 1}, "translate": [1, 2, 3],
          "rotate": [0.1, 0.2, 0.3, 0.9], "scale": [1, -2, 0.3]})",
  };
  std::vector<bool> seen(std::variant_size_v<ShapeVariant>);
  for (const std::string& text : texts) {
    const Shape shape = good_shape(text);
    seen[shape.kind.index()] = true;
    const Json json = write_shape(shape);
    expect_same(shape, good_shape(json.dump()));
    EXPECT_EQ(write_shape(good_shape(json.dump())), json);
  }
  // A new kind of shape belongs into the list above, unless no file can hold one.
  for_each_shape_kind([&, i = 0u]<class S>() mutable {
    EXPECT_NE(seen[i++], declared_by<S>.by_program) << S::name << " has no line in the list above";
  });
}

TEST(ShapeJson, what_a_program_gives_is_in_no_file) {
  EXPECT_TRUE(complaint(R"({"type": "custom"})")
                  .starts_with("shape: /type: must be the name of a shape (got \"custom\"; "));
}

TEST(ShapeJson, two_operands_may_be_spelled_as_a_and_b_or_as_a_list) {
  const std::string a = R"({"type": "cone", "radius": 1, "half_height": 1})";
  const std::string b = R"({"type": "disk", "radius": 2})";
  for (const std::string type : {"minkowski_sum", "minkowski_difference", "hull_of"}) {
    const std::string start = R"({"type": ")" + type + R"(", )";
    const Shape ab = good_shape(start + R"("a": )" + a + R"(, "b": )" + b + "}");
    expect_same(ab, good_shape(start + R"("shapes": [)" + a + ", " + b + "]}"));
  }
  EXPECT_EQ(complaint(R"({"type": "minkowski_difference", "shapes": [)" + a + "]}"),
            "shape: /shapes: must be a list of 2 shapes (got a list of 1)");
}

TEST(ShapeJson, a_pose_is_applied_scale_first) {
  const Shape shape = good_shape(
      R"({"type": "transform", "shape": {"type": "point", "position": [1, 0, 0]},
          "translate": [10, 0, 0], "rotate": [0, 0, 1, 1], "scale": [2, 3, 4]})");
  EXPECT_TRUE(shape.support<double>({1, 0, 0}).isApprox(Vec3<double>(10, 2, 0), 1e-15));
}

TEST(ShapeJson, a_quaternion_of_any_length_but_zero_turns) {
  const std::string point = R"({"type": "transform", "shape": {"type": "point",
                               "position": [1, 0, 0]}, "rotate": )";
  for (const std::string q : {"[0, 0, 1e-200, 1e-200]", "[0, 0, 1e200, 1e200]", "[0, 0, 5, 5]"}) {
    EXPECT_TRUE(good_shape(point + q + "}")
                    .support<double>({1, 0, 0})
                    .isApprox(Vec3<double>(0, 1, 0), 1e-15));
  }
  EXPECT_EQ(complaint(point + "[0, 0, 0, 0]}"),
            "shape: /rotate: must be a quaternion [x, y, z, w] other than zero (got a list of 4)");
}

TEST(ShapeJson, singular_maps_are_refused_and_merely_thin_ones_are_not) {
  const std::string start = R"({"type": "transform", "shape": {"type": "sphere", "radius": 1}, )";
  for (const std::string map :
       {R"("scale": 0})", R"("scale": [1, 0, 1]})", R"("matrix": [[0,0,0],[0,1,0],[0,0,1]]})",
        R"("matrix": [[1,2,3],[4,5,6],[7,8,9]]})", R"("scale": 1e-320})",
        R"("matrix": [[0.1,0.2,0.3],[0.7,0.1,0.4],[0.8,0.3,0.7]]})"}) {
    EXPECT_TRUE(has(complaint(start + map), "/")) << map;
  }
  good_shape(start + R"("scale": [1, 1e-12, 1], "rotate": [1, 2, 3, 4]})");
  good_shape(start + R"("scale": [-1, 1, 1]})");
  good_shape(start + R"("scale": 1e100})");
  good_shape(start + R"("matrix": [[1, 5, 0, 1], [0, 1, 7, 2], [0, 0, 1, 3]]})");
}

TEST(ShapeJson, nesting_without_end_is_refused) {
  std::string text = R"({"type": "sphere", "radius": 1})";
  for (int i = 0; i < 255; ++i) {
    text = R"({"type": "rounded", "radius": 0, "shape": )" + text + "}";
  }
  good_shape(text);
  text = R"({"type": "rounded", "radius": 0, "shape": )" + text + "}";
  const std::string message = complaint(text);
  EXPECT_TRUE(has(message, "must not be nested more than 256 levels deep"));
  EXPECT_LT(message.size(), 300u);
  EXPECT_FALSE(complaint(std::string(1000000, '[')).empty());
}

/// Shapes within shapes, with a sphere at the bottom.
std::string nested(const std::string& start, const std::string& end, int depth) {
  std::string text;
  for (int i = 0; i < depth; ++i) text += start;
  text += R"({"type": "sphere", "radius": 1})";
  for (int i = 0; i < depth; ++i) text += end;
  return text;
}

const std::vector<std::pair<std::string, std::string>> operators = {
    {R"({"type": "rounded", "radius": 0, "shape": )", "}"},
    {R"({"type": "transform", "translate": [1, 0, 0], "shape": )", "}"},
    {R"({"type": "minkowski_sum", "shapes": [)", "]}"},
    {R"({"type": "hull_of", "a": {"type": "point", "position": [0, 0, 0]}, "b": )", "}"},
};

TEST(ShapeJson, ten_thousand_levels_of_any_operator_are_refused_in_scenes_and_queries) {
  for (const auto& [start, end] : operators) {
    const std::string shape = nested(start, end, 10000);
    Mistakes in_scene("scene");
    EXPECT_FALSE(parse_scene(
        R"({"version": 1, "objects": [{"name": "a", "shape": )" + shape + "}]}", ".", in_scene));
    Mistakes in_query("query");
    MeshFiles meshes(".");
    EXPECT_FALSE(parse_query(R"({"query": "ray", "shape": )" + shape + "}", meshes, in_query));
    for (const Mistakes* mistakes : {&in_scene, &in_query}) {
      ASSERT_EQ(mistakes->messages().size(), 1u);
      const std::string& message = mistakes->messages()[0];
      EXPECT_TRUE(has(message, "must not be nested more than 256 levels deep"));
      EXPECT_LT(message.size(), 300u) << message;
    }
  }
}

TEST(ShapeJson, a_hundred_levels_of_any_operator_are_a_shape) {
  for (const auto& [start, end] : operators)
    EXPECT_TRUE(good_shape(nested(start, end, 100)).support<double>({1, 2, 3}).allFinite());
}

TEST(ShapeJson, hulls_of_nothing_are_refused) {
  EXPECT_EQ(complaint(R"({"type": "hull", "points": []})"),
            "shape: /points: must be a list of points, at least 1, each of 3 numbers "
            "(got a list of 0)");
  for (const std::string type : {"hull_of", "minkowski_sum"})
    EXPECT_EQ(complaint(R"({"type": ")" + type + R"(", "shapes": []})"),
              "shape: /shapes: must be a list of shapes, at least 1 (got a list of 0)");
  EXPECT_EQ(complaint(R"({"type": "minkowski_difference", "shapes": []})"),
            "shape: /shapes: must be a list of 2 shapes (got a list of 0)");
}

TEST(ShapeJson, planes_that_cross_within_their_cylinder_are_refused) {
  const std::string start = R"({"type": "cut_cylinder", "radius": 2, "upper_slope": [0.5, 0], )";
  good_shape(start + R"("heights": [-0.5, 0.5]})");
  EXPECT_EQ(complaint(start + R"("heights": [-0.5, 0.25]})"),
            "shape: /heights: must be rising, and so far apart that the planes do not cross within "
            "the cylinder: the difference must be at least 1.0 (got [-0.5,0.25])");
  EXPECT_EQ(complaint(start + R"("lower_slope": [0.5, 0], "heights": [1, 0.5]})"),
            "shape: /heights: must be rising, and so far apart that the planes do not cross within "
            "the cylinder: the difference must be at least 0.0 (got [1,0.5])");
}

}  // namespace
}  // namespace minkray
