// SPDX-License-Identifier: MIT
#include "core/world/posed_compound.h"

#include <algorithm>
#include <tuple>

#include "core/bvh/traverse.h"
#include "core/math/outward_sum.h"
#include "core/parts/compound.h"
#include "core/query/tolerances.h"
#include "core/world/world_ray.h"

namespace minkray {
namespace {

/// In machine epsilons of the box's size plus its distance from the world's origin.
constexpr int bounds_padding = 32;

PreparedShape prepared(const PosedCompound& posed, std::uint32_t part, double loss) {
  const ShapeDefinition::Placement& placement = posed.parts[part];
  const Mat3<double>* const turn = placement.is_rigid_identity ? nullptr : &placement.to_inner;
  if (loss > 0) loss *= placement.to_inner.norm();
  return {posed.compound->definition(part), placement.centre, turn, placement.loss + loss};
}

/// Hits up to this t are of the part that the ray leaves.
double t_of_leaving(const PosedCompound& posed, const Ray<double>& ray) {
  const Vec3<double> from = ray.origin - posed.bounds.centre();
  const double reach = posed.bounds.reach_of_centre().maxCoeff() + from.cwiseAbs().maxCoeff();
  return leaving_mesh * reach / ray.direction.cwiseAbs().maxCoeff();
}

}  // namespace

Bounds<double> padded(const Bounds<double>& bounds) {
  const double size = bounds.lower.cwiseAbs().cwiseMax(bounds.upper.cwiseAbs()).maxCoeff();
  const double padding = bounds_padding * tolerance::epsilon<double> * size;
  return {(bounds.lower.array() - padding).matrix(), (bounds.upper.array() + padding).matrix()};
}

PosedCompound::PosedCompound(std::uint32_t number, std::shared_ptr<const Compound> of,
                             const Affine<double>& at)
    : instance(number), compound(std::move(of)), pose(at) {
  std::vector<Bounds<float>> of_parts;
  for (std::size_t i = 0; i < compound->size(); ++i) {
    const ShapeDefinition& definition = compound->definition(i);
    parts.push_back(definition.placed(at));
    const Bounds<double> box = padded(definition.bounds_of(at));
    bounds.extend(box);
    of_parts.push_back(rounded_outwards(box));
  }
  boxes = build_bvh(of_parts);
}

Bounds<double> bounds_under(const Compound& compound, const Affine<double>& pose) {
  Bounds<double> bounds;
  for (std::size_t i = 0; i < compound.size(); ++i)
    bounds.extend(compound.definition(i).bounds_of(pose));
  return bounds;
}

PartCast cast_ray(const PosedCompound& posed, const Ray<double>& ray, double most, bool leaves,
                  double loss, const CastOptions& options, QueryCounts& counts) {
  PartCast first;
  first.cast.status = Status::miss;
  bool is_exhausted = false;
  const double t_min = leaves ? t_of_leaving(posed, ray) : -1;
  SlabRay slabs(ray);
  if (most < ray.t_max) slabs.numbers.t_max = slabs.limit(most);
  counts.nodes += traverse(posed.boxes, slabs, [&](std::uint32_t part) {
    const CastResult<double> cast = cast_ray(prepared(posed, part, loss), ray, options);
    counts.add_cast(cast);
    is_exhausted |= cast.status == Status::exhausted;
    const double t = cast.t();
    if (!cast.found() || t <= t_min) return false;
    if (first.cast.found() && !(t < first.cast.t() || (t == first.cast.t() && part < first.part)))
      return false;
    first = {cast, part};
    slabs.numbers.t_max = slabs.limit(std::min(most, t));
    return false;
  });
  if (!first.cast.found() && is_exhausted) first.cast.status = Status::exhausted;
  return first;
}

bool is_met(const PosedCompound& posed, const Ray<double>& ray, bool leaves, double loss,
            const CastOptions& options, QueryCounts& counts) {
  const double t_min = leaves ? t_of_leaving(posed, ray) : -1;
  bool is_met = false;
  counts.nodes += traverse(posed.boxes, SlabRay(ray), [&](std::uint32_t part) {
    const CastResult<double> cast = cast_ray(prepared(posed, part, loss), ray, options);
    counts.add_cast(cast);
    is_met = cast.found() && cast.t() > t_min;
    return is_met;
  });
  return is_met;
}

PartCast cast_last_exit(const PosedCompound& posed, const Ray<double>& ray,
                        const CastOptions& options, QueryCounts& counts) {
  PartCast last;
  last.cast.status = Status::miss;
  double t_hi = 0;
  bool is_exhausted = false;
  counts.nodes += traverse(posed.boxes, SlabRay(ray), [&](std::uint32_t part) {
    const CastResult<double> exit = cast_exit_within(prepared(posed, part, 0), ray, options);
    counts.add_cast(exit);
    is_exhausted |= exit.status == Status::exhausted;
    if (!exit.found()) return false;
    t_hi = std::max(t_hi, exit.t_base + exit.offset_hi);
    const auto order = [](const CastResult<double>& cast, std::uint32_t number) {
      return std::tuple(cast.status == Status::inside, cast.t(), ~number);
    };
    if (!last.cast.found() || order(exit, part) > order(last.cast, last.part)) last = {exit, part};
    return false;
  });
  // Within the errors, another part may be the last one.
  if (last.cast.status == Status::hit)
    last.cast.offset_hi = std::max(last.cast.offset_hi, sum_or_more(t_hi, -last.cast.t_base));
  if (is_exhausted && last.cast.status != Status::inside) last = {};
  return last;
}

ShapeCrossings crossings_of(const PreparedShape& shape, std::uint32_t part, const Ray<double>& ray,
                            const CastOptions& options, QueryCounts& counts) {
  ShapeCrossings found;
  const CastResult<double> entry = cast_ray(shape, ray, options);
  counts.add_cast(entry);
  if (!entry.found()) return found;
  if (entry.status == Status::hit) found.at[found.count++] = {{entry, part}, false};
  CastResult<double> exit = cast_exit_within(shape, ray, options);
  counts.add_cast(exit);
  // A ray that only touches the shape may enter without an exit, due to rounding: it then leaves
  // where it enters, or at its origin.
  if (exit.status == Status::miss)
    exit = entry.status == Status::hit
               ? entry
               : CastResult<double>{
                     Status::hit, Path::filter, 0, 0, 0, 0, unit<double>(ray.direction)};
  if (exit.status == Status::hit) found.at[found.count++] = {{exit, part}, true};
  return found;
}

void add_crossings(const PosedCompound& posed, const Ray<double>& ray, double loss,
                   const CastOptions& options, QueryCounts& counts, std::vector<PartCrossing>& to) {
  const auto first = static_cast<std::ptrdiff_t>(to.size());
  counts.nodes += traverse(posed.boxes, SlabRay(ray), [&](std::uint32_t part) {
    const ShapeCrossings found =
        crossings_of(prepared(posed, part, loss), part, ray, options, counts);
    to.insert(to.end(), found.at, found.at + found.count);
    return false;
  });
  std::stable_sort(to.begin() + first, to.end(), [](const PartCrossing& a, const PartCrossing& b) {
    return a.at.part < b.at.part;
  });
}

}  // namespace minkray
