// SPDX-License-Identifier: MIT
// The Embree sandwich, for shapes of any kind: casts at a shape against Embree's casts at a mesh
// within it and a mesh around it. A hit of the inner mesh is a hit, a miss of the outer mesh a
// miss, and t_outer <= t <= t_inner up to the error of Embree's t (EmbreeMesh::cast). Other
// rounding is smaller than the gap between the meshes and the shape.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "core/cast/cast.h"
#include "core/derived/sandwich.h"
#include "renderer/compare/embree_mesh.h"
#include "renderer/compare/gap_histogram.h"

namespace minkray {

struct CompareOptions {
  int rays = 100000;
  std::uint64_t seed = 1;
  SandwichOptions sandwich;
  CastOptions cast;
};

enum class Violation : unsigned char {
  false_hit,   ///< the outer mesh is missed, the shape was hit
  false_miss,  ///< the inner mesh is hit, the shape was missed
  early,       ///< t < t_outer
  late,        ///< t > t_inner
  gave_up,     ///< the solver answered exhausted
};
inline constexpr int violation_kinds = 5;
std::string_view name_of(Violation kind);

/// A ray whose answer is wrong, for reproduction: in the frame of the shape.
struct Violator {
  Violation kind;
  Ray<double> ray;
  Status status;
  double t;
  double t_outer, t_inner;  ///< infinite where the mesh was missed
  double bounds;            ///< excess, in units of Embree's bound; early and late only
};

struct CompareReport {
  int rank = 3;
  std::size_t inner_triangles = 0, outer_triangles = 0;
  int rays = 0;
  int hits = 0;
  int outer_hits = 0;
  std::int64_t supports = 0;
  std::array<int, violation_kinds> violations = {};
  /// Disagreements in which every triangle in double agrees with the solver: Embree's edge
  /// rounding.
  int embree_at_fault = 0;
  /// The furthest beyond t_outer or t_inner, in units of Embree's bound; at most 1 if none
  /// violates.
  double worst_in_bounds = 0;
  std::optional<Violator> worst;
  GapHistogram to_outer;  ///< t - t_outer, as a length in the sandwich's frame
  GapHistogram to_inner;  ///< t_inner - t

  int total_violations() const;
  double hit_rate() const { return rays > 0 ? double(hits) / rays : 0; }
  double outer_hit_rate() const { return rays > 0 ? double(outer_hits) / rays : 0; }
};

/// Verdict on one ray. All parameters are those of that ray.
struct Verdict {
  CastResult<double> result;
  double t_outer = std::numeric_limits<double>::infinity();  ///< infinite if the mesh was missed
  double t_inner = std::numeric_limits<double>::infinity();
  double bounds = 0;  ///< excess over t_outer or t_inner, in units of Embree's bound
  std::optional<Violation> violation;
  bool embree_at_fault = false;
};

/// A ray in the sandwich's frame. Starts near the shape, has unit length and numbers in float, so
/// that Embree and the solver get the same one; t_world = t_base + t * t_per_length.
struct RayInFrame {
  Ray<float> ray;
  double t_base = 0;
  double t_per_length = 1;
};

/// A shape, its sandwich in Embree, and the comparison of the two.
class SandwichedShape {
 public:
  /// Throws std::runtime_error if Qhull or Embree fails.
  explicit SandwichedShape(const Shape& shape, const SandwichOptions& options = {});

  /// Casts a ray of the frame at meshes and shape.
  Verdict judge(const Ray<float>& ray, const CastOptions& options = {}) const;

  /// Gives the ray to the solver, in the shape's own frame; t stays.
  Ray<double> to_shape(const Ray<float>& ray) const;

  /// A ray of the shape's frame from outside of the shape, up to rounding to float.
  RayInFrame to_frame(const Ray<double>& ray) const;

  /// Rays start outside of the shape, in all directions, aimed so that about half of them hit (for
  /// segments and points: hit the outer mesh). The sandwich's own options are not used.
  CompareReport compare(const CompareOptions& options) const;

  Bounds<double> bounds() const { return prepared_.definition().bounds_of(Affine<double>{}); }

 private:
  PreparedShape prepared_;
  Sandwich sandwich_;
  EmbreeMesh inner_, outer_;
};

/// Both in one.
CompareReport compare_with_embree(const Shape& shape, const CompareOptions& options = {});

}  // namespace minkray
