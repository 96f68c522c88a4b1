// SPDX-License-Identifier: MIT
// Bodies of a committed scene for pair queries: a BVH of their boxes, and half-spaces, which have
// none.
#pragma once

#include <optional>
#include <vector>

#include "core/pair_derivative/pair_derivative.h"
#include "core/pair_distance/half_space_distance.h"
#include "core/pair_distance/manifold.h"
#include "core/world/world_impact.h"
#include "renderer/clearance/bodies.h"
#include "renderer/library/handles/held_scene.h"

namespace minkray {

/// Two objects by their numbers, particles numbered after all others.
struct ScenePair {
  std::uint32_t a = no_instance, b = no_instance;
  SignedDistance distance;
  bool is_tied = false;  ///< another result of nearest(), or an object it omits, may be as near
};

/// Immutable: any number of threads may query it.
class SceneBodies {
 public:
  /// The scene is committed, and outlives this.
  explicit SceneBodies(const HeldScene& scene);

  /// All tested pairs whose distance is not proven to be above `within`, by their numbers: a < b.
  /// `run` computes the distances.
  std::vector<ScenePair> near(double within, double tolerance, const RunParts& run) const;

  /// Independent of the rules. Throws CallError if both are half-spaces.
  SignedDistance distance(std::uint32_t a, std::uint32_t b, const SignedDistanceOptions& how) const;
  ContactManifold manifold(std::uint32_t a, std::uint32_t b, const SignedDistance& nearest) const;
  /// Fills `error`, if there is one; infinite for meshes and compounds, whose other parts are not
  /// considered.
  PairDerivative derivative(const ScenePair& pair, PairDerivativeError* error = nullptr) const;

  /// The objects nearest to a body, the nearest first; of those in a category of the mask.
  std::vector<ScenePair> nearest(const ContactBody& to, std::size_t count, double at_most) const;
  /// Derivative with respect to a twist of body `of`. A ridge if the pair is tied.
  PairDerivative derivative(const ContactBody& of, const ScenePair& pair,
                            PairDerivativeError* error = nullptr) const;

  /// Null of a half-space.
  const ContactBody* body(std::uint32_t object) const {
    return body_of_[object] == none ? nullptr : &body_of(object);
  }
  /// Origin of the frame that a twist moves.
  Vec3<double> origin(std::uint32_t object) const;
  /// True if another object's surface is no further from the point than `near`.
  bool is_another_at(const Vec3<double>& point, std::uint32_t object, double near) const;

  /// The object that is touched first; its number is in `body`.
  EarliestImpact first_impact(const PartsBody& moving, const RigidMotion& motion, double t_max,
                              std::uint32_t mask) const;
  /// Fills `error`, if there is one. A ridge if another object of the mask may be touched at the
  /// same time.
  PairDerivative derivative(const PartsBody& moving, const RigidMotion& motion,
                            const EarliestImpact& found, std::uint32_t mask,
                            PairDerivativeError* error) const;

  /// True if the object is a half-space for contact.
  bool is_half_space(std::uint32_t object) const { return half_space_of(object) != nullptr; }

 private:
  struct HalfSpace {
    std::uint32_t object;
    PlacedPlane plane;
    Vec3<double> origin;
    PairRules::Masks masks;
  };
  static constexpr std::uint32_t none = no_instance;

  /// A ball that holds a body, stored apart from the rest of it: many balls are tested for each
  /// body that is queried.
  struct Ball {
    Vec3<double> middle;
    double radius;
  };

  const HalfSpace* half_space_of(std::uint32_t object) const;
  const ContactBody& body_of(std::uint32_t object) const {
    return world_->bodies()[body_of_[object]];
  }
  bool are_looked_at(std::uint32_t a, std::uint32_t b) const;
  /// True if the test is true for a body whose box meets the given box.
  template <class Test>
  bool any_body_in(const Bounds<double>& box, const Test& test) const;
  PairDerivative derivative_of_pair(const ContactBody& of, const ScenePair& pair,
                                    PairDerivativeError* error) const;
  PairDerivative derivative_of_impact(const PartsBody& moving, const RigidMotion& motion,
                                      const EarliestImpact& found,
                                      PairDerivativeError* error) const;
  /// True if another object of the mask may be touched before the time by which `found.body`
  /// certainly is. `slowness` is the time per length of approach to that body.
  bool is_another_touched(const PartsBody& moving, const RigidMotion& motion,
                          const EarliestImpact& found, std::uint32_t mask, double slowness) const;
  void add_half_spaces_near(double within, std::vector<ScenePair>& pairs) const;

  const HeldScene& scene_;
  const ContactShape point_{Shape(Point())};
  std::optional<ContactWorld> world_;
  std::vector<Ball> balls_;             ///< of each body
  std::vector<std::uint32_t> objects_;  ///< of each body
  std::vector<std::uint32_t> body_of_;  ///< of each object; none of removed ones and half-spaces
  std::vector<HalfSpace> half_spaces_;
  std::vector<LinkPlace> places_;        ///< of each object of a robot
  std::vector<std::uint32_t> robot_of_;  ///< robot of each object, or none; empty: no robots
};

}  // namespace minkray
