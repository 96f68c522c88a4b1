// SPDX-License-Identifier: MIT
#include "renderer/clearance/near_bodies.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>
#include <utility>

#include "core/world/near_pairs.h"
#include "renderer/base/errors.h"

namespace minkray {
namespace {

ContactBody contact_body(const ClearanceBody& body, const Affine<double>& frame) {
  if (!body.mesh) return {body.shape, frame};
  ContactBody contact{body.shape, frame * body.pose()};
  contact.mesh = body.mesh;
  return contact;
}

/// Bodies with a hierarchy of their boxes, and half-spaces, which have no box.
class NearSide {
 public:
  explicit NearSide(const PosedBodies& posed) : posed_(posed), world_({}) {
    std::vector<ContactBody> boxed;
    for (std::size_t i = 0; i < posed.bodies.size(); ++i) {
      if (posed.bodies[i].plane) {
        half_spaces_.push_back(i);
      } else {
        boxed.push_back(contact_body(posed.bodies[i], posed.poses[i]));
        numbers_.push_back(i);
      }
    }
    world_ = ContactWorld(std::move(boxed));
  }

  const ContactWorld& world() const { return world_; }
  const std::vector<std::size_t>& half_spaces() const { return half_spaces_; }
  /// The number of a body of the world.
  std::size_t number(std::size_t body) const { return numbers_[body]; }

  PlacedPlane plane(std::size_t half_space) const {
    return moved(*posed_.bodies[half_space].plane, posed_.poses[half_space]);
  }

 private:
  const PosedBodies& posed_;
  ContactWorld world_;
  std::vector<std::size_t> numbers_, half_spaces_;
};

using Wanted = std::function<bool(std::size_t, std::size_t)>;

/// `wanted` gets the numbers of the half-space and of the body, each on its side.
void add_near_half_spaces(const NearSide& half_spaces, const NearSide& side, const Wanted& wanted,
                          double within, std::vector<NearBodies>& found) {
  const std::vector<ContactBody>& bodies = side.world().bodies();
  for (const std::size_t half_space : half_spaces.half_spaces()) {
    const PlacedPlane plane = half_spaces.plane(half_space);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (!wanted(half_space, side.number(i))) continue;
      const SignedDistance distance =
          distance_to_half_space(plane, bodies[i].parts(), bodies[i].pose);
      if (!(distance.lower > within)) found.push_back({half_space, side.number(i), distance});
    }
  }
}

void turn_pair_round(NearBodies& pair) {
  std::swap(pair.a, pair.b);
  std::swap(pair.distance.point_a, pair.distance.point_b);
  pair.distance.normal = -pair.distance.normal;
}

std::vector<NearBodies> near_each_other(const NearSide& side, const Wanted& wanted,
                                        const NearBodiesOptions& options) {
  NearPairsOptions how;
  how.at_most = options.within;
  how.tolerance = options.tolerance;
  how.wanted = [&](std::size_t a, std::size_t b) { return wanted(side.number(a), side.number(b)); };
  std::vector<NearBodies> found;
  for (const NearPair& pair : near_pairs(side.world(), how))
    found.push_back({side.number(pair.a), side.number(pair.b), pair.distance});
  add_near_half_spaces(side, side, wanted, options.within, found);
  for (NearBodies& pair : found)
    if (pair.a > pair.b) turn_pair_round(pair);
  return found;
}

std::vector<NearBodies> near_others(const NearSide& first, const NearSide& others,
                                    const NearBodiesOptions& options) {
  NearPairsOptions how;
  how.at_most = options.within;
  how.tolerance = options.tolerance;
  std::vector<NearBodies> found;
  for (const NearPair& pair : near_pairs(first.world(), others.world(), how))
    found.push_back({first.number(pair.a), others.number(pair.b), pair.distance});
  const Wanted all = [](std::size_t, std::size_t) { return true; };
  add_near_half_spaces(first, others, all, options.within, found);
  std::vector<NearBodies> turned;
  add_near_half_spaces(others, first, all, options.within, turned);
  for (NearBodies& pair : turned) {
    turn_pair_round(pair);
    found.push_back(pair);
  }
  return found;
}

void check_count(const PosedBodies& first, const PosedBodies& others, double within) {
  if (std::isfinite(within)) return;
  const double own = double(first.bodies.size()), pairs = own * double(others.bodies.size());
  if (pairs > double(most_pairs) || own * own / 2 > double(most_pairs))
    throw BadInput("more than 10,000,000 pairs of bodies: --within leaves some out");
}

}  // namespace

void PosedBodies::append(PosedBodies&& others) {
  places.clear();
  std::ranges::move(others.bodies, std::back_inserter(bodies));
  std::ranges::move(others.poses, std::back_inserter(poses));
}

PosedBodies posed_bodies(const Model& model, GeometryChoice geometry) {
  PosedBodies posed;
  posed.bodies = bodies_of(model, geometry);
  const std::vector<Affine<double>> links = link_poses(model);
  const std::vector<int> groups = rigid_groups(model);
  for (const ClearanceBody& body : posed.bodies) {
    posed.poses.push_back(body.link_index < 0 ? Affine<double>()
                                              : links[static_cast<std::size_t>(body.link_index)]);
    posed.places.push_back(place_of(body.link_index, model, groups));
  }
  return posed;
}

PosedBodies posed_bodies(const Scene& scene) {
  PosedBodies posed;
  posed.bodies = bodies_of(scene);
  posed.poses.resize(posed.bodies.size());
  return posed;
}

std::vector<NearBodies> near_bodies(const PosedBodies& first, const PosedBodies& others,
                                    const Wanted& wanted, const NearBodiesOptions& options) {
  check_count(first, others, options.within);
  const NearSide side(first), other_side(others);
  std::vector<NearBodies> found = near_each_other(side, wanted, options);
  for (NearBodies& pair : near_others(side, other_side, options)) {
    pair.b += first.bodies.size();
    found.push_back(std::move(pair));
  }
  const auto order = [](const NearBodies& pair) {
    const bool is_unknown = pair.distance.is_unknown();
    return std::tuple(is_unknown, is_unknown ? 0 : pair.distance.value, pair.a, pair.b);
  };
  std::ranges::sort(found, {}, order);
  return found;
}

}  // namespace minkray
