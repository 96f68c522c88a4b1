// SPDX-License-Identifier: MIT
// Shapes of a world with their poses. Each definition is stored once, and each instance stores only
// its pose, so a world can have tens of millions of instances.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "core/bvh/bvh.h"
#include "core/cast/form_cast.h"
#include "core/cast/prepared_shape.h"
#include "core/parallel/first_touch.h"
#include "core/screen/instance_place.h"
#include "core/screen/screen.h"
#include "core/world/half_space.h"
#include "core/world/instance_body.h"
#include "core/world/movement.h"
#include "core/world/posed_compound.h"
#include "core/world/posed_mesh.h"

namespace minkray {

/// Index that means "no instance". As a result: a miss. As the instance to skip: skip none.
inline constexpr std::uint32_t no_instance = std::numeric_limits<std::uint32_t>::max();

/// Kinds of rays, one bit each; the caller defines their meaning.
using RayKinds = std::uint8_t;
inline constexpr RayKinds all_ray_kinds = 0xff;

/// All instances of a world. An instance takes 64 bytes, and 36 more if its pose does not fit in
/// floats.
class Instances {
 public:
  /// Stores a shape for `add`. Returns its number; equal shapes get the same number.
  std::uint32_t define(Shape shape);
  /// Stores an existing definition. Returns the same number for the same definition.
  std::uint32_t define(const std::shared_ptr<const ShapeDefinition>& shared);

  /// Adds an instance. `pose` maps the shape's frame to the world, and must be invertible.
  void add(std::uint32_t definition, const Affine<double>& pose);
  void add(Shape shape, const Affine<double>& pose = {}) { add(define(std::move(shape)), pose); }

  /// Adds a half-space under a pose. Half-spaces have no definition and no box, so `at` must not be
  /// called for them.
  void add(const HalfSpaceBody<double>& half_space, const Affine<double>& pose = {});

  /// Adds a mesh under a pose. A mesh has a box but no definition.
  void add(std::shared_ptr<const TriangleMesh> mesh, const Affine<double>& pose = {});
  /// Adds a compound under a pose; as a mesh, without a definition.
  void add(std::shared_ptr<const Compound> compound, const Affine<double>& pose = {});

  /// Adds `count` instances, the i-th at pose_of(i). Several threads call pose_of at once.
  void add_many(std::uint32_t definition, std::size_t count,
                const std::function<Affine<double>(std::size_t)>& pose_of);

  /// Removes all instances from index `count` on, which must have shapes.
  void truncate(std::size_t count);

  /// Moves one instance, which must not be a half-space. Its box is stale until pose_all.
  void set_pose(std::size_t i, const Affine<double>& pose);

  /// Gives an instance another definition and the identity pose. Its box is stale until pose_all.
  void replace(std::size_t i, std::uint32_t definition) {
    put(i, definition, {});
    are_boxes_stale_ = true;
  }

  /// Returns the pose of an instance exactly as given; nullopt if it was not kept. Poses are kept
  /// for meshes and compounds, and for shapes that are not a Transform and have a pose that keeps
  /// lengths.
  std::optional<Affine<double>> plain_pose(std::size_t i) const;

  /// Shows the i-th instance to rays of these kinds only. Call after all instances are added.
  void show_to(std::size_t i, RayKinds kinds);
  bool is_shown_to(std::size_t i, RayKinds kinds) const {
    return shown_to_.empty() || (shown_to_[i] & kinds) != 0;
  }
  /// Returns the kinds of rays per instance; null if all instances are shown to all rays.
  const RayKinds* shown_to() const { return shown_to_.empty() ? nullptr : shown_to_.data(); }

  /// Moves every instance: the i-th to pose_of(i). With movement_of, the i-th follows
  /// movement_of(i) while time goes from 0 to 1, and its box contains this motion. Several threads
  /// call both functions at once. Computes all boxes again.
  void pose_all(const std::function<Affine<double>(std::size_t)>& pose_of,
                const std::function<Movement<double>(std::size_t)>& movement_of = {});

  /// True if any instance moves.
  bool move() const { return !movements_.empty(); }

  /// Moves a ray back with the i-th instance from `time` to time 0.
  Ray<double> seen_by(std::size_t i, const Ray<double>& ray, double time) const {
    return movements_.empty() ? ray : movements_[i].unmoved(ray, time);
  }
  Vec3<double> seen_by(std::size_t i, const Vec3<double>& point, double time) const {
    return movements_.empty() ? point : movements_[i].unmoved(point, time);
  }
  /// Rotates a direction with the instance from `time` back to time 0; `turned` rotates it forward.
  Vec3<double> unturned(std::size_t i, const Vec3<double>& direction, double time) const {
    return movements_.empty() ? direction : movements_[i].unturned(direction, time);
  }
  Vec3<double> turned(std::size_t i, const Vec3<double>& direction, double time) const {
    return movements_.empty() ? direction : movements_[i].turned(direction, time);
  }
  /// Converts the result of a cast with a ray from seen_by() to the world.
  CastResult<double> turned(std::size_t i, CastResult<double> cast, double time) const {
    if (!movements_.empty()) cast.normal = movements_[i].turned(cast.normal, time);
    return cast;
  }

  /// True if two instances at rest have exactly the same shape, place and ray kinds. Only for
  /// instances with shapes.
  bool are_same(std::size_t i, std::size_t j) const;

  /// Makes room for `count` more instances.
  void reserve(std::size_t count);

  std::size_t size() const { return places_.size(); }

  struct PosedHalfSpace {
    std::uint32_t instance;
    HalfSpaceBody<double> at_rest, in_world;
  };
  const std::vector<PosedHalfSpace>& half_spaces() const { return half_spaces_; }
  bool is_half_space(std::size_t i) const { return places_[i].body == no_body; }

  /// Returns the meshes in the order of their instances.
  const std::vector<PosedMesh>& meshes() const { return meshes_; }
  bool is_mesh(std::size_t i) const { return places_[i].body == body_of_mesh; }
  const PosedMesh& mesh_of(std::size_t i) const { return meshes_[index_of_mesh(i)]; }

  /// Returns the compounds in the order of their instances.
  const std::vector<PosedCompound>& compounds() const { return compounds_; }
  bool is_compound(std::size_t i) const { return places_[i].body == body_of_compound; }
  const PosedCompound& compound_of(std::size_t i) const { return compounds_[index_of_compound(i)]; }

  /// True if the instance has a definition: it is no half-space, mesh or compound.
  bool has_shape(std::size_t i) const { return places_[i].body < body_of_compound; }
  /// True if there are half-spaces, meshes or compounds.
  bool have_shapeless() const {
    return !half_spaces_.empty() || !meshes_.empty() || !compounds_.empty();
  }

  /// Returns an instance with a shape, prepared for casts. This object must outlive the result.
  /// `loss` is the error bound of a ray's position, in the inner frame (see PreparedShape).
  PreparedShape at(std::size_t i, double loss = 0) const {
    const InstancePlace& place = places_[i];
    const InstanceBody& body = bodies_[place.body];
    const ShapeDefinition& definition = *body.definition;
    const Mat3<double> map = to_inner(i);
    const Mat3<double>* const turn = body.is_turned ? &map : nullptr;
    const Vec3<double> origin(place.origin[0], place.origin[1], place.origin[2]);
    if (!body.is_plain) {
      const auto rest = rests_.find(static_cast<std::uint32_t>(i));
      if (rest == rests_.end()) return {definition, origin, turn, loss};
      return {definition, TwoFoldVec3<double>(origin, rest->second.centre), turn,
              rest->second.loss + loss};
    }
    return {definition, ShapeDefinition::plain_centre({map.transpose(), origin}, body.centre), turn,
            (body.is_turned ? definition.plain_loss() : 0) + loss};
  }
  /// Returns the placement of an instance at rest, as the filter needs it. Writes `map`, which must
  /// outlive the result.
  FormPlace form_place(std::size_t i, Mat3<double>& map) const {
    const InstancePlace& place = places_[i];
    const InstanceBody& body = bodies_[place.body];
    const Vec3<double> origin(place.origin[0], place.origin[1], place.origin[2]);
    const bool has_map = body.is_turned || !body.is_centred;
    if (has_map) map = to_inner(i);
    return {*body.definition,
            body.is_plain && has_map
                ? ShapeDefinition::rounded_plain_centre({map.transpose(), origin}, body.centre)
                : origin,
            body.is_turned ? &map : nullptr};
  }
  /// Same as at(), for a ray returned by seen_by(). `loss` is then the rounding error of seen_by().
  PreparedShape at_seen_by(std::size_t i, const Ray<double>& ray) const {
    const double loss = loss_of_seen_by(i, ray);
    return loss == 0 ? at(i) : at(i, loss * to_inner(i).norm());
  }
  /// Error bound of seen_by() due to rounding, in the world's frame.
  double loss_of_seen_by(std::size_t i, const Ray<double>& ray) const {
    return movements_.empty() || movements_[i].stands() ? 0 : movements_[i].rounding(ray.origin);
  }

  const InstanceBody& body_of(std::size_t i) const { return bodies_[places_[i].body]; }
  std::uint32_t definition_of(std::size_t i) const { return body_of(i).number; }

  // Arrays for kernels (code compiled per instruction set).
  const InstancePlace* places() const { return places_.data(); }
  /// Null if all maps fit in float.
  const TrailingDigits* digits() const { return digits_.empty() ? nullptr : digits_.data(); }
  const std::vector<InstanceBody>& bodies() const { return bodies_; }
  const Screen* screens() const { return screens_.data(); }

  /// Returns the kind of closed form of all shapes that some ray can hit. Returns FormKind::none if
  /// these kinds differ, or if a shape is not exactly its closed form.
  FormKind kind_of_all() const;

  [[gnu::always_inline]] void prefetch(std::size_t i) const { __builtin_prefetch(&places_[i]); }
  [[gnu::always_inline]] void prefetch_digits(std::size_t i) const {
    if (digits_.empty()) return;
    const auto* const from = reinterpret_cast<const char*>(&digits_[i]);
    __builtin_prefetch(from);
    __builtin_prefetch(from + sizeof(TrailingDigits) - 1);
  }

  /// Half the longest side of the instance's box in the world, up to rounding; 0 for a half-space.
  double half_extent(std::size_t i) const;

  /// Moves out the bounding boxes of the instances. The boxes allow for rounding errors; those of
  /// half-spaces are undefined. Call once after each change.
  FirstTouchVector<Bounds<float>> take_boxes() { return std::exchange(boxes_, {}); }

  /// True if the boxes were not taken and are not stale.
  bool has_boxes() const { return boxes_.size() == places_.size() && !are_boxes_stale_; }

  std::size_t definitions() const { return definitions_.size(); }
  const ShapeDefinition& definition(std::uint32_t number) const {
    return *definitions_[number].shared;
  }

  /// Memory used, without the points of hulls, which shapes share.
  std::size_t bytes() const;

 private:
  struct Defined {
    std::shared_ptr<const ShapeDefinition> shared;
    /// Indices of this definition's bodies, or no_body.
    std::array<std::uint32_t, 5> bodies;
  };

  /// For an instance that is not plain: digits of the origin beyond double, and the error bound of
  /// the pose.
  struct Rest {
    Vec3<double> centre = Vec3<double>::Zero();
    double loss = 0;
    bool is_zero() const { return loss == 0 && centre.isZero(0); }
  };

  /// Map of an instance, and the index in Defined::bodies (`which`) of the body that the instance
  /// uses.
  struct Placed {
    std::size_t which = 0;
    TrailingDigits digits = {};
    bool has_digits = false;
    Mat3<double> wide;
    Rest rest;
  };

  /// Values of InstancePlace::body for meshes and compounds.
  static constexpr std::uint32_t body_of_mesh = no_body - 1, body_of_compound = no_body - 2;

  void add_without_shape(std::uint32_t body, const Bounds<double>& bounds);
  std::size_t index_of_mesh(std::size_t i) const;
  std::size_t index_of_compound(std::size_t i) const;
  Mat3<double> to_inner(std::size_t i) const;
  std::uint32_t number_of(std::shared_ptr<const ShapeDefinition> definition);
  std::uint32_t body_with(std::uint32_t definition, std::size_t which);
  /// Writes the instance's InstancePlace except for the member `body`, which `keep` sets. `keep` is
  /// not thread-safe.
  Placed placed(std::size_t i, std::uint32_t definition, const Affine<double>& pose);
  void keep(std::size_t i, std::uint32_t definition, const Placed& placed);
  void put(std::size_t i, std::uint32_t definition, const Affine<double>& pose);
  /// `definition_of` must return no_body for half-spaces.
  void place_many(std::size_t first, std::size_t count,
                  const std::function<std::uint32_t(std::size_t)>& definition_of,
                  const std::function<Affine<double>(std::size_t)>& pose_of);

  std::vector<Defined> definitions_;
  std::unordered_map<const void*, std::uint32_t> shared_;      ///< definitions by address
  std::unordered_multimap<std::size_t, std::uint32_t> equal_;  ///< definitions by hash of the shape
  std::vector<InstanceBody> bodies_;
  std::vector<Screen> screens_;  ///< per body
  FirstTouchVector<InstancePlace> places_;
  FirstTouchVector<TrailingDigits> digits_;               ///< per instance; empty if all are zero
  std::unordered_map<std::uint32_t, Rest> rests_;         ///< by instance; absent if zero
  std::unordered_map<std::uint32_t, Mat3<double>> wide_;  ///< maps that do not fit in float
  std::vector<Movement<double>> movements_;  ///< per instance; empty if all are at rest
  FirstTouchVector<Bounds<float>> boxes_;
  bool are_boxes_stale_ = false;
  std::vector<PosedHalfSpace> half_spaces_;  ///< in the order of their instances
  std::vector<PosedMesh> meshes_;            ///< in the order of their instances
  std::vector<PosedCompound> compounds_;     ///< in the order of their instances
  std::vector<RayKinds> shown_to_;           ///< per instance; empty if all are shown to all rays
};

}  // namespace minkray
