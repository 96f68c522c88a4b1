// SPDX-License-Identifier: MIT
// Minkray, by single rays or by many at once.
#include <algorithm>
#include <array>

#include "bench/image/clock.h"
#include "bench/image/subject.h"
#include "bench/image/tracers.h"
#include "core/parallel/parallel.h"

namespace minkray::bench {
namespace {

class ExactShapes : public Tracer {
 public:
  ExactShapes(const Scene& scene, BvhBuild build) {
    Instances instances = instances_of(scene);
    const Clock clock;
    world_ = World(std::move(instances), {}, build);
    hierarchy_seconds_ = clock.seconds_on(thread_count());
  }

  std::vector<std::string> entries() const override { return {"single", "together"}; }
  std::unique_ptr<RayQueue> queue(std::size_t entry) const override {
    return std::make_unique<Queue>(world_, entry == 1);
  }
  Vec3<float> world_normal(const FirstHit& hit) const override { return hit.normal; }
  std::size_t bytes() const override { return world_.bytes(); }
  double hierarchy_seconds() const override { return hierarchy_seconds_; }

 private:
  static FirstHit as_first_hit(const WorldHit& hit) {
    if (!hit.found()) return {};
    return {static_cast<float>(hit.cast.t()), hit.instance, hit.cast.normal.cast<float>()};
  }

  class Queue : public RayQueue {
   public:
    Queue(const World& world, bool together) : world_(world), together_(together) {}

    void prepare(const RaySpan& rays) override {
      rays_.clear();
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const Ray<float>& ray = rays.rays[i];
        rays_.push_back({{ray.origin.cast<double>(), ray.direction.cast<double>(), ray.t_max},
                         rays.leaves.empty() ? no_instance : rays.leaves[i]});
      }
    }

    void first_hits(std::span<FirstHit> hits) override {
      QueryCounts counts;
      answers_.resize(rays_.size());
      if (together_)
        world_.closest_hits(rays_, answers_, counts);
      else
        for (std::size_t i = 0; i < rays_.size(); ++i)
          answers_[i] = world_.closest_hit(rays_[i], counts);
      std::transform(answers_.begin(), answers_.end(), hits.begin(), as_first_hit);
    }

    void occluded(std::span<unsigned char> answers) override {
      QueryCounts counts;
      if (together_) return world_.occluded(std::span<const WorldRay>(rays_), answers, counts);
      for (std::size_t i = 0; i < rays_.size(); ++i)
        answers[i] = world_.occluded(rays_[i], counts) ? 1 : 0;
    }

   private:
    const World& world_;
    bool together_;
    std::vector<WorldRay> rays_;
    std::vector<WorldHit> answers_;
  };

  World world_;
  double hierarchy_seconds_ = 0;
};

}  // namespace

std::unique_ptr<Tracer> exact_shapes(const Scene& scene, BvhBuild build) {
  return std::make_unique<ExactShapes>(scene, build);
}

}  // namespace minkray::bench
