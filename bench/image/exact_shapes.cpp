// SPDX-License-Identifier: MIT
// Minkray as its own renderer asks it.
#include "bench/image/clock.h"
#include "bench/image/subject.h"
#include "bench/image/tracers.h"
#include "core/parallel/parallel.h"

namespace minkray::bench {
namespace {

template <class T>
class ExactShapes : public Tracer {
 public:
  explicit ExactShapes(const Scene& scene) {
    Instances<T> instances = instances_of<T>(scene);
    const Clock clock;
    world_ = World<T>(std::move(instances));
    hierarchy_seconds_ = clock.seconds_on(thread_count());
  }

  std::vector<std::string> entries() const override { return {"single"}; }
  std::unique_ptr<RayQueue> queue(std::size_t) const override {
    return std::make_unique<Single>(world_);
  }
  Vec3<float> world_normal(const FirstHit& hit) const override { return hit.normal; }
  std::size_t bytes() const override { return world_.bytes(); }
  double hierarchy_seconds() const override { return hierarchy_seconds_; }

 private:
  class Single : public RayQueue {
   public:
    explicit Single(const World<T>& world) : world_(world) {}

    void prepare(const RaySpan& rays) override {
      rays_.clear();
      for (const Ray<float>& ray : rays.rays)
        rays_.push_back({ray.origin.cast<T>(), ray.direction.cast<T>(), T(ray.t_max)});
      leaves_.assign(rays.leaves.begin(), rays.leaves.end());
      leaves_.resize(rays.size(), no_instance);
    }
    void first_hits(std::span<FirstHit> hits) override {
      QueryCounts counts;
      for (std::size_t i = 0; i < rays_.size(); ++i) {
        const WorldHit<T> hit = world_.closest_hit(rays_[i], counts, leaves_[i]);
        hits[i] = {};
        if (!hit.found()) continue;
        hits[i] = {static_cast<float>(hit.cast.t()), hit.instance,
                   hit.cast.normal.template cast<float>()};
      }
    }
    void occluded(std::span<unsigned char> answers) override {
      QueryCounts counts;
      for (std::size_t i = 0; i < rays_.size(); ++i)
        answers[i] = world_.occluded(rays_[i], counts, leaves_[i]) ? 1 : 0;
    }

   private:
    const World<T>& world_;
    std::vector<Ray<T>> rays_;
    std::vector<std::uint32_t> leaves_;
  };

  World<T> world_;
  double hierarchy_seconds_ = 0;
};

}  // namespace

template <class T>
std::unique_ptr<Tracer> exact_shapes(const Scene& scene) {
  return std::make_unique<ExactShapes<T>>(scene);
}

template std::unique_ptr<Tracer> exact_shapes<float>(const Scene&);
template std::unique_ptr<Tracer> exact_shapes<double>(const Scene&);

}  // namespace minkray::bench
