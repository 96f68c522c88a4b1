// SPDX-License-Identifier: MIT
// Casters of the same rays: each is one way to query one library.
#pragma once

#include <functional>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "agreement.h"
#include "vec.h"

namespace bench {

enum class Question { first_hit, occlusion };

/// Answers all rays by one library in one way.
class Caster {
 public:
  explicit Caster(std::string name_) : name(std::move(name_)) {}
  virtual ~Caster() = default;
  /// Brings the rays into the library's own layout; not timed, before every round.
  virtual void prepare() {}
  virtual void cast() = 0;
  /// Seconds of processor time that a cast takes.
  virtual double timed_cast();
  /// For occlusion, t is 0 and the object 0 where something is met.
  virtual std::vector<Answer> answers() const = 0;

  std::string name;
  double seconds = std::numeric_limits<double>::infinity();  ///< of the best round
};
using Casters = std::vector<std::unique_ptr<Caster>>;

/// All rays in one call, or one call a ray. The scene and the rays must outlive it.
std::unique_ptr<Caster> minkray_span(const mk::Scene& scene, const std::vector<mk::Ray>& rays,
                                     Question question);
std::unique_ptr<Caster> minkray_single(const mk::Scene& scene, const std::vector<mk::Ray>& rays);
/// mk::cast at one shape, one call a ray.
std::unique_ptr<Caster> minkray_shape(const mk::Shape& shape, const std::vector<mk::Ray>& rays,
                                      const mk::Pose& pose = mk::identity());

/// Lets all of them cast, round after round, so that a noisy moment meets all; the best round
/// counts.
void race(std::initializer_list<const Casters*> groups, int rounds);

/// The fastest of a group; of those whose answers are `right`, if there are any.
const Caster& fastest(const Casters& casters,
                      const std::function<bool(const Caster&)>& right = nullptr);

std::uint32_t hash_of(const std::vector<Answer>& answers);

}  // namespace bench
