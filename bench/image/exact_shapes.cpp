// SPDX-License-Identifier: MIT
// Minkray, asked ray by ray or for many rays at once.
#include <algorithm>
#include <array>

#include "bench/image/clock.h"
#include "bench/image/subject.h"
#include "bench/image/tracers.h"
#include "core/parallel/parallel.h"

namespace minkray::bench {
namespace {

template <class T>
class ExactShapes : public Tracer {
 public:
  ExactShapes(const Scene& scene, BvhBuild build) {
    Instances<T> instances = instances_of<T>(scene);
    const Clock clock;
    world_ = World<T>(std::move(instances), {}, build);
    hierarchy_seconds_ = clock.seconds_on(thread_count());
  }

  std::vector<std::string> entries() const override {
    return {"single", "16 together", std::to_string(most_rays_at_once) + " together", "stream"};
  }
  std::unique_ptr<RayQueue> queue(std::size_t entry) const override {
    constexpr std::array<std::size_t, 4> groups = {1, 16, most_rays_at_once, as_stream};
    return std::make_unique<Queue>(world_, groups[entry]);
  }
  Vec3<float> world_normal(const FirstHit& hit) const override { return hit.normal; }
  std::size_t bytes() const override { return world_.bytes(); }
  double hierarchy_seconds() const override { return hierarchy_seconds_; }

 private:
  static constexpr std::size_t as_stream = 0;

  static FirstHit as_first_hit(const WorldHit<T>& hit) {
    if (!hit.found()) return {};
    return {static_cast<float>(hit.cast.t()), hit.instance, hit.cast.normal.template cast<float>()};
  }

  /// One by one, as a stream, or `group` rays together; as in the renderer, only those that are
  /// coherent.
  class Queue : public RayQueue {
   public:
    Queue(const World<T>& world, std::size_t group) : world_(world), group_(group) {}

    void prepare(const RaySpan& rays) override {
      rays_.clear();
      together_ = group_ > 1 && rays.coherent;
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const Ray<float>& ray = rays.rays[i];
        rays_.push_back({{ray.origin.cast<T>(), ray.direction.cast<T>(), T(ray.t_max)},
                         rays.leaves.empty() ? no_instance : rays.leaves[i]});
      }
    }

    void first_hits(std::span<FirstHit> hits) override {
      QueryCounts counts;
      if (group_ == as_stream) {
        answers_.resize(rays_.size());
        world_.closest_hits_in_stream(rays_, answers_, counts);
        std::transform(answers_.begin(), answers_.end(), hits.begin(), as_first_hit);
        return;
      }
      if (!together_) {
        for (std::size_t i = 0; i < rays_.size(); ++i)
          hits[i] = as_first_hit(world_.closest_hit(rays_[i].ray, counts, rays_[i].skip));
        return;
      }
      for_groups([&](std::size_t begin, std::span<const WorldRay<T>> rays) {
        answers_.resize(rays.size());
        const std::span<WorldHit<T>> answers(answers_);
        world_.closest_hits(rays, answers, counts);
        std::transform(answers.begin(), answers.end(),
                       hits.begin() + static_cast<std::ptrdiff_t>(begin), as_first_hit);
      });
    }

    void occluded(std::span<unsigned char> answers) override {
      QueryCounts counts;
      if (group_ == as_stream) return world_.occluded_in_stream(rays_, answers, counts);
      if (!together_) {
        for (std::size_t i = 0; i < rays_.size(); ++i)
          answers[i] = world_.occluded(rays_[i].ray, counts, rays_[i].skip) ? 1 : 0;
        return;
      }
      for_groups([&](std::size_t begin, std::span<const WorldRay<T>> rays) {
        const RayGroupMask dark = world_.occluded(rays, counts);
        for (std::size_t i = 0; i < rays.size(); ++i)
          answers[begin + i] = static_cast<unsigned char>(dark >> i & 1);
      });
    }

   private:
    template <class Take>
    void for_groups(const Take& take) const {
      for (std::size_t begin = 0; begin < rays_.size(); begin += group_)
        take(begin, std::span(rays_).subspan(begin, std::min(group_, rays_.size() - begin)));
    }

    const World<T>& world_;
    std::size_t group_;
    bool together_ = false;
    std::vector<WorldRay<T>> rays_;
    std::vector<WorldHit<T>> answers_;
  };

  World<T> world_;
  double hierarchy_seconds_ = 0;
};

}  // namespace

template <class T>
std::unique_ptr<Tracer> exact_shapes(const Scene& scene, BvhBuild build) {
  return std::make_unique<ExactShapes<T>>(scene, build);
}

template std::unique_ptr<Tracer> exact_shapes<float>(const Scene&, BvhBuild);
template std::unique_ptr<Tracer> exact_shapes<double>(const Scene&, BvhBuild);

}  // namespace minkray::bench
