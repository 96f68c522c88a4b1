// SPDX-License-Identifier: MIT
// A triangle mesh in Embree, with bounds of Embree's errors. Only this file uses Embree.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "core/derived/sandwich.h"
#include "core/math/ray.h"

namespace minkray {

struct MeshHit {
  double t;
  /// Error bound of Embree's t (as a parameter, like t), for the mesh with vertices in float: see
  /// EmbreeMesh::cast.
  double t_bound;
  unsigned triangle;
};

/// The mesh's vertices are rounded to float. Meshes without triangles are hit by nothing.
class EmbreeMesh {
 public:
  explicit EmbreeMesh(const Mesh& mesh);
  ~EmbreeMesh();
  EmbreeMesh(EmbreeMesh&&) noexcept;
  EmbreeMesh& operator=(EmbreeMesh&&) noexcept;

  /// The nearest triangle that the ray meets, from either side, with Embree's robust flag.
  ///
  /// The bound, with u = 2^-24 and gamma_k = k u / (1 - k u) (Higham 2002, section 3.1): Embree's
  /// robust test moves the vertices by the ray's origin, rounding each to u of its distance d,
  /// takes the cross product N of two edges, and answers t = (v0 . N) / (D . N) with a reciprocal
  /// good to two units. Rounding of v0 and both products moves the plane by at most gamma_9 d, that
  /// of N (gamma_3 of the product of two edges of length L at most, relative to N = twice the area)
  /// turns it by gamma_3 L^2 / |N|, which moves points up to L from v0 by L times that. Slightly
  /// rounded up, along a ray at an angle of cosine c to the normal:
  ///
  ///     |error of t| |D| c <= gamma_12 (d + L^3 / |N|)
  std::optional<MeshHit> cast(const Ray<float>& ray) const;

  /// Tests every triangle, in double, with errors of 1e-15 at edges: returns the parameter at
  /// which the ray first meets the mesh, if it does. The referee where Embree and a solver
  /// disagree: in float a ray may slip through between two slivers.
  std::optional<double> nearest(const Ray<float>& ray) const;

 private:
  std::array<Vec3<double>, 3> corners(unsigned triangle) const;

  struct Scene;
  std::unique_ptr<Scene> scene_;
  std::vector<Vec3<float>> vertices_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
};

}  // namespace minkray
