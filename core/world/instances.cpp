// SPDX-License-Identifier: MIT
#include "core/world/instances.h"

#include <utility>

#include "core/parallel/parallel.h"
#include "core/query/tolerances.h"

namespace minkray {
namespace {

/// Support points, and so the bounds made of them, are rounded; a solver's hits are as well.
/// Relative to the box's size and distance from the world's origin, in units of the machine
/// epsilon.
constexpr int bounds_padding = 32;

/// Poses that one thread takes at a time: some hundred microseconds of work.
constexpr std::size_t poses_a_range = 4096;

template <class T>
Bounds<T> padded(const Bounds<T>& bounds) {
  const T size = bounds.lower.cwiseAbs().cwiseMax(bounds.upper.cwiseAbs()).maxCoeff();
  const T padding = T(bounds_padding) * tolerance::epsilon<T> * size;
  return {(bounds.lower.array() - padding).matrix(), (bounds.upper.array() + padding).matrix()};
}

}  // namespace

template <class T>
std::uint32_t Instances<T>::define(Shape<T> shape) {
  definitions_.push_back(std::make_shared<const ShapeDefinition<T>>(std::move(shape)));
  screens_.push_back(minkray::screen_of(*definitions_.back()));
  return static_cast<std::uint32_t>(definitions_.size() - 1);
}

template <class T>
std::uint32_t Instances<T>::define(const std::shared_ptr<const ShapeDefinition<T>>& shared) {
  const auto next = static_cast<std::uint32_t>(definitions_.size());
  const auto [at, is_new] = shared_.try_emplace(shared.get(), next);
  if (!is_new) return at->second;
  definitions_.push_back(shared);
  screens_.push_back(minkray::screen_of(*shared));
  return next;
}

template <class T>
void Instances<T>::make_lane_places() {
  kind_of_all_ = FormKind::none;
  if (places_.empty() || !movements_.empty() || !half_spaces_.empty() || !shown_to_.empty()) return;
  kind_of_all_ = screens_[places_[0].definition].alike;
  for (const Screen& screen : screens_)
    if (screen.alike != kind_of_all_) kind_of_all_ = FormKind::none;
  if (kind_of_all_ == FormKind::none) return lane_places_.clear();
  lane_places_.resize(places_.size());
  parallel_for(places_.size(), poses_a_range, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      LanePlace<T>& to = lane_places_[i];
      const Mat3<T>& map = to_inner(i);
      for (int axis = 0; axis < 3; ++axis) to.centre[axis] = places_[i].centre[axis];
      for (int k = 0; k < 9; ++k) to.to_inner[k] = static_cast<float>(map.data()[k]);
      to.definition = places_[i].definition;
    }
  });
}

template <class T>
void Instances<T>::make_leaf_places(const Bvh& bvh) {
  leaf_places_.clear();
  first_leaves_.clear();
  if (kind_of_all_ == FormKind::none) return;
  leaf_places_.reserve(places_.size());
  first_leaves_.reserve(bvh.nodes.size());
  for (const BvhNode& node : bvh.nodes) {
    first_leaves_.push_back(static_cast<std::uint32_t>(leaf_places_.size()));
    for (const std::uint32_t what : node.children) {
      if (what == BvhNode::none) break;
      if (!(what & BvhNode::leaf)) continue;
      const std::uint32_t i = what & ~BvhNode::leaf;
      LeafPlace<T> to;
      for (int axis = 0; axis < 3; ++axis) to.centre[axis] = places_[i].centre[axis];
      for (int k = 0; k < 9; ++k) to.to_inner[k] = to_inner(i).data()[k];
      to.definition = places_[i].definition;
      to.instance = i;
      leaf_places_.push_back(to);
    }
  }
}

template <class T>
void Instances<T>::reserve(std::size_t count) {
  places_.reserve(places_.size() + count);
  boxes_.reserve(boxes_.size() + count);
}

template <class T>
void Instances<T>::add(std::uint32_t definition, const Affine<T>& pose) {
  const ShapeDefinition<T>& shape = *definitions_[definition];
  const auto placement = shape.placed(pose);
  const Bounds<T> bounds = shape.bounds_of(pose);
  std::uint32_t linear = identity;
  if (!placement.is_rigid_identity) {
    const Linear own{placement.to_inner, bounds.half_extents().maxCoeff()};
    // Boxes of one shape with one linear part are of one size but for rounding.
    const bool as_before = !places_.empty() && places_.back().definition == definition &&
                           places_.back().linear != identity &&
                           linear_[places_.back().linear].to_inner == own.to_inner;
    if (!as_before) linear_.push_back(own);
    linear = as_before ? places_.back().linear : static_cast<std::uint32_t>(linear_.size() - 1);
  }
  places_.push_back({placement.centre.high, definition, linear});
  if (!lows_.empty() || !placement.centre.low.isZero(0) || placement.loss > T(0)) {
    lows_.resize(places_.size(), Low());
    lows_.back() = {placement.centre.low, placement.loss};
  }
  boxes_.push_back(rounded_outwards(padded(bounds)));
}

template <class T>
void Instances<T>::add(const HalfSpaceBody<T>& half_space, const Affine<T>& pose) {
  half_spaces_.push_back(
      {static_cast<std::uint32_t>(places_.size()), half_space, half_space.posed(pose)});
  places_.push_back({Vec3<T>::Zero(), no_definition, identity});
  if (!lows_.empty()) lows_.resize(places_.size(), Low());
  boxes_.push_back({});
}

/// Half-spaces get a point of another box, which makes the hierarchy no larger.
template <class T>
FirstTouchVector<Bounds<float>> Instances<T>::take_boxes() {
  if (!half_spaces_.empty()) {
    Vec3<float> corner = Vec3<float>::Zero();
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (is_half_space(i)) continue;
      corner = boxes_[i].lower;
      break;
    }
    for (const PosedHalfSpace& one : half_spaces_) boxes_[one.instance] = {corner, corner};
  }
  return std::exchange(boxes_, {});
}

template <class T>
void Instances<T>::add_many(std::uint32_t definition, std::size_t count, bool linear_alike,
                            const std::function<Affine<T>(std::size_t)>& pose_of) {
  if (count == 0) return;
  const ShapeDefinition<T>& shape = *definitions_[definition];
  const std::size_t first = places_.size(), first_linear = linear_.size();
  places_.resize(first + count);
  boxes_.resize(first + count);
  if (!lows_.empty() || !shape.is_centred()) lows_.resize(first + count, Low());
  // Alike: the first one's linear part is that of all, or the identity.
  const auto placement = shape.placed(pose_of(0));
  if (linear_alike && !placement.is_rigid_identity)
    linear_.push_back({placement.to_inner, shape.bounds_of(pose_of(0)).half_extents().maxCoeff()});
  if (!linear_alike) linear_.resize(first_linear + count);
  parallel_for(count, poses_a_range, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      place(first + i, definition, pose_of(i), first_linear + (linear_alike ? 0 : i),
            !linear_alike);
  });
}

template <class T>
void Instances<T>::show_to(std::size_t i, RayKinds kinds) {
  shown_to_.resize(places_.size(), all_ray_kinds);
  shown_to_[i] = kinds;
}

template <class T>
void Instances<T>::pose_all(const std::function<Affine<T>(std::size_t)>& pose_of,
                            const std::function<Movement<T>(std::size_t)>& movement_of) {
  linear_.resize(places_.size());
  boxes_.resize(places_.size());
  movements_.resize(movement_of ? places_.size() : 0);
  for (const auto& definition : definitions_)
    if (!definition->is_centred()) lows_.resize(places_.size(), Low());
  for (PosedHalfSpace& one : half_spaces_) one.in_world = one.at_rest.posed(pose_of(one.instance));
  parallel_for(places_.size(), poses_a_range, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (movement_of) movements_[i] = movement_of(i);
      if (is_half_space(i)) continue;
      const Affine<T> pose = pose_of(i);
      place(i, places_[i].definition, pose, i, true);
      if (!movement_of) continue;
      const ShapeDefinition<T>& shape = *definitions_[places_[i].definition];
      const Bounds<T> at_end = shape.bounds_of(movements_[i].moved(pose, T(1)));
      boxes_[i] = rounded_outwards(padded(movements_[i].swept(shape.bounds_of(pose), at_end)));
    }
  });
}

template <class T>
void Instances<T>::place(std::size_t i, std::uint32_t definition, const Affine<T>& pose,
                         std::size_t linear, bool writes) {
  const ShapeDefinition<T>& shape = *definitions_[definition];
  const auto placed = shape.placed(pose);
  const Bounds<T> bounds = shape.bounds_of(pose);
  boxes_[i] = rounded_outwards(padded(bounds));
  if (writes && !placed.is_rigid_identity)
    linear_[linear] = {placed.to_inner, bounds.half_extents().maxCoeff()};
  if (!lows_.empty()) lows_[i] = {placed.centre.low, placed.loss};
  places_[i] = {placed.centre.high, definition,
                placed.is_rigid_identity ? identity : static_cast<std::uint32_t>(linear)};
}

template <class T>
std::size_t Instances<T>::bytes() const {
  return definitions_.size() *
             (sizeof(ShapeDefinition<T>) + sizeof(definitions_[0]) + sizeof(Screen)) +
         places_.capacity() * sizeof(Place) + linear_.capacity() * sizeof(Linear) +
         lows_.capacity() * sizeof(lows_[0]) + movements_.capacity() * sizeof(movements_[0]) +
         shown_to_.capacity() * sizeof(RayKinds) +
         half_spaces_.capacity() * sizeof(PosedHalfSpace) + boxes_.capacity() * sizeof(boxes_[0]);
}

template class Instances<float>;
template class Instances<double>;

}  // namespace minkray
