// SPDX-License-Identifier: MIT
// What every ray caster that is measured looks like: it answers a whole batch of rays at one shape,
// as its users would ask it.
#pragma once

#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/math/ray.h"
#include "core/shape/shape.h"

namespace minkray::bench {

/// The same rays twice: the numbers are floats. t_max is finite, beyond the shape.
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
  Vec3<float> normal = Vec3<float>::Zero();  ///< zero from those who do not tell
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
  /// What takes no part in the timing: the batch in the peer's own layout.
  virtual void prepare(const RayBatch&) {}
  /// The batch that was prepared; one hit a ray.
  virtual void cast(const RayBatch& rays, std::span<Hit> hits) = 0;

 private:
  std::string name_;
};

using Peers = std::vector<std::unique_ptr<Peer>>;

/// A peer from a function that answers one ray of scalar T: Hit(const Ray<T>&).
template <class T, class Entry>
class SingleRays : public Peer {
 public:
  SingleRays(std::string name, Entry entry) : Peer(std::move(name)), entry_(std::move(entry)) {}

  void cast(const RayBatch& rays, std::span<Hit> hits) override {
    if constexpr (std::is_same_v<T, float>) {
      for (std::size_t i = 0; i < hits.size(); ++i) hits[i] = entry_(rays.in_float[i]);
    } else {
      for (std::size_t i = 0; i < hits.size(); ++i) hits[i] = entry_(rays.in_double[i]);
    }
  }

 private:
  Entry entry_;
};

template <class T, class Entry>
std::unique_ptr<Peer> single_rays(std::string name, Entry entry) {
  return std::make_unique<SingleRays<T, Entry>>(std::move(name), std::move(entry));
}

/// For those who answer with one number, infinite for a miss.
inline Hit hit_at(double t) {
  Hit hit;
  if (!(t < std::numeric_limits<double>::infinity())) return hit;
  hit.outcome = Outcome::hit;
  hit.t_base = t;
  return hit;
}

}  // namespace minkray::bench
