// SPDX-License-Identifier: MIT
// The body of the packet casts. MINKRAY_PACKET_KERNEL is the function's name. All other names
// include the type of the lanes, and so the instruction set: see core/math/wide.h.
#include <algorithm>
#include <utility>

#include "core/cast/packet_kernel.h"
#include "core/cast/packet_lanes.h"
#include "core/math/wide.h"
#include "core/model/model_of.h"
#include "core/query/on_ray.h"

namespace minkray {
namespace {

/// Takes as many lanes as W has, beginning with lane `from`. `leaves`: finds where rays leave.
template <class W>
void part(const PreparedShape& shape, const RayPacket& rays, LaneBits lanes, bool leaves,
          std::size_t from, CastPacket& answers) {
  const Ray<W> ray{load<W>(rays.origin, from), load<W>(rays.direction, from),
                   W::load(rays.t_max.data() + from)};
  const auto keep_normal = [&](const Vec3<W>& normal) {
    for (int axis = 0; axis < 3; ++axis)
      normal[axis].store(answers.normal[static_cast<std::size_t>(axis)].data() + from);
  };
  const auto all_miss = [&](const BoundsCast<W>& bounds) {
    const Vec3<W> normal = shape.template normal_to_outer<W>(bounds.normal);
    const W squared = normal.squaredNorm(), zero(0.0);
    answers.miss |= lane_bits(bounds.miss & (squared > zero) & (squared < W(2.0))) << from;
    keep_normal(normal);
    zero.store(answers.supports.data() + from);
  };

  const Vec3<double>& half_extents = shape.inner_half_extents();
  const Ball<double>& ball = shape.inner_ball();
  BoundsCast<W> bounds = cast_at_box(shape.template line_to_inner<W>(ray), half_extents,
                                     ball.radius, mask_of<W>(lanes >> from));
  if (!any(bounds.open)) return all_miss(bounds);
  RayNearBall<W> near = shape.template to_inner<W>(ray);
  // Leaves far and uncertain rays to single casts.
  bounds.open &= (!near.is_from_afar(ball.radius)) &
                 (near.loss <= W(tolerance::small_loss<double> * ball.radius));
  // The exit of a ray is the entry of the reversed ray.
  if (leaves) near = near.reversed();
  cast_at_ball(near, ball.radius, bounds);
  if (!any(bounds.open)) return all_miss(bounds);
  CastLanes<W> result = with_model<W>(shape.definition(), [&](const auto& make_model) {
    return model_cast<W>(make_model, near, ball, half_extents, bounds.open,
                         tolerance::jet_max_iterations, NoObserver());
  });
  result.miss |= bounds.miss;
  result.normal = select<W>(bounds.miss, bounds.normal, result.normal);
  const Vec3<W> normal = shape.template normal_to_outer<W>(result.normal);
  const bool some_inside = any(result.inside);
  const auto at_origin = [&](const W& x) {
    return some_inside ? select(result.inside, W(0.0), x) : x;
  };
  using std::abs;
  const Mask<W> in_range =
      abs(result.t_base + result.t_offset) < W(std::numeric_limits<double>::infinity());
  const Mask<W> numbers = has_numbers(result, normal);
  if (leaves) {
    result.hit &= (result.offset_hi < W(std::numeric_limits<double>::infinity())) &
                  (normal.squaredNorm() > W(0.0));
    std::swap(result.offset_lo, result.offset_hi);
  }
  keep_on_ray(ray, result);
  // Leaves uncertain lanes to single casts.
  Mask<W> hit = result.hit & in_range & numbers, inside = result.inside & numbers;
  const double uncertain = shape.definition().uncertain_slope();
  hit &= -result.normal.dot(near.r) >= W(std::max(uncertain, tolerance::bounded_slope<double>));
  if (uncertain > 0.0) inside &= !result.uncertain;
  answers.hit |= lane_bits(hit) << from;
  answers.inside |= lane_bits(inside) << from;
  const Mask<W> has_plane = normal.squaredNorm() > W(0.0);
  answers.miss |= lane_bits(result.miss & numbers & has_plane) << from;
  at_origin(result.t_base).store(answers.t_base.data() + from);
  at_origin(result.t_offset).store(answers.t_offset.data() + from);
  at_origin(result.offset_lo).store(answers.offset_lo.data() + from);
  at_origin(result.offset_hi).store(answers.offset_hi.data() + from);
  keep_normal(normal);
  result.supports.store(answers.supports.data() + from);
}

/// Casts in parts as wide as the instruction set's registers.
void kernel(const PreparedShape& shape, const RayPacket& rays, LaneBits lanes, bool leaves,
            CastPacket& answers) {
  using W = Wide<double, static_cast<int>(IsaHere::register_bytes / sizeof(double)), IsaHere>;
  for (int from = 0; from < packet_lanes; from += LaneOf<W>::count)
    part<W>(shape, rays, lanes, leaves, static_cast<std::size_t>(from), answers);
}

}  // namespace

void MINKRAY_PACKET_KERNEL(const PreparedShape& shape, const RayPacket& rays, LaneBits lanes,
                           bool leaves, CastPacket& answers) {
  kernel(shape, rays, lanes, leaves, answers);
}

}  // namespace minkray
