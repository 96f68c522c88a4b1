// SPDX-License-Identifier: MIT
// Queries of `minkray cast` at meshes, compared with all triangles in long double.
#include <gtest/gtest.h>

#include <map>

#include "renderer/json/number_json.h"
#include "renderer/member_json/member_codec.h"
#include "renderer/query/answer.h"
#include "renderer/query/query_json.h"
#include "tests/support/mesh_truth.h"
#include "tests/support/messages.h"
#include "tests/support/number_of_cases.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"

namespace minkray {
namespace {

Json mesh_body(const testing::Surface& surface, const Affine<double>& pose) {
  Json vertices = Json::array(), triangles = Json::array(), matrix = Json::array();
  for (const Vec3<double>& v : surface.vertices) vertices.push_back(point_json(v));
  for (const Corners& t : surface.triangles) triangles.push_back(Json::array({t[0], t[1], t[2]}));
  for (int row = 0; row < 3; ++row)
    matrix.push_back(Json::array(
        {pose.linear(row, 0), pose.linear(row, 1), pose.linear(row, 2), pose.translation[row]}));
  return {{"mesh", {{"vertices", std::move(vertices)}, {"triangles", std::move(triangles)}}},
          {"transform", {{"matrix", std::move(matrix)}}}};
}

Json ball_body(double radius, const Vec3<double>& at) {
  return {{"type", "transform"},
          {"shape", {{"type", "sphere"}, {"radius", radius}}},
          {"translate", point_json(at)}};
}

Answer answer_of(const Json& json, const AnswerOptions& options = {}) {
  Mistakes mistakes("q");
  MeshFiles files{std::filesystem::path()};
  const auto query = parse_query(json.dump(), files, mistakes);
  EXPECT_TRUE(query) << mistakes.text();
  return query ? answer(*query, options) : Answer();
}

std::string mistakes_of_mesh_query(const std::string& text) {
  Mistakes mistakes("q");
  MeshFiles files{std::filesystem::path()};
  EXPECT_FALSE(parse_query(text, files, mistakes));
  return mistakes.text();
}

Vec3<double> vector_of(const Json& json) {
  return {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
}

/// Turned, moved and, for every third, scaled unevenly.
Affine<double> pose_of_mesh(testing::Random& random, int i) {
  Mat3<double> linear = random.rotation();
  if (i % 3 == 2) linear *= Vec3<double>(1.3, 0.7, 1.1).asDiagonal();
  return {linear, 0.5 * random.in_cube()};
}

TEST(MeshQueries, rays_meet_the_first_of_all_triangles) {
  const testing::Surface ring = testing::torus(14, 9);
  testing::Random random(1);
  AnswerOptions options;
  options.certify = options.trace = true;
  int hits = 0, misses = 0;
  for (int i = 0; i < testing::number_of_cases(200); ++i) {
    const Affine<double> pose = pose_of_mesh(random, i);
    const testing::MeshTruth truth(ring, pose);
    Ray<double> ray{4 * random.direction(), {}};
    ray.direction = pose.translation + random.in_cube() - ray.origin;
    if (i % 5 == 4) ray.t_max = 0.8;
    const Json at = {{"origin", point_json(ray.origin)}, {"direction", point_json(ray.direction)}};
    Json query = {{"query", "ray"}, {"shape", mesh_body(ring, pose)}, {"ray", at}};
    if (i % 5 == 4) query["ray"]["t_max"] = ray.t_max;
    const Answer found = answer_of(query, options);
    const testing::MeshTruth::Hit first = truth.first_hit(ray);
    ASSERT_EQ(found.facts.status, first.found() ? "hit" : "miss") << i;
    ASSERT_TRUE(found.verdict.has_value());
    EXPECT_TRUE(found.verdict->holds) << i << ": " << found.verdict->complaint;
    EXPECT_GE(found.json.at("nodes").get<double>(), 1);
    if (!first.found()) {
      ++misses;
      EXPECT_EQ(found.json.find("t"), nullptr);
      EXPECT_EQ(found.json.find("triangle"), nullptr);
      continue;
    }
    ++hits;
    EXPECT_LE(found.json.at("t_lo").get<double>(), static_cast<double>(first.t));
    EXPECT_GE(found.json.at("t_hi").get<double>(), static_cast<double>(first.t));
    EXPECT_NEAR(found.facts.t, static_cast<double>(first.t), 1e-13);
    EXPECT_EQ(found.json.at("triangle").get<int>(), static_cast<int>(first.triangle));
    EXPECT_GE(found.json.at("triangles").get<double>(), 1);
    Vec3<double> normal = truth.normal(first.triangle).cast<double>();
    if (normal.dot(ray.direction) > 0) normal = -normal;
    EXPECT_LE((vector_of(found.json.at("normal")) - normal).norm(), 1e-13);
    const Vec3<double> point = ray.origin + found.facts.t * ray.direction;
    EXPECT_LE((vector_of(found.json.at("point")) - point).norm(), 1e-14);
    // The solver's last bound at the triangle is the hit.
    const Json& trace = found.json.at("trace");
    ASSERT_GT(trace.size(), 0u);
    EXPECT_NEAR(trace[trace.size() - 1].at("t_lo").get<double>(), found.facts.t, 1e-12);
  }
  EXPECT_GT(hits, 60);
  EXPECT_GT(misses, 30);
}

TEST(MeshQueries, distances_are_those_of_the_nearest_triangle) {
  const testing::Surface ring = testing::torus(14, 9);
  testing::Random random(2);
  int apart = 0, crossing = 0;
  for (int i = 0; i < testing::number_of_cases(120); ++i) {
    const Affine<double> pose = pose_of_mesh(random, i);
    const Vec3<double> at = 1.7 * random.in_cube();
    const double radius = 0.2;
    const auto gap = static_cast<double>(testing::MeshTruth(ring, pose).distance(at)) - radius;
    if (std::abs(gap) < 1e-6) continue;
    const Json ball = ball_body(radius, at), mesh = mesh_body(ring, pose);
    const bool is_first = i % 2 == 0;
    const auto query = [&](const char* kind) -> Json {
      return {{"query", kind}, {"a", is_first ? mesh : ball}, {"b", is_first ? ball : mesh}};
    };
    const Answer signed_one = answer_of(query("signed_distance")),
                 plain = answer_of(query("distance")), contact = answer_of(query("manifold"));
    if (signed_one.facts.status == "overlapping") {
      // Also a ball within the ring, whose surface is further away.
      ++crossing;
      EXPECT_EQ(signed_one.facts.distance, 0);
      EXPECT_EQ(plain.facts.status, "overlapping");
      EXPECT_EQ(contact.facts.status, "overlapping");
      continue;
    }
    ++apart;
    EXPECT_EQ(signed_one.facts.status, "separated");
    EXPECT_EQ(plain.facts.status, "separated");
    for (const Answer* found : {&signed_one, &plain}) {
      EXPECT_LE(found->json.at("lower").get<double>(), gap + 1e-14) << i;
      EXPECT_GE(found->json.at("upper").get<double>(), gap - 1e-14) << i;
      EXPECT_NEAR(found->facts.distance, gap, 1e-9);
      EXPECT_NE(found->json.find(is_first ? "triangle_a" : "triangle_b"), nullptr);
      EXPECT_EQ(found->json.find(is_first ? "triangle_b" : "triangle_a"), nullptr);
    }
    EXPECT_EQ(plain.json.at("distance").get<double>(), plain.facts.distance);
    ASSERT_GE(contact.json.at("points").size(), 1u);
    EXPECT_NEAR(contact.json.at("points")[0].at("distance").get<double>(), gap, 1e-9);
  }
  EXPECT_GT(apart, 30);
  EXPECT_GT(crossing, 10);
}

/// A ball moves at a mesh: it is in touch at t, and apart before.
TEST(MeshQueries, moving_bodies_meet_at_the_first_contact) {
  const testing::Surface ring = testing::torus(14, 9);
  testing::Random random(3);
  int hits = 0, misses = 0;
  for (int i = 0; i < testing::number_of_cases(90); ++i) {
    const Affine<double> pose = pose_of_mesh(random, i);
    const testing::MeshTruth truth(ring, pose);
    const double radius = 0.1;
    const Vec3<double> from = 3 * random.direction(),
                       velocity = 1.2 * random.in_cube() + pose.translation - from;
    const auto gap = [&](double t) {
      return static_cast<double>(truth.distance(from + t * velocity)) - radius;
    };
    const Json shape_query = {{"query", "shape"},
                              {"moving", ball_body(radius, from)},
                              {"obstacle", mesh_body(ring, pose)},
                              {"direction", point_json(velocity)}};
    const Json impact_query = {{"query", "impact"},
                               {"a", mesh_body(ring, pose)},
                               {"b", ball_body(radius, from)},
                               {"motion_b", {{"velocity", point_json(velocity)}}},
                               {"t_max", 10}};
    const Answer cast = answer_of(shape_query), impact = answer_of(impact_query);
    ASSERT_EQ(cast.facts.status, impact.facts.status) << i;
    const bool is_hit = cast.facts.status == "hit";
    const double end = is_hit ? cast.json.at("t_lo").get<double>() : 4;
    for (int k = 0; k < 200; ++k) EXPECT_GT(gap(end * k / 200), 0) << i;
    if (!is_hit) {
      ++misses;
      EXPECT_EQ(cast.facts.status, "miss");
      continue;
    }
    ++hits;
    EXPECT_NEAR(gap(cast.facts.t), 0, 1e-9) << i;
    EXPECT_GE(gap(end), -1e-12) << i;
    EXPECT_EQ(impact.json.at("t_lo").get<double>(), end);
    const Vec3<double> on_mesh = vector_of(cast.json.at("point_a"));
    EXPECT_NEAR(static_cast<double>(truth.distance(on_mesh)), 0, 1e-9);
    const Vec3<double> normal = vector_of(cast.json.at("normal"));
    EXPECT_NEAR((from + end * velocity - on_mesh - radius * normal).norm(), 0, 1e-6);
    EXPECT_NE(cast.json.find("triangle_a"), nullptr);
  }
  EXPECT_GT(hits, 25);
  EXPECT_GT(misses, 15);
}

TEST(MeshQueries, meshes_turn_about_the_pivot) {
  const testing::Surface block = testing::block({2, 0.5, 0.5});
  Affine<double> pose;
  pose.translation = {2, 0, 0};  // reaches from x = 0 to 4
  const double way = 3, radius = 0.25;
  const Json query = {{"query", "impact"},
                      {"a", mesh_body(block, pose)},
                      {"b", ball_body(radius, {0, way, 0})},
                      {"motion_a", {{"turn", {0, 0, 1}}}},
                      {"t_max", 3}};
  // Turned by t, the face y = 0.5 is 3 cos(t) - 0.5 away from the ball's middle.
  const double meets = std::acos((0.5 + radius) / way);
  const Answer found = answer_of(query);
  EXPECT_EQ(found.facts.status, "hit");
  EXPECT_NEAR(found.facts.t, meets, 1e-8);
  const Json cast = {{"query", "shape"},
                     {"moving", mesh_body(block, pose)},
                     {"obstacle", ball_body(radius, {0, way, 0})},
                     {"direction", {0, 0, 0}},
                     {"turn", {0, 0, 1}},
                     {"t_max", 3}};
  EXPECT_NEAR(answer_of(cast).facts.t, found.facts.t, 1e-8);
}

TEST(MeshQueries, height_fields_are_terrains) {
  const Json hill = Json::parse(
      R"({"height_field": {"heights": [[0, 0], [0, 2]], "size": [2, 2], "bottom": -1},
          "transform": {"translate": [5, 0, 0]}})");
  Json query = {{"query", "ray"}, {"shape", hill}};
  for (const double x : {4.5, 5.5}) {  // over the lower triangle the height is y + 1
    query["ray"] = {{"origin", {x, -0.5, 9}}, {"direction", {0, 0, -1}}};
    EXPECT_EQ(answer_of(query).facts.t, 8.5);
  }
  query["ray"] = {{"origin", {5, 0, -9}}, {"direction", {0, 0, 2}}};
  EXPECT_EQ(answer_of(query).facts.t, 4);
  const Json ball = ball_body(1, {5, 0, -4});
  EXPECT_NEAR(answer_of({{"query", "distance"}, {"a", hill}, {"b", ball}}).facts.distance, 2, 1e-9);
  EXPECT_EQ(answer_of({{"query", "distance"}, {"a", hill}, {"b", ball_body(0.1, {5, 0, -0.5})}})
                .facts.status,
            "overlapping");
}

/// std::invalid_argument ended the program: only std::runtime_error is a line's own mistake.
TEST(MeshQueries, meshes_that_leave_the_range_cannot_be_answered) {
  Affine<double> huge;
  huge.linear *= 1e95;
  const Json far = mesh_body(testing::block({1, 1, 1}), huge);
  Mistakes mistakes("q");
  MeshFiles files{std::filesystem::path()};
  const auto query =
      parse_query(Json{{"query", "distance"}, {"a", far}, {"b", ball_body(1, {0, 0, 0})}}.dump(),
                  files, mistakes);
  ASSERT_TRUE(query) << mistakes.text();
  EXPECT_THROW(answer(*query, {}), std::runtime_error);
}

TEST(MeshQueries, files_are_read_once_and_scaled) {
  const TemporaryFolder folder;
  folder.write("face.obj", "v 0 0 0\nv 8 0 0\nv 0 8 0\nf 1 2 3\n");
  MeshFiles files(folder.path());
  const auto parsed = [&] {
    Mistakes mistakes("q");
    auto query = parse_query(
        R"({"query":"ray","shape":{"mesh":{"file":"face.obj","scale":0.5}},"ray":{"origin":[1,1,3],"direction":[0,0,-2]}})",
        files, mistakes);
    EXPECT_TRUE(query) << mistakes.text();
    return std::get<RayQuery>(query->kind);
  };
  const RayQuery first = parsed(), second = parsed();
  EXPECT_EQ(first.body.mesh, second.body.mesh);
  EXPECT_EQ(answer({"", first, {}}, {}).facts.t, 1.5);
}

TEST(MeshQueries, mistakes_name_what_was_expected) {
  const std::string face = R"({"vertices":[[0,0,0],[1,0,0],[0,1,0]],"triangles":[[0,1,2]]})";
  const std::string ray = R"(,"ray":{"origin":[0,0,1],"direction":[0,0,-1]}})";
  const std::map<std::string, std::string> message = {
      {R"({"query":"ray","shape":{"mesh":{"vertices":[[0,0,0],[1,0,0],[0,1,0]],"triangles":[[0,1,3]]}})" +
           ray,
       "/shape/mesh: "},
      {R"({"query":"ray","shape":{"mesh":{"file":"none.obj"}})" + ray, "/shape/mesh/file: "},
      {R"({"query":"ray","shape":{"mesh":)" + face + R"(,"type":"sphere"})" + ray,
       "/shape/type: not allowed together with \"mesh\""},
      {R"({"query":"ray","shape":{"mesh":)" + face + R"(,"height_field":{}})" + ray,
       "/shape/height_field: not allowed together with \"mesh\""},
      {R"({"query":"ray","shape":{"mesh":)" + face + R"(,"transfrom":{}})" + ray,
       "/shape/transfrom: unknown key (did you mean \"transform\"?)"},
      {R"({"query":"ray","shape":{"mesh":)" + face + R"(,"transform":{"scale":0}})" + ray,
       "/shape/transform/scale: "},
      {R"({"query":"ray","shape":{"height_field":{"heights":[[0,1]],"size":[1,1]}})" + ray,
       "/shape/height_field/heights: must be a list of rows"},
      {R"({"query":"manifold","tilt":0.1,"a":{"mesh":)" + face + R"(},"b":{"type":"point"}})",
       "/tilt: not allowed with a mesh"},
      {R"({"query":"ray","shape":{"type":"minkowski_sum","shapes":[{"mesh":)" + face + "}]}" + ray,
       "/shape/shapes/0"}};
  for (const auto& [line, part] : message)
    EXPECT_TRUE(has(mistakes_of_mesh_query(line), part)) << mistakes_of_mesh_query(line);
}

}  // namespace
}  // namespace minkray
