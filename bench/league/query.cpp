// SPDX-License-Identifier: MIT
#include "bench/league/query.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace league {
namespace {

using Json = nlohmann::json;

/// A turn is taken for one up to the rounding of reports' numbers.
constexpr double turned = 1e-5;

struct Map {
  Rows linear = {Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}};
  Vec at = {};
};

Vec vec(const Json& json) {
  return {json.at(0), json.at(1), json.at(2)};
}

Vec mapped(const Map& map, const Vec& p) {
  const Vec q = league::mapped(map.linear, p);
  return {q[0] + map.at[0], q[1] + map.at[1], q[2] + map.at[2]};
}

Map joined(const Map& outer, const Map& inner) {
  Map map;
  map.at = mapped(outer, inner.at);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      map.linear[i][j] = 0;
      for (std::size_t k = 0; k < 3; ++k)
        map.linear[i][j] += outer.linear[i][k] * inner.linear[k][j];
    }
  return map;
}

Map map_of(const Json& json) {
  Map map;
  if (json.contains("matrix")) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Json& row = json["matrix"][i];
      map.linear[i] = vec(row);
      if (row.size() == 4) map.at[i] = row[3];
    }
    return map;
  }
  if (json.contains("translate")) map.at = vec(json["translate"]);
  Vec scale = {1, 1, 1};
  if (json.contains("scale")) {
    const Json& s = json["scale"];
    scale = s.is_array() ? vec(s) : Vec{s, s, s};
  }
  double x = 0, y = 0, z = 0, w = 1;
  if (json.contains("rotate")) {
    const Json& q = json["rotate"];
    x = q[0], y = q[1], z = q[2], w = q[3];
    const double length = std::sqrt(x * x + y * y + z * z + w * w);
    x /= length, y /= length, z /= length, w /= length;
  }
  map.linear = {Vec{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                Vec{2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                Vec{2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
  for (Vec& row : map.linear)
    for (std::size_t j = 0; j < 3; ++j) row[j] *= scale[j];
  return map;
}

bool is_turn(const Rows& m) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (std::abs(dot(m[i], m[j]) - (i == j ? 1 : 0)) > turned) return false;
  return true;
}

/// The capsule around a segment, or a ball.
Solid rounded(double radius, const std::vector<Vec>& points, Map& map) {
  Solid solid;
  const Vec a = points.front(), b = points.back();
  const Vec half = {(b[0] - a[0]) / 2, (b[1] - a[1]) / 2, (b[2] - a[2]) / 2};
  const double length = std::sqrt(dot(half, half));
  solid.kind = length > 0 ? Kind::capsule : Kind::sphere;
  solid.sizes = {radius, length, 0};
  Map inner;
  inner.at = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
  if (length > 0) {
    const Vec z = {half[0] / length, half[1] / length, half[2] / length};
    const Vec u = std::abs(z[0]) < 0.6 ? Vec{1, 0, 0} : Vec{0, 1, 0};
    Vec x = {u[1] * z[2] - u[2] * z[1], u[2] * z[0] - u[0] * z[2], u[0] * z[1] - u[1] * z[0]};
    const double side = std::sqrt(dot(x, x));
    for (double& entry : x) entry /= side;
    const Vec y = {z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]};
    for (std::size_t i = 0; i < 3; ++i) inner.linear[i] = {x[i], y[i], z[i]};
  }
  map = joined(map, inner);
  return solid;
}

Solid read_solid(const Json& top) {
  Map map;
  const Json* json = &top;
  while (json->at("type") == "transform") {
    map = joined(map, map_of(*json));
    json = &json->at("shape");
  }
  const std::string type = json->at("type");
  Solid solid;
  const auto round = [&](Kind kind) {
    solid.kind = kind;
    solid.sizes = {json->at("radius"), json->value("half_height", 0.0), 0};
  };
  if (type == "point") {
    solid.points = {json->contains("position") ? vec((*json)["position"]) : Vec{}};
  } else if (type == "segment" || type == "triangle" || type == "hull") {
    for (const Json& p : json->at("points")) solid.points.push_back(vec(p));
  } else if (type == "box") {
    solid.kind = Kind::box;
    solid.sizes = vec(json->at("half_extents"));
  } else if (type == "sphere") {
    round(Kind::sphere);
  } else if (type == "capsule") {
    round(Kind::capsule);
  } else if (type == "cylinder") {
    round(Kind::cylinder);
  } else if (type == "cone") {
    round(Kind::cone);
  } else if (type == "disk") {
    round(Kind::disk);
  } else if (type == "ellipsoid") {
    solid.kind = Kind::ellipsoid;
    solid.sizes = vec(json->at("radii"));
  } else if (type == "frustum") {
    solid.kind = Kind::frustum;
    solid.sizes = {json->at("radii")[0], json->at("half_height"), json->at("radii")[1]};
  } else if (type == "rounded" && json->at("shape").at("type") == "segment") {
    std::vector<Vec> ends;
    for (const Json& p : json->at("shape").at("points")) ends.push_back(vec(p));
    solid = rounded(json->at("radius"), ends, map);
  } else {
    throw Unsupported{type};
  }
  if (!is_turn(map.linear)) {
    if (solid.kind == Kind::box) {
      for (int i = 0; i < 8; ++i)
        solid.points.push_back({(i & 1 ? 1 : -1) * solid.sizes[0],
                                (i & 2 ? 1 : -1) * solid.sizes[1],
                                (i & 4 ? 1 : -1) * solid.sizes[2]});
      solid.kind = Kind::hull;
    }
    if (solid.kind != Kind::hull) throw Unsupported{"a map that is no turn"};
    for (Vec& p : solid.points) p = league::mapped(map.linear, p);
    map.linear = Map().linear;
  }
  solid.turn = map.linear;
  solid.at = map.at;
  return solid;
}

double extent(const Solid& solid) {
  double most = 0;
  for (std::size_t k = 0; k < 3; ++k)
    for (const double sign : {-1.0, 1.0}) {
      Vec n = {};
      n[k] = sign;
      most = std::max(most, std::abs(solid.support(n)[k]));
    }
  return most;
}

}  // namespace

Query read_query(const Json& json) {
  Query query;
  const std::string asked = json.at("query");
  const Json* t_max = nullptr;
  if (asked == "ray") {
    query.asked = Asked::ray;
    query.a = read_solid(json.at("shape"));
    query.origin = vec(json.at("ray").at("origin"));
    query.direction = vec(json.at("ray").at("direction"));
    if (json["ray"].contains("t_max")) t_max = &json["ray"]["t_max"];
    query.size = std::max({extent(query.a), std::abs(query.origin[0]), std::abs(query.origin[1]),
                           std::abs(query.origin[2])});
  } else {
    query.asked = asked == "shape"      ? Asked::shape
                  : asked == "distance" ? Asked::distance
                                        : Asked::signed_distance;
    const bool moves = query.asked == Asked::shape;
    query.a = read_solid(json.at(moves ? "obstacle" : "a"));
    query.b = read_solid(json.at(moves ? "moving" : "b"));
    query.size = std::max(extent(query.a), extent(query.b));
    if (moves) {
      query.direction = vec(json.at("direction"));
      if (json.contains("obstacle_direction")) {
        const Vec of_a = vec(json["obstacle_direction"]);
        for (std::size_t k = 0; k < 3; ++k) query.direction[k] -= of_a[k];
      }
      if (json.contains("t_max")) t_max = &json["t_max"];
    }
  }
  const double speed = std::sqrt(dot(query.direction, query.direction));
  query.t_max = t_max ? double(*t_max) : speed > 0 ? 4 * query.size / speed : 1;
  return query;
}

}  // namespace league
