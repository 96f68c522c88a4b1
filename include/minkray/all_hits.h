// SPDX-License-Identifier: MIT
// All hits of rays: where they enter and leave objects. Header-only over minkray_c.h, whose
// comments specify the details.
#pragma once

// Example:
//   const mk::AllHits found = scene.all_hits(rays);
//   for (const mk::Crossing& hit : found[0]) use(hit.t, hit.object, hit.leaves);
#include <new>

#include "minkray/minkray.h"

namespace minkray {
inline namespace v0 {

/// A point where a ray enters or leaves an object; see minkray_crossing.
struct Crossing {
  double t = 0, t_lo = 0, t_hi = 0;
  Vec3 point, normal;  ///< the normal is outward
  std::uint32_t object = no_object;
  std::int32_t part = -1;   ///< of a mesh or compound: the triangle or part
  std::int32_t leaves = 0;  ///< 0: the ray enters the object; 1: it leaves
  std::int32_t reserved = 0;
};
static_assert(sizeof(Crossing) == sizeof(minkray_crossing) &&
              offsetof(Crossing, leaves) == offsetof(minkray_crossing, leaves));

/// Owning list of the hits of many rays.
class AllHits {
 public:
  AllHits() = default;
  explicit AllHits(const minkray_all_hits& found) : AllHits() {
    const std::size_t rays = found.rays, hits = found.offsets[rays];
    offsets_ = new std::size_t[rays + 1];
    status_ = new std::uint8_t[rays + 1];
    hits_ = new Crossing[hits + 1];
    rays_ = rays;
    for (std::size_t i = 0; i <= rays; ++i) offsets_[i] = found.offsets[i];
    for (std::size_t i = 0; i < rays; ++i) status_[i] = found.status[i];
    const auto* const first = reinterpret_cast<const Crossing*>(found.hits);
    for (std::size_t i = 0; i < hits; ++i) hits_[i] = first[i];
  }
  AllHits(AllHits&& from) noexcept { swap(from); }
  AllHits& operator=(AllHits&& from) noexcept {
    swap(from);
    return *this;
  }
  ~AllHits() {
    delete[] offsets_;
    delete[] status_;
    delete[] hits_;
  }

  /// Number of rays.
  std::size_t size() const { return rays_; }
  /// Hits of the i-th ray, sorted by t.
  View<const Crossing> operator[](std::size_t i) const {
    return {hits_ + offsets_[i], offsets_[i + 1] - offsets_[i]};
  }
  /// Hits of all rays.
  View<const Crossing> hits() const { return {hits_, rays_ > 0 ? offsets_[rays_] : 0}; }
  /// Result of the i-th ray: hit, miss, or exhausted if hits may be missing.
  Status status(std::size_t i) const { return static_cast<Status>(status_[i]); }

 private:
  void swap(AllHits& other) noexcept {
    std::swap(rays_, other.rays_);
    std::swap(offsets_, other.offsets_);
    std::swap(status_, other.status_);
    std::swap(hits_, other.hits_);
  }
  std::size_t rays_ = 0;
  std::size_t* offsets_ = nullptr;
  std::uint8_t* status_ = nullptr;
  Crossing* hits_ = nullptr;
};

inline AllHits Scene::all_hits(View<const Ray> rays, const Options& options) const {
  struct Taken {
    AllHits hits;
    bool no_room = false;
  } taken;
  const auto take = [](void* user, const minkray_all_hits* found) {
    auto& to = *static_cast<Taken*>(user);
    try {
      to.hits = AllHits(*found);
      return 0;
    } catch (const std::bad_alloc&) {
      to.no_room = true;
      return 1;
    }
  };
  // In arrays a t_max of 0 ends the ray.
  const detail::Room<double> ends(rays.size() + 1);
  for (std::size_t i = 0; i < rays.size(); ++i)
    ends.items[i] = rays[i].t_max == 0 ? std::numeric_limits<double>::infinity() : rays[i].t_max;
  const Ray none;
  const Ray* const first = rays.size() > 0 ? rays.data() : &none;
  minkray_ray_arrays from = {};
  from.size = sizeof from;
  from.origins = &first->origin.x;
  from.directions = &first->direction.x;
  from.t_max = ends.items;
  from.origin_stride = from.direction_stride = sizeof(Ray);
  from.t_max_stride = sizeof(double);
  const minkray_options how = detail::plain(options);
  const int code = minkray_scene_all_hits(handle_, &from, rays.size(), take, &taken, &how);
  if (taken.no_room) throw std::bad_alloc();
  detail::check(code);
  return std::move(taken.hits);
}
inline AllHits Scene::all_hits(const Ray& ray) const {
  return all_hits({&ray, 1}, {1, nullptr, nullptr});
}

}  // namespace v0
}  // namespace minkray
