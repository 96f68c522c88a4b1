// SPDX-License-Identifier: MIT
#include "bench/image/embree_scene.h"

#include <algorithm>
#include <stdexcept>

namespace minkray::bench {
namespace {

constexpr std::size_t lanes = 8;

RTCIntersectContext context_for(bool coherent) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags =
      coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  return context;
}

/// Embree marks what is occluded so.
bool is_occluded(float tfar) {
  return tfar < 0;
}

std::uint32_t chosen(EmbreeNumber number, unsigned instance, unsigned geometry,
                     unsigned primitive) {
  return number == EmbreeNumber::instance   ? instance
         : number == EmbreeNumber::geometry ? geometry
                                            : primitive;
}

/// Single rays, one call each or one call for all.
class Singles : public RayQueue {
 public:
  Singles(RTCScene scene, EmbreeNumber number, bool stream)
      : scene_(scene), number_(number), stream_(stream) {}

  void prepare(const RaySpan& rays) override {
    coherent_ = rays.coherent;
    queries_.resize(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Ray<float>& from = rays.rays[i];
      RTCRayHit& to = queries_[i];
      to.ray.org_x = from.origin.x();
      to.ray.org_y = from.origin.y();
      to.ray.org_z = from.origin.z();
      to.ray.tnear = 0;
      to.ray.dir_x = from.direction.x();
      to.ray.dir_y = from.direction.y();
      to.ray.dir_z = from.direction.z();
      to.ray.time = 0;
      to.ray.tfar = from.t_max;
      to.ray.mask = ~0u;
      to.ray.id = static_cast<unsigned>(i);
      to.ray.flags = 0;
      to.hit.geomID = to.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    }
  }

  void first_hits(std::span<FirstHit> hits) override {
    RTCIntersectContext context = context_for(coherent_);
    if (stream_)
      rtcIntersect1M(scene_, &context, queries_.data(), static_cast<unsigned>(queries_.size()),
                     sizeof(RTCRayHit));
    for (std::size_t i = 0; i < queries_.size(); ++i) {
      RTCRayHit& query = queries_[i];
      if (!stream_) rtcIntersect1(scene_, &context, &query);
      hits[i] = {};
      if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
      hits[i] = {query.ray.tfar,
                 chosen(number_, query.hit.instID[0], query.hit.geomID, query.hit.primID),
                 {query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z}};
    }
  }

  void occluded(std::span<unsigned char> answers) override {
    RTCIntersectContext context = context_for(coherent_);
    if (stream_)
      rtcOccluded1M(scene_, &context, &queries_[0].ray, static_cast<unsigned>(queries_.size()),
                    sizeof(RTCRayHit));
    for (std::size_t i = 0; i < queries_.size(); ++i) {
      if (!stream_) rtcOccluded1(scene_, &context, &queries_[i].ray);
      answers[i] = is_occluded(queries_[i].ray.tfar) ? 1 : 0;
    }
  }

 private:
  RTCScene scene_;
  EmbreeNumber number_;
  bool stream_, coherent_ = false;
  std::vector<RTCRayHit> queries_;
};

/// Packets of eight, one call each or, for first hits, one call for all.
class Packets : public RayQueue {
 public:
  Packets(RTCScene scene, EmbreeNumber number, bool stream)
      : scene_(scene), number_(number), stream_(stream) {}

  void prepare(const RaySpan& rays) override {
    coherent_ = rays.coherent;
    size_ = rays.size();
    packets_.resize((size_ + lanes - 1) / lanes);
    for (std::size_t i = 0; i < packets_.size() * lanes; ++i) {
      RTCRay8& to = packets_[i / lanes].ray;
      RTCHit8& hit = packets_[i / lanes].hit;
      const std::size_t lane = i % lanes;
      const Ray<float>& from = rays.rays[std::min(i, size_ - 1)];
      to.org_x[lane] = from.origin.x();
      to.org_y[lane] = from.origin.y();
      to.org_z[lane] = from.origin.z();
      to.tnear[lane] = 0;
      to.dir_x[lane] = from.direction.x();
      to.dir_y[lane] = from.direction.y();
      to.dir_z[lane] = from.direction.z();
      to.time[lane] = 0;
      // In streams, lanes beyond the end are switched off by an empty interval.
      to.tfar[lane] = i < size_ ? from.t_max : -1;
      to.mask[lane] = ~0u;
      to.id[lane] = static_cast<unsigned>(i);
      to.flags[lane] = 0;
      hit.geomID[lane] = hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
    }
  }

  void first_hits(std::span<FirstHit> hits) override {
    RTCIntersectContext context = context_for(coherent_);
    if (stream_)
      rtcIntersectNM(scene_, &context, reinterpret_cast<RTCRayHitN*>(packets_.data()), lanes,
                     static_cast<unsigned>(packets_.size()), sizeof(RTCRayHit8));
    for (std::size_t begin = 0; begin < size_; begin += lanes) {
      RTCRayHit8& query = packets_[begin / lanes];
      const std::size_t count = std::min(lanes, size_ - begin);
      if (!stream_) rtcIntersect8(valid(count), scene_, &context, &query);
      for (std::size_t lane = 0; lane < count; ++lane) {
        FirstHit& hit = hits[begin + lane];
        hit = {};
        if (query.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID) continue;
        hit = {query.ray.tfar[lane],
               chosen(number_, query.hit.instID[0][lane], query.hit.geomID[lane],
                      query.hit.primID[lane]),
               {query.hit.Ng_x[lane], query.hit.Ng_y[lane], query.hit.Ng_z[lane]}};
      }
    }
  }

  void occluded(std::span<unsigned char> answers) override {
    RTCIntersectContext context = context_for(coherent_);
    for (std::size_t begin = 0; begin < size_; begin += lanes) {
      RTCRay8& ray = packets_[begin / lanes].ray;
      const std::size_t count = std::min(lanes, size_ - begin);
      // Also for streams: rtcOccludedNM of Embree 3.13.5 has been seen not to return on instances.
      rtcOccluded8(valid(count), scene_, &context, &ray);
      for (std::size_t lane = 0; lane < count; ++lane)
        answers[begin + lane] = is_occluded(ray.tfar[lane]) ? 1 : 0;
    }
  }

 private:
  const int* valid(std::size_t count) {
    for (std::size_t lane = 0; lane < lanes; ++lane) valid_[lane] = lane < count ? -1 : 0;
    return valid_;
  }

  RTCScene scene_;
  EmbreeNumber number_;
  bool stream_, coherent_ = false;
  std::size_t size_ = 0;
  alignas(32) int valid_[lanes];
  std::vector<RTCRayHit8> packets_;
};

}  // namespace

EmbreeScene::EmbreeScene(int threads)
    : device_(rtcNewDevice(("threads=" + std::to_string(threads)).c_str())) {
  if (!device_) throw std::runtime_error("Embree: no device");
  rtcSetDeviceMemoryMonitorFunction(device_, &EmbreeScene::count, this);
  scene_ = rtcNewScene(device_);
}

EmbreeScene::~EmbreeScene() {
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

bool EmbreeScene::count(void* self, ssize_t bytes, bool) {
  static_cast<EmbreeScene*>(self)->bytes_ += bytes;
  return true;
}

std::vector<std::string> embree_entries() {
  return {"Intersect1", "Intersect8", "Intersect1M", "IntersectNM"};
}

std::unique_ptr<RayQueue> embree_queue(RTCScene scene, EmbreeNumber number, std::size_t entry) {
  const bool stream = entry >= 2;
  if (entry % 2 == 0) return std::make_unique<Singles>(scene, number, stream);
  return std::make_unique<Packets>(scene, number, stream);
}

}  // namespace minkray::bench
