// SPDX-License-Identifier: MIT
#include "casters.h"

#include <algorithm>

#include "clock.h"

namespace bench {
namespace {

constexpr mk::Options one_thread{.threads = 1};

Answer answer_of(const mk::Hit& hit) {
  if (!hit.found()) return {};
  return {hit.t, hit.object};
}

class Ours : public Caster {
 public:
  Ours(std::string name_, const std::vector<mk::Ray>& rays)
      : Caster(std::move(name_)), rays_(rays), hits_(rays.size()) {}

  std::vector<Answer> answers() const override {
    std::vector<Answer> all;
    for (const mk::Hit& hit : hits_) all.push_back(answer_of(hit));
    return all;
  }

 protected:
  const std::vector<mk::Ray>& rays_;
  std::vector<mk::Hit> hits_;
};

class Span : public Ours {
 public:
  Span(const mk::Scene& scene, const std::vector<mk::Ray>& rays)
      : Ours("Scene::cast, one call", rays), scene_(scene) {}
  void cast() override { scene_.cast(rays_, hits_, one_thread); }

 private:
  const mk::Scene& scene_;
};

class Single : public Ours {
 public:
  Single(const mk::Scene& scene, const std::vector<mk::Ray>& rays)
      : Ours("Scene::cast, a ray a call", rays), scene_(scene) {}
  void cast() override {
    for (std::size_t i = 0; i < rays_.size(); ++i) hits_[i] = scene_.cast(rays_[i]);
  }

 private:
  const mk::Scene& scene_;
};

class AtShape : public Ours {
 public:
  AtShape(const mk::Shape& shape, const std::vector<mk::Ray>& rays, const mk::Pose& pose)
      : Ours("mk::cast", rays), shape_(shape), pose_(pose) {}
  void cast() override {
    for (std::size_t i = 0; i < rays_.size(); ++i) hits_[i] = mk::cast(shape_, rays_[i], pose_);
  }

 private:
  const mk::Shape& shape_;
  mk::Pose pose_;
};

class Shadows : public Caster {
 public:
  Shadows(const mk::Scene& scene, const std::vector<mk::Ray>& rays)
      : Caster("Scene::occluded, one call"), scene_(scene), rays_(rays), blocked_(rays.size()) {}
  void cast() override { scene_.occluded(rays_, blocked_, one_thread); }
  std::vector<Answer> answers() const override {
    std::vector<Answer> all;
    for (const std::uint8_t blocked : blocked_)
      all.push_back(blocked == mk::hit ? Answer{0, 0} : Answer{});
    return all;
  }

 private:
  const mk::Scene& scene_;
  const std::vector<mk::Ray>& rays_;
  std::vector<std::uint8_t> blocked_;
};

}  // namespace

std::unique_ptr<Caster> minkray_span(const mk::Scene& scene, const std::vector<mk::Ray>& rays,
                                     Question question) {
  if (question == Question::occlusion) return std::make_unique<Shadows>(scene, rays);
  return std::make_unique<Span>(scene, rays);
}

std::unique_ptr<Caster> minkray_single(const mk::Scene& scene, const std::vector<mk::Ray>& rays) {
  return std::make_unique<Single>(scene, rays);
}

std::unique_ptr<Caster> minkray_shape(const mk::Shape& shape, const std::vector<mk::Ray>& rays,
                                      const mk::Pose& pose) {
  return std::make_unique<AtShape>(shape, rays, pose);
}

double Caster::timed_cast() {
  const Clock clock;
  cast();
  return clock.processor();
}

void race(std::initializer_list<const Casters*> groups, int rounds) {
  // The first round warms caches up and does not count.
  for (int round = 0; round <= rounds; ++round)
    for (const Casters* group : groups)
      for (const auto& caster : *group) {
        caster->prepare();
        const double seconds = caster->timed_cast();
        if (round > 0) caster->seconds = std::min(caster->seconds, seconds);
      }
}

const Caster& fastest(const Casters& casters, const std::function<bool(const Caster&)>& right) {
  const Caster* best = nullptr;
  bool best_is_right = false;
  for (const auto& caster : casters) {
    const bool is_right = !right || right(*caster);
    if (best && (best_is_right != is_right ? best_is_right : best->seconds <= caster->seconds))
      continue;
    best = caster.get();
    best_is_right = is_right;
  }
  return *best;
}

std::uint32_t hash_of(const std::vector<Answer>& answers) {
  Hash hash;
  for (const Answer& answer : answers) {
    hash.add(answer.t);
    hash.add(answer.object);
  }
  return hash.value();
}

}  // namespace bench
