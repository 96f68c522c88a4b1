// SPDX-License-Identifier: MIT
// Many pairs of shapes at once: distances with their derivatives, contact points, times of impact;
// and the pairs of a scene. Header-only over minkray_c_pairs.h, whose comments specify the details;
// docs/cpp.md has examples.
#pragma once

// Example:
//   std::vector<mk::Distance> found(poses.size());
//   mk::signed_distances({{&robot, 1}, poses, {}}, {{&wall, 1}, {}, {}}, found);
//   for (const mk::ScenePair& pair : scene.distances(0.1)) use(pair.object_a, pair.object_b);

#include <new>

#include "minkray/minkray.h"
#include "minkray/minkray_c_pairs.h"

namespace minkray {
inline namespace v0 {

static_assert(sizeof(Shape) == sizeof(minkray_shape) && std::is_standard_layout_v<Shape>);

/// One side of many pairs: one shape, pose and twist per pair, or one for all pairs. Defaults:
/// identity poses, at rest. Poses must be rigid.
struct Bodies {
  View<const Shape> shapes = {};
  View<const Pose> poses = {};
  View<const Twist> twists = {};
};

/// Warm start: the final state of a query on a pair, used by the next query on the same pair. A
/// plain value; initially empty.
struct PairMemory {
  std::uint64_t words[8] = {};
};
static_assert(sizeof(PairMemory) == sizeof(minkray_pair_memory));

/// Up to four contact points; see minkray_manifold.
struct Manifold {
  Vec3 normal;
  Vec3 points_a[4], points_b[4];
  double gaps[4] = {};
  double value = 0, lower = 0, upper = 0;
  std::int32_t count = 0, status = undecided;
};
static_assert(sizeof(Manifold) == sizeof(minkray_manifold) &&
              offsetof(Manifold, count) == offsetof(minkray_manifold, count));

/// Bounds of the length of a derivative's error; infinite if unknown.
struct DerivativeError {
  double velocity = 0, turn = 0;
};

/// Derivatives with respect to a twist of each body: the velocity of its origin and the angular
/// velocity about it. `is_ridge` is set where the derivatives may be ambiguous. Empty views are not
/// filled.
struct Derivatives {
  View<Twist> by_a = {}, by_b = {};
  View<std::uint8_t> is_ridge = {};
  View<DerivativeError> error_a = {}, error_b = {};
};

/// Options of queries on many pairs.
struct PairOptions {
  double tolerance = 0;            ///< largest gap of the bounds, relative to the sizes; 0: 1e-10
  double at_most = 0;              ///< beyond this distance a lower bound is enough; 0: unlimited
  View<PairMemory> memories = {};  ///< one per pair, or none
  Derivatives derivatives = {};
  Options how = {};
};

namespace detail {
inline minkray_bodies plain(const Bodies& bodies) {
  minkray_bodies plain = {};
  plain.size = sizeof plain;
  plain.shapes = reinterpret_cast<const minkray_shape*>(bodies.shapes.data());
  plain.shape_count = bodies.shapes.size();
  plain.poses = bodies.poses.size() > 0 ? &bodies.poses.data()->rows[0][0] : nullptr;
  plain.pose_count = bodies.poses.size();
  plain.twists = reinterpret_cast<const minkray_twist*>(
      bodies.twists.size() > 0 ? bodies.twists.data() : nullptr);
  plain.twist_count = bodies.twists.size();
  return plain;
}
inline minkray_distance_options plain(const PairOptions& options) {
  return {sizeof(minkray_distance_options), options.tolerance, options.at_most, 0, 0};
}
/// Returns null if `things` is empty; throws unless there is one thing per pair.
template <class Plain, class Thing>
Plain* of_pairs(const char* function, const char* argument, View<Thing> things, std::size_t pairs) {
  if (things.size() == 0) return nullptr;
  check_sizes(function, argument, things.size(), "pairs", pairs);
  return reinterpret_cast<Plain*>(things.data());
}
template <class Arrays>
Arrays empty_arrays() {
  Arrays arrays = {};
  arrays.size = sizeof arrays;
  return arrays;
}
template <class Arrays>
void add_derivatives(const char* function, const Derivatives& to, std::size_t pairs,
                     Arrays& arrays) {
  arrays.jac_a = of_pairs<double>(function, "derivatives.by_a", to.by_a, pairs);
  arrays.jac_b = of_pairs<double>(function, "derivatives.by_b", to.by_b, pairs);
  arrays.is_ridge = of_pairs<std::uint8_t>(function, "derivatives.is_ridge", to.is_ridge, pairs);
  arrays.jac_error_a = of_pairs<double>(function, "derivatives.error_a", to.error_a, pairs);
  arrays.jac_error_b = of_pairs<double>(function, "derivatives.error_b", to.error_b, pairs);
}
}  // namespace detail

/// Signed distances of distances.size() pairs. Bit-identical to signed_distance() for any number of
/// threads.
inline void signed_distances(const Bodies& a, const Bodies& b, View<Distance> distances,
                             const PairOptions& options = {}) {
  constexpr const char* function = "minkray::signed_distances";
  const minkray_bodies plain_a = detail::plain(a), plain_b = detail::plain(b);
  const minkray_distance_options request = detail::plain(options);
  const minkray_options how = detail::plain(options.how);
  auto arrays = detail::empty_arrays<minkray_distance_arrays>();
  arrays.distances = reinterpret_cast<minkray_distance*>(distances.data());
  detail::add_derivatives(function, options.derivatives, distances.size(), arrays);
  detail::check(
      minkray_signed_distances(&plain_a, &plain_b, distances.size(), &request,
                               detail::of_pairs<minkray_pair_memory>(
                                   function, "memories", options.memories, distances.size()),
                               &arrays, &how));
}

/// First contacts of many pairs, at times from 0 to t_max (one number per pair, or one for all).
inline void times_of_impact(const Bodies& a, const Bodies& b, View<const double> t_max,
                            View<Impact> impacts, const PairOptions& options = {}) {
  constexpr const char* function = "minkray::times_of_impact";
  const minkray_bodies plain_a = detail::plain(a), plain_b = detail::plain(b);
  const minkray_options how = detail::plain(options.how);
  auto arrays = detail::empty_arrays<minkray_impact_arrays>();
  arrays.impacts = reinterpret_cast<minkray_impact*>(impacts.data());
  detail::add_derivatives(function, options.derivatives, impacts.size(), arrays);
  detail::check(minkray_times_of_impact(
      &plain_a, &plain_b, impacts.size(), t_max.data(), t_max.size(),
      detail::of_pairs<minkray_pair_memory>(function, "memories", options.memories, impacts.size()),
      &arrays, &how));
}

/// Contact points of many pairs, without derivatives.
inline void manifolds(const Bodies& a, const Bodies& b, View<Manifold> found,
                      const PairOptions& options = {}) {
  const minkray_bodies plain_a = detail::plain(a), plain_b = detail::plain(b);
  const minkray_distance_options request = detail::plain(options);
  const minkray_options how = detail::plain(options.how);
  auto arrays = detail::empty_arrays<minkray_manifold_arrays>();
  arrays.manifolds = reinterpret_cast<minkray_manifold*>(found.data());
  detail::check(
      minkray_manifolds(&plain_a, &plain_b, found.size(), &request,
                        detail::of_pairs<minkray_pair_memory>("minkray::manifolds", "memories",
                                                              options.memories, found.size()),
                        &arrays, &how));
}

/// Starts from the memory of the last query on this pair.
inline Distance signed_distance(const Shape& a, const Pose& pose_a, const Shape& b,
                                const Pose& pose_b, PairMemory& memory, double tolerance = 0) {
  Distance found;
  PairOptions options;
  options.tolerance = tolerance;
  options.memories = {&memory, 1};
  options.how.threads = 1;
  signed_distances({{&a, 1}, {&pose_a, 1}, {}}, {{&b, 1}, {&pose_b, 1}, {}}, {&found, 1}, options);
  return found;
}

// ---- the pairs of a scene ----

/// Two objects and their distance. no_object means a given shape or point, or no result.
struct ScenePair {
  Distance distance;
  Twist by_a, by_b;  ///< derivatives, zero unless requested
  std::uint32_t object_a = no_object, object_b = no_object;
  std::int32_t is_ridge = 0, reserved = 0;
};
static_assert(sizeof(ScenePair) == sizeof(minkray_scene_pair) &&
              offsetof(ScenePair, object_a) == offsetof(minkray_scene_pair, object_a));

/// Bounds of the lengths of a pair's derivatives' errors.
struct PairDerivativeError {
  DerivativeError a, b;
};

/// List of a scene's pairs, which owns them. Not a std::vector, whose header is longer than
/// minkray.h.
class ScenePairs {
 public:
  ScenePairs() = default;
  explicit ScenePairs(std::size_t size)
      : pairs_(size ? new ScenePair[size] : nullptr), size_(size) {}
  ScenePairs(std::size_t size, bool with_errors) : ScenePairs(size) {
    if (with_errors && size) errors_ = new PairDerivativeError[size];
  }
  ScenePairs(ScenePairs&& from) noexcept { swap(from); }
  ScenePairs& operator=(ScenePairs&& from) noexcept {
    swap(from);
    return *this;
  }
  ~ScenePairs() {
    delete[] pairs_;
    delete[] errors_;
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  ScenePair* data() { return pairs_; }
  ScenePair* begin() { return pairs_; }
  ScenePair* end() { return pairs_ + size_; }
  ScenePair& operator[](std::size_t i) { return pairs_[i]; }
  const ScenePair* data() const { return pairs_; }
  const ScenePair* begin() const { return pairs_; }
  const ScenePair* end() const { return pairs_ + size_; }
  const ScenePair& operator[](std::size_t i) const { return pairs_[i]; }
  const ScenePair& front() const { return pairs_[0]; }
  const ScenePair& back() const { return pairs_[size_ - 1]; }
  /// One per pair if NearOptions::derivative_errors is set, else none.
  View<PairDerivativeError> errors() { return {errors_, errors_ ? size_ : 0}; }
  View<const PairDerivativeError> errors() const { return {errors_, errors_ ? size_ : 0}; }

 private:
  void swap(ScenePairs& other) noexcept {
    std::swap(pairs_, other.pairs_);
    std::swap(errors_, other.errors_);
    std::swap(size_, other.size_);
  }
  ScenePair* pairs_ = nullptr;
  PairDerivativeError* errors_ = nullptr;
  std::size_t size_ = 0;
};

/// First contact of a shape that moves through a scene.
struct SceneImpact {
  Impact impact;   ///< no contact before t_lo; contact at t_hi
  Twist by_shape;  ///< derivative of the time with respect to a twist of the pose at time 0
  std::uint32_t object = no_object;
  std::int32_t is_ridge = 0;
};
static_assert(sizeof(SceneImpact) == sizeof(minkray_scene_impact) &&
              offsetof(SceneImpact, object) == offsetof(minkray_scene_impact, object));

/// Options of queries on a scene's pairs.
struct NearOptions {
  double within = std::numeric_limits<double>::infinity();  ///< pairs further apart are skipped
  double tolerance = 0;      ///< largest gap of the bounds, relative to the sizes; 0: 1e-10
  bool derivatives = false;  ///< add derivatives
  std::uint32_t mask = 0;    ///< for given shapes and points: categories to test; 0: all
  View<DerivativeError> errors = {};  ///< receives error bounds from times_of_impact: one per shape
  bool derivative_errors = false;     ///< fill ScenePairs::errors()
  View<PairDerivativeError> pair_errors = {};  ///< receives error bounds from distance_to
  Options how = {};
};

namespace detail {
inline minkray_near_options plain(const NearOptions& options) {
  // In C a zero is the default. Nothing lies between it and the next number.
  return {sizeof(minkray_near_options),
          options.within == 0 ? std::numeric_limits<double>::denorm_min() : options.within,
          options.tolerance,
          options.derivatives ? 1 : 0,
          options.mask,
          nullptr,
          nullptr};
}

/// Keeps the pairs from minkray_scene_distances; `no_room`: out of memory.
struct TakenPairs {
  ScenePairs pairs;
  const double* errors = nullptr;  ///< during the call
  bool no_room = false;

  static int take(void* user, const minkray_scene_pair* pairs, std::size_t count) {
    auto& taken = *static_cast<TakenPairs*>(user);
    try {
      taken.pairs = ScenePairs(count, taken.errors != nullptr);
    } catch (const std::bad_alloc&) {
      taken.no_room = true;
      return 1;
    }
    const auto* const first = reinterpret_cast<const ScenePair*>(pairs);
    for (std::size_t i = 0; i < count; ++i) taken.pairs[i] = first[i];
    const auto* const errors = reinterpret_cast<const PairDerivativeError*>(taken.errors);
    for (std::size_t i = 0; errors && i < count; ++i) taken.pairs.errors()[i] = errors[i];
    return 0;
  }
};

inline ScenePairs distances(minkray_scene scene, View<const ObjectPair> pairs,
                            const NearOptions& options) {
  minkray_near_options request = plain(options);
  const minkray_options how = plain(options.how);
  TakenPairs taken;
  if (options.derivative_errors) request.jac_errors = &taken.errors;
  const auto* const numbers =
      pairs.size() > 0 ? reinterpret_cast<const std::uint32_t*>(pairs.data()) : nullptr;
  const int status = minkray_scene_distances(scene, numbers, pairs.size(), &request,
                                             &TakenPairs::take, &taken, &how);
  if (taken.no_room) throw std::bad_alloc();
  check(status);
  return std::move(taken.pairs);
}
}  // namespace detail

inline ScenePairs Scene::distances(double within) const {
  NearOptions options;
  options.within = within;
  return detail::distances(handle_, {}, options);
}
inline ScenePairs Scene::distances(const NearOptions& options) const {
  return detail::distances(handle_, {}, options);
}
inline ScenePairs Scene::distances(View<const ObjectPair> pairs, const NearOptions& options) const {
  if (pairs.size() == 0) return {};
  return detail::distances(handle_, pairs, options);
}
inline ScenePairs Scene::distances(View<const ObjectPair> pairs) const {
  return distances(pairs, NearOptions());
}

inline ScenePairs Scene::nearest(View<const Vec3> points, std::size_t k,
                                 const NearOptions& options) const {
  minkray_near_options request = detail::plain(options);
  const minkray_options how = detail::plain(options.how);
  ScenePairs found(points.size() * k, options.derivative_errors);
  if (found.errors().size() > 0)
    request.jac_error = reinterpret_cast<double*>(found.errors().data());
  detail::check(minkray_scene_nearest(handle_, reinterpret_cast<const double(*)[3]>(points.data()),
                                      points.size(), k, &request,
                                      reinterpret_cast<minkray_scene_pair*>(found.data()), &how));
  return found;
}
inline ScenePairs Scene::nearest(View<const Vec3> points, std::size_t k) const {
  return nearest(points, k, NearOptions());
}

inline void Scene::distance_to(const Bodies& shapes, View<ScenePair> nearest,
                               const NearOptions& options) const {
  const minkray_bodies bodies = detail::plain(shapes);
  minkray_near_options request = detail::plain(options);
  request.jac_error = detail::of_pairs<double>("minkray::Scene::distance_to", "options.pair_errors",
                                               options.pair_errors, nearest.size());
  const minkray_options how = detail::plain(options.how);
  detail::check(minkray_scene_distance_to(handle_, &bodies, nearest.size(), &request,
                                          reinterpret_cast<minkray_scene_pair*>(nearest.data()),
                                          &how));
}
inline ScenePair Scene::distance_to(const Shape& shape, const Pose& pose) const {
  ScenePair found;
  distance_to({{&shape, 1}, {&pose, 1}, {}}, {&found, 1}, NearOptions());
  return found;
}

inline void Scene::times_of_impact(const Bodies& shapes, View<const double> t_max,
                                   View<SceneImpact> impacts, const NearOptions& options) const {
  const minkray_bodies bodies = detail::plain(shapes);
  minkray_near_options request = detail::plain(options);
  request.jac_error = detail::of_pairs<double>("minkray::Scene::times_of_impact", "options.errors",
                                               options.errors, impacts.size());
  const minkray_options how = detail::plain(options.how);
  detail::check(minkray_scene_time_of_impact(
      handle_, &bodies, impacts.size(), t_max.data(), t_max.size(), &request,
      reinterpret_cast<minkray_scene_impact*>(impacts.data()), &how));
}
inline SceneImpact Scene::time_of_impact(const Shape& shape, const Pose& pose, const Twist& twist,
                                         double t_max) const {
  SceneImpact found;
  times_of_impact({{&shape, 1}, {&pose, 1}, {&twist, 1}}, {&t_max, 1}, {&found, 1}, NearOptions());
  return found;
}

inline Manifold Scene::manifold(std::uint32_t object_a, std::uint32_t object_b) const {
  Manifold found;
  detail::check(minkray_scene_manifold(handle_, object_a, object_b,
                                       reinterpret_cast<minkray_manifold*>(&found)));
  return found;
}

inline void Scene::set_masks(std::uint32_t object, std::uint32_t category, std::uint32_t mask) {
  detail::check(minkray_scene_set_masks(handle_, object, category, mask));
}
inline void Scene::allow(std::uint32_t object_a, std::uint32_t object_b, bool is_allowed) {
  detail::check(minkray_scene_allow(handle_, object_a, object_b, is_allowed ? 1 : 0));
}
inline void Scene::allow_from_srdf(const Group& robot, Text file) {
  detail::check(minkray_scene_allow_from_srdf(handle_, robot.number(), file.c_str()));
}

inline void Scene::clearance_derivatives(const Group& robot, View<const double> path,
                                         std::size_t rows, View<Clearance> steps, View<double> jac,
                                         View<std::uint8_t> is_ridge,
                                         View<double> jac_error) const {
  constexpr const char* function = "minkray::Scene::clearance_derivatives";
  const std::size_t count = rows > 1 ? rows - 1 : 1, numbers = rows > 0 ? path.size() / rows : 0;
  detail::check_sizes(function, "path", path.size(), "numbers in its rows", rows * numbers);
  detail::check_sizes(function, "jac", jac.size(), "numbers of its steps", count * numbers);
  if (steps.size() > 0)
    detail::check_sizes(function, "steps", steps.size(), "steps of the path", count);
  if (is_ridge.size() > 0)
    detail::check_sizes(function, "is_ridge", is_ridge.size(), "steps of the path", count);
  if (jac_error.size() > 0)
    detail::check_sizes(function, "jac_error", jac_error.size(), "numbers of its steps",
                        count * numbers);
  const minkray_clearance_options options = {sizeof options, 0, 0, 0,
                                             jac_error.size() > 0 ? jac_error.data() : nullptr};
  detail::check(minkray_scene_clearance_derivatives(
      handle_, robot.number(), path.data(), rows, numbers, &options,
      steps.size() > 0 ? reinterpret_cast<minkray_clearance*>(steps.data()) : nullptr, jac.data(),
      is_ridge.size() > 0 ? is_ridge.data() : nullptr));
}

}  // namespace v0
}  // namespace minkray

#include "minkray/ray_derivatives.h"
