// SPDX-License-Identifier: MIT
// The shapes of a world, each with its pose: definitions once, and for each instance no more than
// where it stands, so that there may be tens of millions.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <unordered_map>
#include <vector>

#include "core/bvh/bvh.h"
#include "core/cast/prepared_shape.h"
#include "core/cast/screen.h"
#include "core/parallel/first_touch.h"
#include "core/world/half_space.h"
#include "core/world/leaf_place.h"
#include "core/world/movement.h"

namespace minkray {

/// Kinds of rays, a bit for each; which is which is the caller's.
using RayKinds = std::uint8_t;
inline constexpr RayKinds all_ray_kinds = 0xff;

/// What lanes of floats read of an instance, in one line of the cache.
template <class T>
struct alignas(64) LanePlace {
  T centre[3];
  float to_inner[9];  ///< column by column
  std::uint32_t definition;
};
static_assert(sizeof(LanePlace<double>) == 64 && sizeof(LanePlace<float>) == 64);

/// In double an instance takes 32 bytes, and 80 more if it is turned or scaled otherwise than the
/// one before.
template <class T>
class Instances {
 public:
  /// A shape for `add` to pose, named by the answer.
  std::uint32_t define(Shape<T> shape);

  /// One that others have made: the same number each time.
  std::uint32_t define(const std::shared_ptr<const ShapeDefinition<T>>& shared);

  /// `pose` maps the frame of the definition's shape to the world; it must be invertible.
  void add(std::uint32_t definition, const Affine<T>& pose);
  void add(Shape<T> shape, const Affine<T>& pose = {}) { add(define(std::move(shape)), pose); }

  /// An instance that is a half-space under a pose. It has no definition: `at` is not to be asked
  /// for it. The hierarchy holds a point in its place, which stands for nothing.
  void add(const HalfSpaceBody<T>& half_space, const Affine<T>& pose = {});

  /// `count` instances, the i-th at pose_of(i), which is asked from several threads at once.
  /// `linear_alike`: the poses differ in their translation alone.
  void add_many(std::uint32_t definition, std::size_t count, bool linear_alike,
                const std::function<Affine<T>(std::size_t)>& pose_of);

  /// From now on the i-th is met by rays of these kinds alone; once all have been added.
  void show_to(std::size_t i, RayKinds kinds);
  /// Whether rays of one of the kinds meet it.
  bool is_shown_to(std::size_t i, RayKinds kinds) const {
    return shown_to_.empty() || (shown_to_[i] & kinds) != 0;
  }

  /// Moves every instance: the i-th to pose_of(i), which is asked from several threads at once.
  /// There are boxes to take again. If there is a movement_of, instances are on the move: while
  /// time goes from 0 to 1 the i-th does what movement_of(i) says, and its box holds all of that.
  void pose_all(const std::function<Affine<T>(std::size_t)>& pose_of,
                const std::function<Movement<T>(std::size_t)>& movement_of = {});

  /// Whether any instance is on the move.
  bool move() const { return !movements_.empty(); }

  /// The ray as the i-th instance sees it at that time, from where it stands at time 0.
  Ray<T> seen_by(std::size_t i, const Ray<T>& ray, T time) const {
    return movements_.empty() ? ray : movements_[i].unmoved(ray, time);
  }
  /// The point as it sees it.
  Vec3<T> seen_by(std::size_t i, const Vec3<T>& point, T time) const {
    return movements_.empty() ? point : movements_[i].unmoved(point, time);
  }
  /// A direction as it sees it, and the way back: it may have turned since time 0.
  Vec3<T> unturned(std::size_t i, const Vec3<T>& direction, T time) const {
    return movements_.empty() ? direction : movements_[i].unturned(direction, time);
  }
  Vec3<T> turned(std::size_t i, const Vec3<T>& direction, T time) const {
    return movements_.empty() ? direction : movements_[i].turned(direction, time);
  }
  /// What was cast at the ray as the instance sees it, in the world.
  CastResult<T> turned(std::size_t i, CastResult<T> cast, T time) const {
    if (!movements_.empty()) cast.normal = movements_[i].turned(cast.normal, time);
    return cast;
  }

  /// Room for so many more instances of `add`.
  void reserve(std::size_t count);

  std::size_t size() const { return places_.size(); }

  /// One of the half-spaces: which instance it is, and where it lies in the world.
  struct PosedHalfSpace {
    std::uint32_t instance;
    HalfSpaceBody<T> at_rest, in_world;
  };
  const std::vector<PosedHalfSpace>& half_spaces() const { return half_spaces_; }
  bool is_half_space(std::size_t i) const { return places_[i].definition == no_definition; }

  /// Refers to this, which must outlive it.
  PreparedShape<T> at(std::size_t i) const {
    const Place& place = places_[i];
    const Mat3<T>* const map = place.linear == identity ? nullptr : &linear_[place.linear].to_inner;
    const ShapeDefinition<T>& definition = *definitions_[place.definition];
    if (lows_.empty()) return {definition, place.centre, map, T(0)};
    return {definition, TwoFoldVec3<T>(place.centre, lows_[i].centre), map, lows_[i].loss};
  }

  /// Which definition the i-th instance has, which is not a half-space, and whether it is more than
  /// moved.
  std::uint32_t definition_of(std::size_t i) const { return places_[i].definition; }
  bool is_turned(std::size_t i) const { return places_[i].linear != identity; }
  const ShapeDefinition<T>& definition(std::uint32_t k) const { return *definitions_[k]; }

  /// What the i-th instance, which is no half-space, is screened by: its definition's numbers, and
  /// its place as PreparedShape has it.
  const Screen& screen_of(std::size_t i) const { return screens_[places_[i].definition]; }
  const Vec3<T>& centre(std::size_t i) const { return places_[i].centre; }
  /// What the centres lack, as PreparedShape has it; null if none lacks anything.
  struct Low {
    Vec3<T> centre = Vec3<T>::Zero();
    T loss = T(0);
  };
  const Low* lows() const { return lows_.empty() ? nullptr : lows_.data(); }
  const Mat3<T>& to_inner(std::size_t i) const {
    return is_turned(i) ? linear_[places_[i].linear].to_inner : unturned_;
  }

  /// If all instances are screened by forms of one kind that are their shapes, stand still and are
  /// shown to all rays: the kind, else none. Both are of what `make_lane_places` found.
  FormKind kind_of_all() const { return kind_of_all_; }
  const LanePlace<T>* lane_places() const { return lane_places_.data(); }
  const Screen* screens() const { return screens_.data(); }
  /// Once all have been added, and after each change.
  void make_lane_places();
  /// Once the hierarchy is built: places in the order of its leaves, and for each node which is the
  /// first of its own.
  void make_leaf_places(const Bvh& bvh);
  const LeafPlace<T>* leaf_places() const { return leaf_places_.data(); }
  const std::uint32_t* first_leaves() const { return first_leaves_.data(); }

  /// Brings near what `at` will read: first the place, and, when that has come, the map.
  [[gnu::always_inline]] void prefetch_place(std::size_t i) const {
    __builtin_prefetch(&places_[i]);
  }
  [[gnu::always_inline]] void prefetch_map(std::size_t i) const {
    if (is_turned(i)) prefetch_linear(places_[i].linear);
  }

  /// Where each instance has a map of its own its place need not be read to find it.
  bool have_own_maps() const { return linear_.size() == places_.size(); }
  [[gnu::always_inline]] void prefetch_own_map(std::size_t i) const { prefetch_linear(i); }

  /// Half the longest side of the instance's box in the world, but for rounding.
  T half_extent(std::size_t i) const {
    const Place& place = places_[i];
    if (place.definition == no_definition) return T(0);
    return place.linear == identity
               ? definitions_[place.definition]->inner_half_extents().maxCoeff()
               : linear_[place.linear].half_extent;
  }

  /// Boxes that hold the instances and what rounding makes of them; once after each change, since
  /// they are given away.
  FirstTouchVector<Bounds<float>> take_boxes();

  std::size_t definitions() const { return definitions_.size(); }

  /// Leaves out the points of hulls, which shapes share.
  std::size_t bytes() const;

 private:
  static constexpr std::uint32_t identity = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::uint32_t no_definition = std::numeric_limits<std::uint32_t>::max();
  struct Place {
    Vec3<T> centre;
    std::uint32_t definition;
    std::uint32_t linear;  ///< into linear_, or identity
  };
  struct Linear {
    Mat3<T> to_inner;
    T half_extent;
  };
  [[gnu::always_inline]] void prefetch_linear(std::size_t entry) const {
    const auto* const map = reinterpret_cast<const char*>(&linear_[entry]);
    __builtin_prefetch(map);
    __builtin_prefetch(map + sizeof(Linear) - 1);
  }

  /// Places the i-th instance; its linear part, unless it is the identity, is to be the given entry
  /// of linear_, and is written there if `writes`.
  void place(std::size_t i, std::uint32_t definition, const Affine<T>& pose, std::size_t linear,
             bool writes);

  std::vector<std::shared_ptr<const ShapeDefinition<T>>> definitions_;
  std::vector<Screen> screens_;                            ///< of each definition
  std::unordered_map<const void*, std::uint32_t> shared_;  ///< definitions that others have made
  FirstTouchVector<LanePlace<T>> lane_places_;
  FirstTouchVector<LeafPlace<T>> leaf_places_;
  FirstTouchVector<std::uint32_t> first_leaves_;
  FormKind kind_of_all_ = FormKind::none;
  Mat3<T> unturned_ = Mat3<T>::Identity();
  FirstTouchVector<Place> places_;
  FirstTouchVector<Linear> linear_;
  FirstTouchVector<Low> lows_;          ///< by instance; empty if all are zero
  std::vector<Movement<T>> movements_;  ///< by instance; empty if all stand still
  FirstTouchVector<Bounds<float>> boxes_;
  std::vector<PosedHalfSpace> half_spaces_;  ///< in the order of their instances
  std::vector<RayKinds> shown_to_;           ///< by instance; empty if all are shown to all rays
};

extern template class Instances<float>;
extern template class Instances<double>;

}  // namespace minkray
