// SPDX-License-Identifier: MIT
#include "renderer/query/query_json.h"

#include "renderer/json/object_reader.h"
#include "renderer/json/parse.h"
#include "renderer/json/values.h"
#include "renderer/query/read_body.h"

namespace minkray {
namespace {

/// Limit of steps; each step costs a cast more.
constexpr int most_steps = 1000000;
/// Largest tilt: beyond it, a direction misses the other side.
constexpr double most_tilt = 0.5;

class QueryReader {
 public:
  QueryReader(ObjectReader& object, MeshFiles& meshes) : object_(object), meshes_(meshes) {}

  std::optional<QueryBody> body(std::string_view key) {
    const Json* json = object_.require(key, "a shape, or an object with a mesh");
    if (!json) return std::nullopt;
    return read_body(*json, object_.path(key), object_.mistakes(), meshes_);
  }

  void vector(ObjectReader& from, std::string_view key, Vec3<double>& value, bool required) {
    const Json* json = required ? from.require(key, "a list of 3 numbers") : from.find(key);
    if (!json) return;
    if (const auto read = read_vector(*json, from.path(key), from.mistakes())) value = *read;
  }

  /// A ray's: not zero.
  void direction(ObjectReader& from, Vec3<double>& value) {
    const Json* json = from.require("direction", "a list of 3 numbers");
    if (!json) return;
    const auto read = read_vector(*json, from.path("direction"), from.mistakes());
    if (read && read->isZero(0))
      from.mistakes().add(from.path("direction"), "must not be zero (got [0, 0, 0])");
    if (read) value = *read;
  }

  void t_max(ObjectReader& from, double& value) {
    if (const Json* json = from.find("t_max"))
      if (const auto read =
              read_number(*json, from.path("t_max"), from.mistakes(), Range::not_negative))
        value = *read;
  }

  void read_ray(std::optional<Query>& query) {
    const auto what = body("shape");
    RayQuery read{{}, {Vec3<double>::Zero(), Vec3<double>::Zero()}};
    if (const Json* json = object_.require("ray", "an object")) {
      ObjectReader ray(*json, object_.path("ray"), object_.mistakes());
      vector(ray, "origin", read.ray.origin, true);
      direction(ray, read.ray.direction);
      t_max(ray, read.ray.t_max);
      ray.finish();
    }
    if (!what) return;
    read.body = *what;
    query->kind = std::move(read);
  }

  void read_shapes(std::optional<Query>& query) {
    const auto moving = body("moving"), obstacle = body("obstacle");
    ShapeQuery read;
    vector(object_, "direction", read.direction, true);
    vector(object_, "obstacle_direction", read.obstacle_direction, false);
    vector(object_, "turn", read.turn, false);
    vector(object_, "obstacle_turn", read.obstacle_turn, false);
    if (const Json* steps = object_.find("steps"))
      if (const auto n =
              read_integer(*steps, object_.path("steps"), object_.mistakes(), 1, most_steps))
        read.steps = *n;
    t_max(object_, read.t_max);
    if (read.turns() && !(read.t_max < std::numeric_limits<double>::infinity()))
      object_.mistakes().add(object_.path("t_max"), "missing: shapes that turn need one");
    if (!moving || !obstacle) return;
    read.moving = *moving;
    read.obstacle = *obstacle;
    query->kind = std::move(read);
  }

  void read_distance(std::optional<Query>& query) {
    const auto a = body("a"), b = body("b");
    if (a && b) query->kind = DistanceQuery{{*a, *b}};
  }

  void read_signed_distance(std::optional<Query>& query) {
    const auto a = body("a"), b = body("b");
    SignedDistanceQuery read;
    if (const Json* json = object_.find("at_most"))
      if (const auto number =
              read_number(*json, object_.path("at_most"), object_.mistakes(), Range::any))
        read.at_most = *number;
    if (const Json* json = object_.find("only_sign"))
      if (const auto flag = read_bool(*json, object_.path("only_sign"), object_.mistakes()))
        read.only_sign = *flag;
    if (!a || !b) return;
    read.a = *a;
    read.b = *b;
    query->kind = std::move(read);
  }

  void read_manifold(std::optional<Query>& query) {
    const auto a = body("a"), b = body("b");
    ManifoldQuery read;
    const auto number = [&](std::string_view key, std::optional<double>& value) {
      if (const Json* json = object_.find(key))
        value = read_number(*json, object_.path(key), object_.mistakes(), Range::not_negative);
    };
    number("tilt", read.tilt);
    number("within", read.within);
    if (read.tilt && !(*read.tilt < most_tilt))
      object_.mistakes().add(object_.path("tilt"), "must be less than 0.5 radians");
    if (!a || !b) return;
    read.a = *a;
    read.b = *b;
    for (const char* key : {"tilt", "within"})
      if (read.has_mesh() && object_.find(key))
        object_.mistakes().add(object_.path(key), "not allowed with a mesh");
    query->kind = std::move(read);
  }

  ImpactMotion motion(std::string_view key) {
    ImpactMotion read;
    const Json* json = object_.find(key);
    if (!json) return read;
    ObjectReader motion(*json, object_.path(key), object_.mistakes());
    vector(motion, "velocity", read.velocity, false);
    vector(motion, "turn", read.turn, false);
    if (const Json* pivot = motion.find("pivot"))
      if (const auto point = read_vector(*pivot, motion.path("pivot"), motion.mistakes()))
        read.pivot = *point;
    motion.finish();
    return read;
  }

  void read_impact(std::optional<Query>& query) {
    const auto a = body("a"), b = body("b");
    ImpactQuery read;
    read.motion_a = motion("motion_a");
    read.motion_b = motion("motion_b");
    if (object_.require("t_max", "a number")) t_max(object_, read.t_max);
    if (!a || !b) return;
    read.a = *a;
    read.b = *b;
    query->kind = std::move(read);
  }

 private:
  ObjectReader& object_;
  MeshFiles& meshes_;
};

Expectation read_expectation(const Json& json, const JsonPath& path, Mistakes& mistakes) {
  Expectation expect;
  ObjectReader object(json, path, mistakes);
  const auto number = [&](std::string_view key, auto& value, Range range) {
    if (const Json* found = object.find(key))
      if (const auto read = read_number(*found, object.path(key), mistakes, range)) value = *read;
  };
  const auto flag = [&](std::string_view key, auto& value) {
    if (const Json* found = object.find(key))
      if (const auto read = read_bool(*found, object.path(key), mistakes)) value = *read;
  };
  flag("hit", expect.hit);
  flag("either", expect.either);
  number("t", expect.t, Range::any);
  number("t_abs_tol", expect.t_abs_tol, Range::not_negative);
  number("distance", expect.distance, Range::any);
  number("abs_tol", expect.abs_tol, Range::not_negative);
  if (const Json* normal = object.find("normal"))
    if (const auto read = read_vector(*normal, object.path("normal"), mistakes))
      expect.normal = *read;
  object.finish();
  return expect;
}

}  // namespace

std::optional<Query> parse_query(std::string_view text, MeshFiles& meshes, Mistakes& mistakes) {
  const std::optional<Json> json = parse_json(text, mistakes);
  if (!json || !mistakes.none()) return std::nullopt;
  ObjectReader object(*json, JsonPath(), mistakes);
  if (!object.is_object()) return std::nullopt;

  std::optional<Query> query(Query{{}, DistanceQuery{}, {}});
  // Descriptive keys of a published case and its proof (tests/cases).
  object.allow({"was", "source", "numbers", "certificate"});
  if (const Json* name = object.find("name"))
    if (const auto read = read_string(*name, object.path("name"), mistakes)) query->name = *read;
  if (const Json* expect = object.find("expect"))
    query->expect = read_expectation(*expect, object.path("expect"), mistakes);

  QueryReader reader(object, meshes);
  constexpr const char* kinds =
      R"("ray", "shape", "distance", "signed_distance", "manifold" or "impact")";
  const Json* kind = object.require("query", kinds);
  if (!kind) return std::nullopt;
  if (*kind == "ray") {
    reader.read_ray(query);
  } else if (*kind == "shape") {
    reader.read_shapes(query);
  } else if (*kind == "distance") {
    reader.read_distance(query);
  } else if (*kind == "signed_distance") {
    reader.read_signed_distance(query);
  } else if (*kind == "manifold") {
    reader.read_manifold(query);
  } else if (*kind == "impact") {
    reader.read_impact(query);
  } else {
    mistakes.add(object.path("query"), std::string("must be ") + kinds + " (" + found(*kind) + ")");
    return std::nullopt;
  }
  object.finish();
  if (!mistakes.none()) return std::nullopt;
  return query;
}

}  // namespace minkray
