// SPDX-License-Identifier: MIT
// Interface of every ray caster that is measured: answers a whole batch of rays at one shape, as
// its users would call it: with rays and results in its own layout.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "core/math/ray.h"
#include "core/shape/shape.h"

namespace minkray::bench {

/// The rays are there twice: the numbers are floats. t_max is finite, beyond the shape.
struct RayBatch {
  std::vector<Ray<float>> in_float;
  std::vector<Ray<double>> in_double;
  bool coherent = false;  ///< neighbours start at one point and go nearly the same way

  std::size_t size() const { return in_float.size(); }
};

enum class Outcome : unsigned char { miss, hit, exhausted };

struct Hit {
  Outcome outcome = Outcome::miss;
  int supports = 0;  ///< support calls, where there are any
  double t_base = 0, t_offset = 0;
  Vec3<float> normal = Vec3<float>::Zero();  ///< zero from peers without normals
};

class Peer {
 public:
  explicit Peer(std::string name) : name_(std::move(name)) {}
  virtual ~Peer() = default;
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  const std::string& name() const { return name_; }
  /// Triangles, for meshes.
  virtual std::size_t triangles() const { return 0; }
  /// The batch in the peer's own layout, ready to be cast once. Not timed.
  virtual void prepare(const RayBatch& rays) = 0;
  /// Answers the batch that was prepared, into the peer's own layout. This is timed.
  virtual void cast() = 0;
  /// The answers, one per ray of the batch. Not timed.
  virtual void read(std::span<Hit> hits) const = 0;

 private:
  std::string name_;
};

using Peers = std::vector<std::unique_ptr<Peer>>;

/// A peer from a function that answers one ray of scalar T, and one that makes a Hit of an answer.
template <class T, class Entry, class ToHit>
class SingleRays : public Peer {
 public:
  SingleRays(std::string name, Entry entry, ToHit to_hit)
      : Peer(std::move(name)), entry_(std::move(entry)), to_hit_(std::move(to_hit)) {}

  void prepare(const RayBatch& batch) override {
    if constexpr (std::is_same_v<T, float>)
      rays_ = batch.in_float;
    else
      rays_ = batch.in_double;
    answers_.assign(rays_.size(), {});
  }
  void cast() override {
    for (std::size_t i = 0; i < rays_.size(); ++i) answers_[i] = entry_(rays_[i]);
  }
  void read(std::span<Hit> hits) const override {
    for (std::size_t i = 0; i < hits.size(); ++i) hits[i] = to_hit_(answers_[i]);
  }

 private:
  Entry entry_;
  ToHit to_hit_;
  std::vector<Ray<T>> rays_;
  std::vector<std::invoke_result_t<const Entry&, const Ray<T>&>> answers_;
};

template <class T, class Entry, class ToHit = std::identity>
std::unique_ptr<Peer> single_rays(std::string name, Entry entry, ToHit to_hit = {}) {
  return std::make_unique<SingleRays<T, Entry, ToHit>>(std::move(name), std::move(entry),
                                                       std::move(to_hit));
}

/// This serves those who answer with one number, infinite for a miss.
inline Hit hit_at(double t) {
  Hit hit;
  if (!(t < std::numeric_limits<double>::infinity())) return hit;
  hit.outcome = Outcome::hit;
  hit.t_base = t;
  return hit;
}

}  // namespace minkray::bench
