// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fstream>

#include "renderer/paper/solvers.h"
#include "renderer/query/answer.h"
#include "renderer/query/query_json.h"
#include "tests/support/messages.h"
#include "tests/support/source_files.h"

namespace minkray {
namespace {

std::optional<Query> parse(const std::string& text, Mistakes& mistakes) {
  MeshFiles meshes{std::filesystem::path()};
  return parse_query(text, meshes, mistakes);
}

std::string mistakes_of(const std::string& text) {
  Mistakes mistakes("q.jsonl:7");
  EXPECT_FALSE(parse(text, mistakes).has_value());
  return mistakes.text();
}

/// All cases of a file, and what is wrong with the answers.
std::vector<std::string> all_complaints(const std::string& file, const AnswerOptions& options,
                                        int& cases) {
  std::ifstream in(source_folder() / "tests/cases" / file);
  std::vector<std::string> all;
  std::string line;
  cases = 0;
  while (std::getline(in, line)) {
    Mistakes mistakes(file);
    const auto query = parse(line, mistakes);
    if (!query) {
      all.push_back(mistakes.text());
      continue;
    }
    ++cases;
    for (const std::string& complaint : complaints(*query, answer(*query, options).facts))
      all.push_back(query->name + ": " + complaint);
  }
  return all;
}

// The queries on which published engines were wrong, with their exact answers.
TEST(HardCases, all_are_right) {
  AnswerOptions options;
  int cases = 0;
  EXPECT_EQ(all_complaints("hard-casts.jsonl", options, cases), std::vector<std::string>());
  EXPECT_EQ(cases, 100);
  EXPECT_EQ(all_complaints("hard-distances.jsonl", options, cases), std::vector<std::string>());
  EXPECT_EQ(cases, 50);
}

TEST(HardCases, all_are_certified) {
  std::ifstream in(source_folder() / "tests/cases/hard-casts.jsonl");
  int certified = 0;
  for (std::string line; std::getline(in, line);) {
    Mistakes mistakes("hard-casts.jsonl");
    const auto query = parse(line, mistakes);
    ASSERT_TRUE(query.has_value());
    AnswerOptions options;
    options.certify = true;
    const Answer result = answer(*query, options);
    ASSERT_TRUE(result.verdict.has_value()) << query->name;
    EXPECT_TRUE(result.verdict->holds) << query->name << ": " << result.verdict->complaint;
    EXPECT_EQ(result.json.at("certified").at("holds"), true);
    ++certified;
  }
  EXPECT_EQ(certified, 100);
}

TEST(HardCases, all_are_right_with_algorithm_1_in_double) {
  AnswerOptions options;
  options.solver = &solver::first_solution;
  int cases = 0;
  EXPECT_EQ(all_complaints("hard-casts.jsonl", options, cases), std::vector<std::string>());
}

TEST(HardCases, distances_are_right_with_every_subalgorithm) {
  for (const auto& subalgorithm : named_subalgorithms) {
    AnswerOptions options;
    options.subalgorithm = subalgorithm.kind;
    int cases = 0;
    EXPECT_EQ(all_complaints("hard-distances.jsonl", options, cases), std::vector<std::string>());
  }
}

TEST(HardCases, signed_distances_are_right) {
  AnswerOptions options;
  int cases = 0;
  EXPECT_EQ(all_complaints("signed-distances.jsonl", options, cases), std::vector<std::string>());
  EXPECT_EQ(cases, 149);
}

// Exactly, that ray passes the shape, at 2e-18 of its size.
TEST(HardCases, the_worst_that_fuzzing_found_are_right_in_double_but_one) {
  int cases = 0;
  EXPECT_EQ(all_complaints("own-casts.jsonl", {}, cases),
            (std::vector<std::string>{"Minkray random-181345: status is hit, expected miss"}));
  EXPECT_EQ(cases, 10);
}

TEST(Queries, signed_distances_that_ran_out_of_support_points_say_so) {
  const auto is_told = [](const std::string& shape) {
    Mistakes mistakes("q");
    const auto query = parse(
        R"({"query":"signed_distance","a":{"type":"point","position":[0,0,0]},"b":)" + shape + "}",
        mistakes);
    EXPECT_TRUE(query) << mistakes.text();
    const Answer result = answer(*query, {});
    EXPECT_EQ(result.facts.status, "overlapping");
    return result.json.contains("settled") && result.json["settled"] == false;
  };
  // All directions are as good as each other, and nothing but the support mapping is known.
  EXPECT_TRUE(is_told(
      R"({"type":"hull_of","shapes":[{"type":"sphere","radius":1},{"type":"sphere","radius":0.5}]})"));
  EXPECT_FALSE(is_told(R"({"type":"sphere","radius":1})"));
  EXPECT_FALSE(is_told(R"({"type":"ellipsoid","radii":[1,1,2]})"));
}

TEST(Queries, impacts_say_between_which_times) {
  Mistakes mistakes("q");
  const auto query = parse(
      R"({"query":"impact","a":{"type":"sphere","radius":1},"b":{"type":"transform","shape":{"type":"box","half_extents":[1,1,1]},"translate":[5,0,0]},"motion_b":{"velocity":[-1,0,0],"turn":[1,0,0]},"t_max":10})",
      mistakes);
  ASSERT_TRUE(query) << mistakes.text();
  const Answer result = answer(*query, {});
  EXPECT_EQ(result.facts.status, "hit");
  EXPECT_LE(result.json.at("t_lo").get<double>(), 3);
  EXPECT_NEAR(result.json.at("t_lo").get<double>(), 3, 1e-8);
  EXPECT_GE(result.json.at("t_hi").get<double>(), 3 - 1e-9);
  EXPECT_TRUE(has(mistakes_of(R"({"query":"impact","a":{"type":"point"},"b":{"type":"point"}})"),
                  "/t_max"));
}

/// The distance is that at the last time; its square is beyond doubles for the faster ball.
TEST(Queries, impacts_leave_out_what_is_unknown_of_a_miss) {
  for (const auto& [velocity, is_known] : {std::pair("[1,0,0]", true), {"[1e160,0,0]", false}}) {
    Mistakes mistakes("q");
    const auto query = parse(
        std::string(
            R"({"query":"impact","a":{"type":"sphere","radius":1},"b":{"type":"transform","shape":{"type":"sphere","radius":1},"translate":[5,0,0]},"t_max":10,"motion_b":{"velocity":)") +
            velocity + "}}",
        mistakes);
    ASSERT_TRUE(query) << mistakes.text();
    const Json json = answer(*query, {}).json;
    EXPECT_EQ(json.at("status").text(), "miss") << velocity;
    EXPECT_EQ(json.at("t_lo").get<double>(), 10) << velocity;
    EXPECT_TRUE(json.at("t_hi").is_null()) << velocity;
    EXPECT_NE(json.find("normal"), nullptr) << velocity;
    for (const char* key : {"distance", "point_a", "point_b"})
      EXPECT_EQ(json.find(key) != nullptr, is_known) << velocity << ' ' << key;
    if (!is_known) continue;
    EXPECT_NEAR(json.at("distance").get<double>(), 13, 1e-9);
  }
}

/// Our bodies turned about their middles, and the libraries' about their frames' origins: one body
/// met another at 2.0, or swung past it until 5.3.
TEST(Queries, bodies_turn_about_the_origin_of_their_frame) {
  // A ball at (2, 0, 0) swings about the origin by a radian per unit of time towards one at
  // (0, 2, 0): their middles are 4 sin(s / 2) = 1 apart when s radians are left.
  const std::string balls =
      R"("b":{"type":"transform","shape":{"type":"sphere","radius":0.5},"translate":[0,2,0]},)"
      R"("a":{"type":"transform","shape":{"type":"sphere","radius":0.5},"translate":[2,0,0]})";
  const double meets = std::acos(0.0) - 2 * std::asin(0.25);
  Mistakes mistakes("q");
  const auto impact = parse(
      R"({"query":"impact",)" + balls + R"(,"motion_a":{"turn":[0,0,1]},"t_max":3})", mistakes);
  ASSERT_TRUE(impact) << mistakes.text();
  const Answer exact = answer(*impact, {});
  EXPECT_EQ(exact.facts.status, "hit");
  EXPECT_NEAR(exact.facts.t, meets, 1e-8);
  // About its own middle it stays where it is.
  const auto about_middle = parse(R"({"query":"impact",)" + balls +
                                      R"(,"motion_a":{"turn":[0,0,1],"pivot":[2,0,0]},"t_max":3})",
                                  mistakes);
  ASSERT_TRUE(about_middle) << mistakes.text();
  EXPECT_EQ(answer(*about_middle, {}).facts.status, "miss");
  const auto steps = parse(
      R"({"query":"shape","moving":{"type":"transform","shape":{"type":"sphere","radius":0.5},"translate":[2,0,0]},)"
      R"("obstacle":{"type":"transform","shape":{"type":"sphere","radius":0.5},"translate":[0,2,0]},)"
      R"("direction":[0,0,0],"turn":[0,0,1],"t_max":3,"steps":3000})",
      mistakes);
  ASSERT_TRUE(steps) << mistakes.text();
  const Answer stepped = answer(*steps, {});
  EXPECT_EQ(stepped.facts.status, "hit");
  EXPECT_NEAR(stepped.facts.t, meets, 2e-3);
}

TEST(Queries, manifolds_have_the_corners_that_rest_on_a_plate) {
  Mistakes mistakes("q");
  const std::string plate = R"("a":{"type":"box","half_extents":[5,5,0.5]})";
  const auto query = parse(
      R"({"query":"manifold",)" + plate +
          R"(,"b":{"type":"transform","shape":{"type":"box","half_extents":[1,0.5,0.25]},"translate":[0.5,0.5,0.7]}})",
      mistakes);
  ASSERT_TRUE(query) << mistakes.text();
  const Answer result = answer(*query, {});
  EXPECT_EQ(result.facts.status, "overlapping");
  const Json& points = result.json.at("points");
  ASSERT_EQ(points.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(points[i].at("distance").get<double>(), -0.05, 1e-12);
    const auto corner = [&](std::size_t k) {
      const Json& p = points[k % 4].at("point_a");
      return Vec3<double>(p[0].get<double>(), p[1].get<double>(), p[2].get<double>());
    };
    EXPECT_NEAR(corner(i).z(), 0.5, 1e-12);
    EXPECT_NEAR(std::abs(corner(i).x() - 0.5), 1, 1e-9);
    EXPECT_NEAR(std::abs(corner(i).y() - 0.5), 0.5, 1e-9);
    for (std::size_t k = 0; k < i; ++k) EXPECT_GT((corner(i) - corner(k)).norm(), 0.9);
  }
  const std::string ball = R"(,"b":{"type":"transform","shape":{"type":"sphere","radius":1},)"
                           R"("translate":[0,0,1.5]}})";
  const auto of_ball = parse(R"({"query":"manifold",)" + plate + ball, mistakes);
  ASSERT_TRUE(of_ball) << mistakes.text();
  EXPECT_EQ(answer(*of_ball, {}).json.at("points").size(), 1u);
  EXPECT_TRUE(has(mistakes_of(R"({"query":"manifold","tilt":2,)" + plate + ball), "/tilt"));
  EXPECT_TRUE(has(mistakes_of(R"({"query":"manifold","within":-1,)" + plate + ball), "/within"));
}

constexpr const char* ball_query =
    R"({"query":"ray","shape":{"type":"sphere","radius":1},"ray":{"origin":[-3,0,0],"direction":[1,0,0]},"expect":{"hit":true,"t":2,"t_abs_tol":1e-12}})";

TEST(Queries, a_wrong_answer_is_complained_about) {
  Mistakes mistakes("q");
  auto query = parse(ball_query, mistakes);
  ASSERT_TRUE(query);
  const AnswerFacts facts = answer(*query, {}).facts;
  EXPECT_TRUE(complaints(*query, facts).empty());
  query->expect->t = 2.5;
  EXPECT_EQ(complaints(*query, facts).size(), 1u);
  query->expect->hit = false;
  EXPECT_EQ(complaints(*query, facts).size(), 2u);
  query->expect->normal = Vec3<double>(0, 1, 0);
  EXPECT_EQ(complaints(*query, facts).size(), 3u);
  AnswerFacts nothing = facts;
  nothing.status = "exhausted";
  nothing.hit = false;
  EXPECT_EQ(complaints(*query, nothing).front(), "status is exhausted");
}

TEST(Queries, mistakes_name_line_key_and_what_was_expected) {
  const std::pair<const char*, const char*> message[] = {
      {"{", "q.jsonl:7"},
      {R"({"query":"beam"})", "/query"},
      {R"({"query":"distance","a":{"type":"sphere","radius":-1},"b":{"type":"point"}})",
       "/a/radius"},
      {R"({"query":"distance","a":{"type":"point"},"b":{"type":"point"},"c":1})",
       "/c: unknown key"},
      {R"({"query":"shape","moving":{"type":"point"},"obstacle":{"type":"point"}})",
       "/direction: missing"},
      {R"({"query":"shape","moving":{"type":"point"},"obstacle":{"type":"point"},"direction":[1,0,0],"turn":[0,0,1]})",
       "/t_max"},
      {R"({"query":"ray","shape":{"type":"hull","points":[[-1.7e308,0,0],[1.7e308,0,0]]},"ray":{"origin":[0,0,0],"direction":[1,0,0]}})",
       "/shape/points: must not be wider than the largest number"},
      {R"({"query":"ray","shape":{"type":"point"},"ray":{"origin":[1,0,0],"direction":[0,0,0]}})",
       "/ray/direction: must not be zero (got [0, 0, 0])"}};
  for (const auto& [line, part] : message) EXPECT_TRUE(has(mistakes_of(line), part));
}

/// o + t d is a difference of numbers as large as the origin is far.
TEST(Queries, the_point_is_as_precise_from_afar) {
  for (const double distance : {1e3, 1e8, 1e12, 1e16}) {
    Mistakes mistakes("q");
    Json json = Json::parse(
        R"({"name":"n","query":"ray","shape":{"type":"sphere","radius":1},"ray":{"origin":[0,0,0],"direction":[0,0,3]}})");
    json["ray"]["origin"] = {0, 0, -distance};
    const auto query = parse(json.dump(), mistakes);
    ASSERT_TRUE(query) << mistakes.text();
    const Answer result = answer(*query, {});
    EXPECT_NEAR(result.json.at("point")[2].get<double>(), -1, 1e-15) << distance;
  }
}

TEST(Queries, numbers_of_answers_read_back_as_they_were_and_traces_bound_the_hit) {
  Mistakes mistakes("q");
  const auto query = parse(
      R"({"name":"n","query":"ray","shape":{"type":"ellipsoid","radii":[1,0.5,0.3]},"ray":{"origin":[-3,0.1,0.05],"direction":[1,0.01,0]}})",
      mistakes);
  ASSERT_TRUE(query) << mistakes.text();
  AnswerOptions options;
  options.solver = &solver::gjk_alone;
  options.trace = true;
  const Answer result = answer(*query, options);
  EXPECT_EQ(Json::parse(result.json.dump()).at("t").get<double>(), result.facts.t);
  const Json& trace = result.json.at("trace");
  ASSERT_EQ(static_cast<int>(trace.size()), result.json.at("iterations").get<int>());
  double lower = 0;
  const double rounding = 1e-15;
  for (const Json& step : trace) {
    EXPECT_GE(step.at("t_lo").get<double>(), lower);
    lower = step.at("t_lo").get<double>();
    EXPECT_LE(lower, result.facts.t + rounding);
    EXPECT_TRUE(step.at("t_hi").is_null() || step.at("t_hi").get<double>() >= result.facts.t);
    EXPECT_GE(step.at("case").get<int>(), 1);
    EXPECT_LE(step.at("case").get<int>(), 3);
  }
  EXPECT_NEAR(lower, result.facts.t, rounding);
}

TEST(Queries, steps_that_are_too_many_are_refused_and_never_wrap) {
  for (const std::string steps : {"1000001", "4294967297", "18446744073709551617", "1e300"}) {
    EXPECT_EQ(
        mistakes_of(
            R"({"query":"shape","moving":{"type":"point"},"obstacle":{"type":"point"},"direction":[1,0,0],"steps":)" +
            steps + "}"),
        "q.jsonl:7: /steps: must be a whole number from 1 to 1000000 (got " +
            Json::parse(steps).dump() + ")");
  }
}

TEST(Queries, text_that_is_not_utf_8_is_refused_and_not_shown) {
  for (const std::string wild : {"\xff", "\xc3(", "\xe2\x82", "\xed\xa0\x80", "\xf5\x80\x80\x80"}) {
    const std::string point = R"({"type":"point","position":[0,0,0]})";
    const std::string found = mistakes_of(R"({"query":"distance","a":)" + point + R"(,"b":)" +
                                          point + R"(,"name":")" + wild + "\"}");
    EXPECT_EQ(found.find("q.jsonl:7: /name: not valid JSON at line:column 1:"), 0u) << found;
    EXPECT_EQ(found, printable(found));
  }
}

}  // namespace
}  // namespace minkray
