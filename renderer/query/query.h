// SPDX-License-Identifier: MIT
// Queries of `minkray cast` as plain data, and the expected result of a case.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <variant>

#include "core/math/ray.h"
#include "renderer/query/query_body.h"

namespace minkray {

/// Query for where a ray enters a body.
struct RayQuery {
  QueryBody body;
  Ray<double> ray;

  bool has_mesh() const { return body.mesh != nullptr; }
};

/// When the moving body first touches the obstacle. Each is moved by t times its direction and, if
/// it has a turn, turned by t times that (a rotation vector, radians) about its frame's origin.
struct ShapeQuery {
  QueryBody moving;
  QueryBody obstacle;
  Vec3<double> direction = Vec3<double>::Zero();
  Vec3<double> obstacle_direction = Vec3<double>::Zero();
  Vec3<double> turn = Vec3<double>::Zero();
  Vec3<double> obstacle_turn = Vec3<double>::Zero();
  int steps = 64;  ///< of fixed orientation, if anything turns
  double t_max = std::numeric_limits<double>::infinity();

  bool turns() const { return !turn.isZero(0) || !obstacle_turn.isZero(0); }
  bool has_mesh() const { return moving.mesh || obstacle.mesh; }
};

/// Two bodies.
struct PairQuery {
  QueryBody a;
  QueryBody b;

  bool has_mesh() const { return a.mesh || b.mesh; }
};

/// Query for the distance of two bodies.
struct DistanceQuery : PairQuery {};

/// Query for the signed distance of two bodies (core/pair_distance/signed_distance.h).
struct SignedDistanceQuery : PairQuery {
  double at_most = std::numeric_limits<double>::infinity();
  bool only_sign = false;
};

/// Up to four points of contact (core/pair_distance/manifold.h).
struct ManifoldQuery : PairQuery {
  std::optional<double> tilt;    ///< radians
  std::optional<double> within;  ///< in sizes of the smaller shape
};

/// Motion of a body of an impact: its pivot by `velocity`, and about that by `turn`.
struct ImpactMotion {
  Vec3<double> velocity = Vec3<double>::Zero();
  Vec3<double> turn = Vec3<double>::Zero();   ///< rotation vector, radians per unit of time
  Vec3<double> pivot = Vec3<double>::Zero();  ///< by default the origin of the body's frame
};

/// When two bodies that move and turn first touch, with proof (core/pair_motion/impact.h).
struct ImpactQuery : PairQuery {
  ImpactMotion motion_a;
  ImpactMotion motion_b;
  double t_max = 0;
};

/// Expected result: the part of a case that --check compares.
struct Expectation {
  std::optional<bool> hit;
  bool either = false;  ///< the ray just touches: hit and miss are both right
  std::optional<double> t;
  double t_abs_tol = 0;
  std::optional<Vec3<double>> normal;
  std::optional<double> distance;
  double abs_tol = 0;
};

struct Query {
  std::string name;
  std::variant<RayQuery, ShapeQuery, DistanceQuery, SignedDistanceQuery, ManifoldQuery, ImpactQuery>
      kind;
  std::optional<Expectation> expect;
};

}  // namespace minkray
