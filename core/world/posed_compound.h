// SPDX-License-Identifier: MIT
// A compound with its pose, prepared for rays: placements of its parts and a BVH of their boxes in
// the world.
#pragma once

#include <memory>
#include <vector>

#include "core/bvh/bvh.h"
#include "core/cast/cast.h"
#include "core/model/shape_definition.h"
#include "core/world/posed_mesh.h"

namespace minkray {

class Compound;
struct QueryCounts;

struct PosedCompound {
  std::uint32_t instance = 0;
  std::shared_ptr<const Compound> compound;
  Affine<double> pose;  ///< maps the compound's frame to the world
  std::vector<ShapeDefinition::Placement> parts;
  Bvh boxes;  ///< of the parts
  Bounds<double> bounds;

  PosedCompound() = default;
  PosedCompound(std::uint32_t number, std::shared_ptr<const Compound> of, const Affine<double>& at);
};

/// Pads a box for the rounding of support points and of a solver's hits.
Bounds<double> padded(const Bounds<double>& bounds);

/// Bounding box of a compound under a pose.
Bounds<double> bounds_under(const Compound& compound, const Affine<double>& pose);

/// Finds the first part that the ray hits; parts at the same t by number. A part that contains the
/// ray's origin is hit at t = 0 (`inside`). `most`, `leaves` and `loss` are those of the same
/// function for meshes. Returns `exhausted` if no part is hit and a cast did not converge.
PartCast cast_ray(const PosedCompound& posed, const Ray<double>& ray, double most, bool leaves,
                  double loss, const CastOptions& options, QueryCounts& counts);
/// True if the ray hits a part at t <= ray.t_max.
bool is_met(const PosedCompound& posed, const Ray<double>& ray, bool leaves, double loss,
            const CastOptions& options, QueryCounts& counts);
/// Finds where the ray leaves the last of all parts. The status is `inside` if the ray's end is in
/// a part.
PartCast cast_last_exit(const PosedCompound& posed, const Ray<double>& ray,
                        const CastOptions& options, QueryCounts& counts);
/// Appends each part's entry and exit, sorted by part.
void add_crossings(const PosedCompound& posed, const Ray<double>& ray, double loss,
                   const CastOptions& options, QueryCounts& counts, std::vector<PartCrossing>& to);

/// Entry and exit of a convex shape. A ray that begins inside has no entry.
struct ShapeCrossings {
  int count = 0;
  PartCrossing at[2];
};
ShapeCrossings crossings_of(const PreparedShape& shape, std::uint32_t part, const Ray<double>& ray,
                            const CastOptions& options, QueryCounts& counts);

}  // namespace minkray
