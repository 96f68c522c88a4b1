// SPDX-License-Identifier: MIT
#include "core/world/instances.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <utility>

#include "core/derived/shape_key.h"
#include "core/parallel/parallel.h"
#include "core/query/tolerances.h"

namespace minkray {
namespace {

/// Number of poses that a thread takes at a time: some hundred microseconds of work.
constexpr std::size_t poses_a_range = 4096;

/// Bodies in Defined::bodies are indexed by 1 if turned, plus 2 if plain. This is the index of the
/// body for maps that do not fit in float.
constexpr std::size_t wide_body = 4;

}  // namespace

std::uint32_t Instances::number_of(std::shared_ptr<const ShapeDefinition> definition) {
  Defined defined{std::move(definition), {}};
  defined.bodies.fill(no_body);
  definitions_.push_back(std::move(defined));
  return static_cast<std::uint32_t>(definitions_.size() - 1);
}

std::uint32_t Instances::define(Shape shape) {
  const std::vector<std::uint64_t> key = key_of(shape);
  const std::size_t hash = hash_of(key);
  const auto [first, end] = equal_.equal_range(hash);
  for (auto at = first; at != end; ++at)
    if (key_of(definition(at->second).original_shape()) == key) return at->second;
  const std::uint32_t number = number_of(std::make_shared<const ShapeDefinition>(std::move(shape)));
  equal_.emplace(hash, number);
  return number;
}

std::uint32_t Instances::define(const std::shared_ptr<const ShapeDefinition>& shared) {
  const auto known = shared_.find(shared.get());
  if (known != shared_.end()) return known->second;
  const std::vector<std::uint64_t> key = key_of(shared->original_shape());
  const std::size_t hash = hash_of(key);
  std::uint32_t number = no_body;
  const auto [first, end] = equal_.equal_range(hash);
  for (auto at = first; at != end && number == no_body; ++at)
    if (key_of(definition(at->second).original_shape()) == key) number = at->second;
  if (number == no_body) {
    number = number_of(shared);
    equal_.emplace(hash, number);
  }
  // An address identifies a definition only while this object owns the definition.
  if (definitions_[number].shared == shared) shared_.emplace(shared.get(), number);
  return number;
}

std::uint32_t Instances::body_with(std::uint32_t definition, std::size_t which) {
  std::uint32_t& number = definitions_[definition].bodies[which];
  if (number != no_body) return number;
  number = static_cast<std::uint32_t>(bodies_.size());
  InstanceBody body;
  body.definition = definitions_[definition].shared;
  body.number = definition;
  body.is_wide = which == wide_body;
  body.is_turned = body.is_wide || (which & 1u) != 0;
  body.is_plain = !body.is_wide && (which & 2u) != 0;
  if (body.is_plain) body.centre = body.definition->inner_ball().centre;
  body.is_centred = body.centre.isZero(0);
  Screen screen = body.is_wide ? Screen() : screen_of(*body.definition, body.centre);
  screen.first_equal = number;
  for (const std::uint32_t other : definitions_[definition].bodies)
    if (other < number) screen.share_with(screens_[other]);
  screens_.push_back(std::move(screen));
  bodies_.push_back(std::move(body));
  return number;
}

Instances::Placed Instances::placed(std::size_t i, std::uint32_t definition,
                                    const Affine<double>& pose) {
  const auto placement = this->definition(definition).placed(pose);
  InstancePlace& to = places_[i];
  Placed placed;
  bool is_wide = false;
  for (int k = 0; k < 9; ++k)
    is_wide |= !split(placement.to_inner.data()[k], to.to_inner[k], placed.digits.of[k]);
  const bool is_plain = placement.is_plain && !is_wide;
  const Vec3<double>& origin = is_plain ? pose.translation : placement.centre.high;
  if (!is_plain) placed.rest = {placement.centre.low, placement.loss};
  for (int axis = 0; axis < 3; ++axis) to.origin[axis] = origin[axis];
  placed.which =
      is_wide ? wide_body : 2u * (is_plain ? 1u : 0u) + (placement.is_rigid_identity ? 0u : 1u);
  if (is_wide) {
    placed.wide = placement.to_inner;
    placed.digits = {};
  }
  placed.has_digits = std::any_of(std::begin(placed.digits.of), std::end(placed.digits.of),
                                  [](std::int32_t digit) { return digit != 0; });
  return placed;
}

void Instances::keep(std::size_t i, std::uint32_t definition, const Placed& placed) {
  places_[i].body = body_with(definition, placed.which);
  const auto number = static_cast<std::uint32_t>(i);
  if (placed.which == wide_body) wide_[number] = placed.wide;
  if (!placed.rest.is_zero())
    rests_[number] = placed.rest;
  else if (!rests_.empty())
    rests_.erase(number);
}

void Instances::put(std::size_t i, std::uint32_t definition, const Affine<double>& pose) {
  const Placed placed = this->placed(i, definition, pose);
  keep(i, definition, placed);
  if (digits_.empty() && !placed.has_digits) return;
  digits_.resize(places_.size(), TrailingDigits{});
  digits_[i] = placed.digits;
}

void Instances::reserve(std::size_t count) {
  places_.reserve(places_.size() + count);
  boxes_.reserve(boxes_.size() + count);
}

void Instances::add(std::uint32_t definition, const Affine<double>& pose) {
  places_.push_back({});
  put(places_.size() - 1, definition, pose);
  boxes_.push_back(rounded_outwards(padded(this->definition(definition).bounds_of(pose))));
}

void Instances::add(const HalfSpaceBody<double>& half_space, const Affine<double>& pose) {
  half_spaces_.push_back(
      {static_cast<std::uint32_t>(places_.size()), half_space, half_space.posed(pose)});
  places_.push_back({});
  places_.back().body = no_body;
  if (!digits_.empty()) digits_.push_back({});
  boxes_.push_back({});
}

void Instances::add_without_shape(std::uint32_t body, const Bounds<double>& bounds) {
  places_.push_back({});
  places_.back().body = body;
  if (!digits_.empty()) digits_.push_back({});
  boxes_.push_back(rounded_outwards(padded(bounds)));
}

void Instances::add(std::shared_ptr<const TriangleMesh> mesh, const Affine<double>& pose) {
  meshes_.emplace_back(static_cast<std::uint32_t>(places_.size()), std::move(mesh), pose);
  add_without_shape(body_of_mesh, meshes_.back().tight_bounds_under(pose));
}

void Instances::add(std::shared_ptr<const Compound> compound, const Affine<double>& pose) {
  compounds_.emplace_back(static_cast<std::uint32_t>(places_.size()), std::move(compound), pose);
  add_without_shape(body_of_compound, compounds_.back().bounds);
}

std::size_t Instances::index_of_mesh(std::size_t i) const {
  const auto found = std::ranges::lower_bound(meshes_, i, {}, &PosedMesh::instance);
  return static_cast<std::size_t>(found - meshes_.begin());
}

std::size_t Instances::index_of_compound(std::size_t i) const {
  const auto found = std::ranges::lower_bound(compounds_, i, {}, &PosedCompound::instance);
  return static_cast<std::size_t>(found - compounds_.begin());
}

void Instances::add_many(std::uint32_t definition, std::size_t count,
                         const std::function<Affine<double>(std::size_t)>& pose_of) {
  const std::size_t first = places_.size();
  places_.resize(first + count);
  boxes_.resize(first + count);
  place_many(
      first, count, [&](std::size_t) { return definition; },
      [&](std::size_t i) { return pose_of(i - first); });
}

void Instances::place_many(std::size_t first, std::size_t count,
                           const std::function<std::uint32_t(std::size_t)>& definition_of,
                           const std::function<Affine<double>(std::size_t)>& pose_of) {
  const bool had_digits = !digits_.empty();
  digits_.resize(places_.size(), TrailingDigits{});  // pose_of may read them
  std::atomic<bool> has_digits = had_digits;
  const bool had_rests = !rests_.empty();
  // pose_of may read bodies while others are added, so the array must not be reallocated.
  const std::size_t most_bodies = bodies_.size() + (wide_body + 1) * definitions_.size();
  bodies_.reserve(most_bodies);
  screens_.reserve(most_bodies);
  std::mutex bodies;
  parallel_for(count, poses_a_range, [&](std::size_t begin, std::size_t end) {
    std::uint32_t last_definition = no_body, last_body = no_body;
    std::size_t last_which = wide_body;
    for (std::size_t i = first + begin; i < first + end; ++i) {
      const std::uint32_t definition = definition_of(i);
      if (definition == no_body) {  // half-spaces, meshes and compounds have none
        digits_[i] = {};
        continue;
      }
      const Affine<double> pose = pose_of(i);  // may read the instance's current pose
      const Placed placed = this->placed(i, definition, pose);
      digits_[i] = placed.digits;
      if (placed.has_digits) has_digits.store(true, std::memory_order_relaxed);
      boxes_[i] = rounded_outwards(padded(this->definition(definition).bounds_of(pose)));
      const bool is_simple = placed.which != wide_body && placed.rest.is_zero() && !had_rests;
      if (definition == last_definition && placed.which == last_which && is_simple) {
        places_[i].body = last_body;
        continue;
      }
      const std::lock_guard lock(bodies);
      keep(i, definition, placed);
      last_definition = definition;
      last_which = placed.which;
      last_body = places_[i].body;
    }
  });
  if (!has_digits) digits_ = {};
}

void Instances::truncate(std::size_t count) {
  places_.resize(std::min(count, places_.size()));
  if (!digits_.empty()) digits_.resize(places_.size());
  if (boxes_.size() > places_.size()) boxes_.resize(places_.size());
  const auto is_gone = [&](const auto& one) { return one.first >= places_.size(); };
  std::erase_if(wide_, is_gone);
  std::erase_if(rests_, is_gone);
  shown_to_.clear();
  movements_.clear();
}

void Instances::set_pose(std::size_t i, const Affine<double>& pose) {
  are_boxes_stale_ = true;
  if (has_shape(i)) return put(i, definition_of(i), pose);
  if (is_compound(i)) {
    PosedCompound& posed = compounds_[index_of_compound(i)];
    posed = PosedCompound(posed.instance, std::move(posed.compound), pose);
    return;
  }
  PosedMesh& posed = meshes_[index_of_mesh(i)];
  posed = PosedMesh(posed.instance, std::move(posed.mesh), pose);
}

Mat3<double> Instances::to_inner(std::size_t i) const {
  const InstancePlace& place = places_[i];
  if (bodies_[place.body].is_wide) return wide_.at(static_cast<std::uint32_t>(i));
  Mat3<double> map;
  if (digits_.empty())
    for (int k = 0; k < 9; ++k) map.data()[k] = static_cast<double>(place.to_inner[k]);
  else
    for (int k = 0; k < 9; ++k) map.data()[k] = joined(place.to_inner[k], digits_[i].of[k]);
  return map;
}

std::optional<Affine<double>> Instances::plain_pose(std::size_t i) const {
  const InstancePlace& place = places_[i];
  if (is_mesh(i)) return mesh_of(i).pose;
  if (is_compound(i)) return compound_of(i).pose;
  if (place.body == no_body) return {};
  if (!bodies_[place.body].is_plain) return {};
  return Affine<double>{to_inner(i).transpose(),
                        {place.origin[0], place.origin[1], place.origin[2]}};
}

bool Instances::are_same(std::size_t i, std::size_t j) const {
  const auto rest_of = [&](std::size_t k) {
    const auto at = rests_.find(static_cast<std::uint32_t>(k));
    return at == rests_.end() ? Rest() : at->second;
  };
  if (places_[i].body != places_[j].body || to_inner(i) != to_inner(j)) return false;
  if (!std::equal(std::begin(places_[i].origin), std::end(places_[i].origin),
                  std::begin(places_[j].origin)))
    return false;
  if (!shown_to_.empty() && shown_to_[i] != shown_to_[j]) return false;
  const Rest a = rest_of(i), b = rest_of(j);
  return a.loss == b.loss && a.centre == b.centre;
}

double Instances::half_extent(std::size_t i) const {
  if (is_half_space(i)) return 0;
  if (is_mesh(i)) return mesh_of(i).bounds().half_extents().maxCoeff();
  if (is_compound(i)) return compound_of(i).bounds.half_extents().maxCoeff();
  const InstanceBody& body = body_of(i);
  if (!body.is_turned) return body.definition->inner_half_extents().maxCoeff();
  const Mat3<double> to_world = inverse_of(to_inner(i));
  const Shape& shape = body.definition->inner_shape();
  double largest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3<double> along = to_world.row(axis).transpose();
    const Vec3<double> across = shape.support(along) - shape.support(Vec3<double>(-along));
    largest = std::max(largest, along.dot(across) / 2);
  }
  return largest;
}

FormKind Instances::kind_of_all() const {
  std::vector<bool> is_shown(screens_.size(), shown_to_.empty());
  for (std::size_t i = 0; i < shown_to_.size(); ++i)
    if (shown_to_[i] != 0 && has_shape(i)) is_shown[places_[i].body] = true;
  std::optional<FormKind> kind;
  for (std::size_t body = 0; body < screens_.size(); ++body) {
    if (!is_shown[body]) continue;
    if (!kind) kind = screens_[body].kind;
    if (screens_[body].kind != *kind || !screens_[body].is_whole) return FormKind::none;
  }
  return kind.value_or(FormKind::none);
}

void Instances::show_to(std::size_t i, RayKinds kinds) {
  shown_to_.resize(places_.size(), all_ray_kinds);
  shown_to_[i] = kinds;
}

void Instances::pose_all(const std::function<Affine<double>(std::size_t)>& pose_of,
                         const std::function<Movement<double>(std::size_t)>& movement_of) {
  boxes_.resize(places_.size());
  are_boxes_stale_ = false;
  movements_.resize(movement_of ? places_.size() : 0);
  for (PosedHalfSpace& one : half_spaces_) one.in_world = one.at_rest.posed(pose_of(one.instance));
  std::vector<std::uint32_t> definitions(places_.size(), no_body);
  for (std::size_t i = 0; i < places_.size(); ++i)
    if (has_shape(i)) definitions[i] = definition_of(i);
  place_many(
      0, places_.size(), [&](std::size_t i) { return definitions[i]; }, pose_of);
  for (PosedMesh& one : meshes_) {
    one = PosedMesh(one.instance, std::move(one.mesh), pose_of(one.instance));
    boxes_[one.instance] = rounded_outwards(padded(one.tight_bounds_under(one.pose)));
  }
  for (PosedCompound& one : compounds_) {
    const Affine<double> pose = pose_of(one.instance);
    if (!(one.pose == pose)) one = PosedCompound(one.instance, std::move(one.compound), pose);
    boxes_[one.instance] = rounded_outwards(padded(one.bounds));
  }
  if (!movement_of) return;
  parallel_for(places_.size(), poses_a_range, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      movements_[i] = movement_of(i);
      if (is_half_space(i)) continue;
      const auto bounds_at = [&](const Affine<double>& pose) {
        return is_mesh(i)       ? mesh_of(i).tight_bounds_under(pose)
               : is_compound(i) ? bounds_under(*compound_of(i).compound, pose)
                                : definition(definition_of(i)).bounds_of(pose);
      };
      const Affine<double> pose = pose_of(i);
      const Bounds<double> at_end = bounds_at(movements_[i].moved(pose, 1));
      boxes_[i] = rounded_outwards(padded(movements_[i].swept(bounds_at(pose), at_end)));
    }
  });
}

std::size_t Instances::bytes() const {
  return definitions_.size() * (sizeof(ShapeDefinition) + sizeof(Defined)) +
         bodies_.size() * (sizeof(InstanceBody) + sizeof(Screen)) +
         places_.capacity() * sizeof(InstancePlace) + digits_.capacity() * sizeof(TrailingDigits) +
         movements_.capacity() * sizeof(movements_[0]) + shown_to_.capacity() * sizeof(RayKinds) +
         half_spaces_.capacity() * sizeof(PosedHalfSpace) + boxes_.capacity() * sizeof(boxes_[0]);
}

}  // namespace minkray
