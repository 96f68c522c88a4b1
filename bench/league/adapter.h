// SPDX-License-Identifier: MIT
// Common part of programs that answer queries of tests/cases line by line: reads them as any other
// solver would, independent of Minkray.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace league {

using Vec = std::array<double, 3>;
using Rows = std::array<Vec, 3>;

/// Ends of a capsule and the points of what is flat or a hull are in the shape's own frame, like
/// all else; capsules, cylinders, cones and frusta are around the z axis.
enum class Kind { hull, box, sphere, ellipsoid, disk, cylinder, cone, frustum, capsule };

struct Solid {
  Kind kind = Kind::hull;
  Vec sizes = {};  ///< half extents, radii; or the radius (of a frustum both) and the half height
  std::vector<Vec> points;  ///< of a hull: one or more, also of segments and triangles
  Rows turn = {Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}};
  Vec at = {};

  Vec placed(const Vec& p) const;
  Vec support(const Vec& direction) const;  ///< in the world
};

enum class Asked { ray, shape, distance, signed_distance };

struct Query {
  Asked asked = Asked::ray;
  Solid a;  ///< the shape, the obstacle, or the first one
  Solid b;  ///< the moving one, or the second one
  Vec origin = {}, direction = {};
  double t_max = 0;  ///< if the query has none: until far behind the shapes
  double size = 0;   ///< extent of the shapes, with the ray's origin
};

struct Answer {
  enum class Status { hit, miss, separated, overlapping, failed, unsupported } status;
  std::optional<double> value = {};  ///< t of a hit; the distance, less the depth
  std::string why = {};
};

inline Answer unsupported(const std::string& why) {
  return {Answer::Status::unsupported, {}, why};
}
inline Answer failed(const std::string& why) {
  return {Answer::Status::failed, {}, why};
}
inline Answer hit(double t) {
  return {Answer::Status::hit, t};
}
inline Answer miss() {
  return {Answer::Status::miss};
}
Answer at_distance(double distance);

/// A prepared query, in the solver's own types. Running it is timed.
using Ask = std::function<Answer()>;

struct Solver {
  std::string name, version, settings;
  std::function<Ask(const Query&)> prepare;
  std::function<Ask(const std::string&)> prepare_line = {};  ///< in its place: of who reads JSON
};

/// Triangles of the hull of points, all that a face may be cut into.
std::vector<std::array<int, 3>> hull_triangles(const std::vector<Vec>& points);
Vec quaternion_xyz(const Rows& turn, double& w);

/// Answers stdin, a line a query, by one of the solvers: the one that the first argument names.
int serve(int argc, char** argv, const std::vector<Solver>& solvers);

}  // namespace league
