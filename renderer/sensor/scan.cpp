// SPDX-License-Identifier: MIT
#include "renderer/sensor/scan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <mutex>
#include <numbers>

#include "core/math/outward_sum.h"
#include "core/parallel/parallel.h"
#include "renderer/sensor/beam.h"
#include "renderer/sensor/moving_scene.h"
#include "renderer/sensor/ray_directions.h"
#include "renderer/sensor/reflectance.h"

namespace minkray {
namespace {

/// Rays per index range: some hundred microseconds of work.
constexpr std::size_t rays_a_range = 2048;

/// Random numbers of one ray, independent of all other rays (Steele, Lea and Flood 2014: SplitMix).
class RayRandom {
 public:
  RayRandom(std::uint64_t seed, std::uint64_t ray)
      : state_(mixed(seed) ^ (ray * 0x9e3779b97f4a7c15u)) {}

  /// Uniform in (0, 1].
  double uniform() {
    state_ += 0x9e3779b97f4a7c15u;
    return (static_cast<double>(mixed(state_) >> 11) + 1) * 0x1p-53;
  }
  /// Normal with mean 0 and deviation 1 (Box and Muller 1958).
  std::array<double, 2> normals() {
    const double radius = std::sqrt(-2 * std::log(uniform()));
    const double angle = 2 * std::numbers::pi * uniform();
    return {radius * std::cos(angle), radius * std::sin(angle)};
  }

 private:
  static std::uint64_t mixed(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
  }
  std::uint64_t state_;
};

/// Turns a direction by small angles about two perpendicular directions.
Vec3<double> turned(const Vec3<double>& direction, double a, double b) {
  const Vec3<double> along = unit(direction);
  const auto [u, v] = across(along);
  return direction.norm() * unit<double>(along + std::tan(a) * u + std::tan(b) * v);
}

class Scanner {
 public:
  Scanner(const MovingScene& scene, std::vector<float> reflectances, const SensorRays& rays,
          const ScanOptions& options, Scan& scan)
      : scene_(scene),
        reflectances_(std::move(reflectances)),
        rays_(rays),
        options_(options),
        rays_of_beam_(options.divergence > 0 ? options.beam_rays : 1),
        scan_(scan) {}

  /// Casts rays in the order of their times.
  void cast(std::span<const std::uint32_t> order, QueryCounts& counts) const {
    SceneWhile scene(scene_, time_of(order.front()), time_of(order.back()));
    const auto each = static_cast<std::size_t>(rays_of_beam_);
    std::vector<WorldRay> asked;
    asked.reserve(order.size() * each);
    std::vector<WorldHit> hits(order.size() * each);
    std::vector<TimedRay> middles;
    std::vector<double> times;
    times.reserve(order.size() * each);
    double time_of_pose = time_of(order.front());
    Affine<double> pose = pose_at(time_of_pose);
    for (const std::uint32_t index : order) {
      const double time = time_of(index);
      if (time != time_of_pose) pose = pose_at(time_of_pose = time);
      const Ray<double> middle = ray_of(index, pose);
      middles.push_back({middle, time});
      times.insert(times.end(), each, time);
      if (each == 1) {
        asked.push_back({middle});
        continue;
      }
      for (const Vec3<double>& direction :
           directions_of_beam(middle.direction, options_.divergence, rays_of_beam_))
        asked.push_back({{middle.origin, direction, middle.t_max}});
    }
    scene.closest_hits(asked, times, hits, counts);
    AllMet all;
    for (std::size_t i = 0; i < order.size(); ++i) {
      const auto of_beam = [&](auto& list) { return std::span(list).subspan(i * each, each); };
      keep(order[i], middles[i], of_beam(asked), of_beam(hits), scene, counts, all);
    }
  }

  double time_of(std::uint32_t index) const { return options_.start + rays_.rays[index].time; }

 private:
  struct TimedRay {
    Ray<double> ray;
    double time;
  };
  /// All hits of one ray; `too_near` is true if any was left out for being too near.
  struct AllMet {
    std::vector<Met> echoes;
    bool too_near = false;
  };

  Affine<double> pose_at(double time) const {
    return options_.mount.at(time) * options_.path.at(time) * options_.pose;
  }

  Ray<double> ray_of(std::uint32_t index, const Affine<double>& pose) const {
    const Ray<double>& own = rays_.rays[index].ray;
    Vec3<double> direction = own.direction;
    if (options_.angle_noise > 0) {
      RayRandom random(options_.seed, index);
      const auto [a, b] = random.normals();
      direction = turned(direction, options_.angle_noise * a, options_.angle_noise * b);
    }
    const Vec3<double> in_world = pose.linear * direction;
    const double speed = in_world.norm();
    const double most = speed > 0 ? options_.farthest / speed : own.t_max;
    return {pose(own.origin), in_world, std::min(own.t_max, most)};
  }

  void keep(std::uint32_t index, const TimedRay& at, std::span<const WorldRay> asked,
            std::span<const WorldHit> hits, SceneWhile& scene, QueryCounts& counts,
            AllMet& all) const {
    RayRandom random(options_.seed + 1, index);
    const bool is_dropped = options_.dropout > 0 && random.uniform() <= options_.dropout;
    const auto several = static_cast<std::size_t>(options_.returns);
    const std::span<Echo> echoes(scan_.echoes.data() + index * several, several);
    if (is_dropped) {
      for (Echo& echo : echoes) echo.status = 3;
      return;
    }
    all.echoes.clear();
    all.too_near = false;
    if (options_.divergence > 0)
      add_echoes_of_beam(asked, hits, all);
    else
      add_bodies_behind_each_other(at, hits[0], scene, counts, all);
    if (options_.order == EchoOrder::last) std::ranges::reverse(all.echoes);
    if (options_.order == EchoOrder::strongest)
      std::ranges::stable_sort(all.echoes, std::greater(), &Met::intensity);
    const double speed = at.ray.direction.norm();
    for (std::size_t k = 0; k < several; ++k) {
      Echo& echo = echoes[k];
      if (k >= all.echoes.size()) {
        if (k == 0 && all.too_near) echo.status = 4;
        return;
      }
      const Met& met = all.echoes[k];
      const double deviation =
          options_.range_noise + options_.range_noise_per_length * met.distance;
      const double noise = deviation > 0 ? deviation * random.normals()[0] : 0;
      const auto in_lengths = [&](double distance) { return speed > 0 ? distance / speed : 0; };
      echo.status = met.is_inside ? 2 : 0;
      echo.t = std::max(0.0, met.t + in_lengths(noise));
      echo.distance = echo.t * speed;
      echo.point = at.ray.at(echo.t);
      echo.normal = met.normal;
      echo.object = static_cast<std::int32_t>(met.instance);
      echo.t_lo = met.t_lo;
      echo.t_hi = met.t_hi;
      echo.incidence = met.incidence;
      echo.intensity = met.intensity;
    }
  }

  Met met_by(const Ray<double>& ray, const WorldHit& hit) const {
    const CastResult<double>& cast = hit.cast;
    const double speed = ray.direction.norm(), share = 1.0 / rays_of_beam_;
    Met met;
    met.t = cast.t();
    met.distance = met.t * speed;
    met.normal = cast.normal;
    met.instance = hit.instance;
    met.t_lo = sum_or_less(cast.t_base, cast.offset_lo);
    met.t_hi = sum_or_more(cast.t_base, cast.offset_hi);
    met.is_inside = cast.status != Status::hit;
    const double sizes = speed * cast.normal.norm();
    if (met.is_inside || !(sizes > 0)) {
      met.incidence = std::numeric_limits<double>::quiet_NaN();
      return met;
    }
    const double cosine = std::min(1.0, std::abs(ray.direction.dot(cast.normal)) / sizes);
    met.incidence = std::acos(cosine);
    const double distance = std::max(met.distance, std::numeric_limits<double>::min());
    if (met.distance > 0)
      met.intensity = share * reflectances_[hit.instance] * cosine / (distance * distance);
    return met;
  }

  /// Joins the first hits of a beam's rays to echoes.
  void add_echoes_of_beam(std::span<const WorldRay> asked, std::span<const WorldHit> hits,
                          AllMet& all) const {
    std::vector<Met> met;
    for (std::size_t i = 0; i < hits.size(); ++i)
      if (hits[i].found()) add_if_far(met_by(asked[i].ray, hits[i]), met, all);
    all.echoes = echoes_of(std::move(met), options_.resolution);
  }

  /// Adds the bodies that a ray enters one after another, no more than needed.
  void add_bodies_behind_each_other(const TimedRay& at, WorldHit hit, SceneWhile& scene,
                                    QueryCounts& counts, AllMet& all) const {
    constexpr std::size_t most_bodies = 64;
    const std::size_t enough = options_.order == EchoOrder::first
                                   ? static_cast<std::size_t>(options_.returns)
                                   : most_bodies;
    for (std::size_t i = 0; i < 2 * most_bodies && hit.found(); ++i) {
      add_if_far(met_by(at.ray, hit), all.echoes, all);
      if (all.echoes.size() == enough) break;
      hit = behind(at, hit, scene, counts);
    }
  }

  /// Adds a hit, or records that it is nearer than the least range.
  void add_if_far(const Met& met, std::vector<Met>& to, AllMet& all) const {
    if (met.distance >= options_.nearest)
      to.push_back(met);
    else
      all.too_near = true;
  }

  /// Next body that the ray enters after it leaves the one it hit. Overlapping bodies count as one.
  static WorldHit behind(const TimedRay& at, const WorldHit& hit, SceneWhile& scene,
                         QueryCounts& counts) {
    const Ray<double>& ray = at.ray;
    double passed = 0;
    std::uint32_t left = hit.instance;
    WorldHit none;
    none.cast.status = Status::miss;
    if (scene.is_half_space(left)) return none;
    for (int i = 0; i < 64; ++i) {
      const CastResult<double> exit = scene.exit(left, ray, at.time);
      if (exit.status != Status::hit) return none;  // the ray ends in the body
      passed = std::max(passed, exit.t());
      const Ray<double> rest{ray.at(passed), ray.direction, ray.t_max - passed};
      WorldHit next = scene.closest_hit({rest, left}, at.time, counts);
      if (!next.found()) return none;
      if (next.cast.status == Status::hit) {
        next.cast.t_base += passed;
        return next;
      }
      left = next.instance;
      if (scene.is_half_space(left)) return none;
    }
    return none;
  }

  const MovingScene& scene_;
  std::vector<float> reflectances_;  ///< by instance
  const SensorRays& rays_;
  const ScanOptions& options_;
  int rays_of_beam_;
  Scan& scan_;
};

/// Numbers of the rays with a finite direction. The echoes of all others get the status "no ray".
std::vector<std::uint32_t> rays_that_are(const SensorRays& rays, int returns, Scan& scan) {
  std::vector<std::uint32_t> order;
  order.reserve(rays.rays.size());
  const auto several = static_cast<std::size_t>(returns);
  for (std::uint32_t i = 0; i < rays.rays.size(); ++i) {
    if (rays.rays[i].ray.direction.allFinite())
      order.push_back(i);
    else
      for (std::size_t k = 0; k < several; ++k) scan.echoes[i * several + k].status = 5;
  }
  return order;
}

}  // namespace

std::optional<MovingFrame> frame_of_object(const Scene& scene, const std::string& name) {
  for (const Object& object : scene.objects)
    if (object.name == name) return MovingFrame{object.pose, object.motion};
  return std::nullopt;
}

Scan scan(const Scene& scene, const SensorRays& rays, const ScanOptions& options,
          const std::function<bool(double, std::uint64_t)>& progress) {
  Scan result;
  result.echoes.resize(rays.rays.size() * static_cast<std::size_t>(options.returns));
  std::vector<std::uint32_t> order = rays_that_are(rays, options.returns, result);
  const MovingScene moving(scene);
  const Scanner scanner(moving, reflectances_of(scene), rays, options, result);
  if (moving.movers() > 0)
    std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return scanner.time_of(i); });
  // Ranges have at least one ray per mover, since each range prepares all movers.
  const std::size_t of_beam =
      options.divergence > 0 ? static_cast<std::size_t>(options.beam_rays) : 1;
  const std::size_t some = std::max({rays_a_range / of_beam, moving.movers(), std::size_t{1}});
  std::mutex mutex;
  std::size_t done = 0;
  if (order.empty()) return result;
  parallel_for(order.size(), some, [&](std::size_t begin, std::size_t end) {
    {
      const std::lock_guard lock(mutex);
      if (!result.complete) return;
    }
    QueryCounts counts;
    scanner.cast(std::span(order).subspan(begin, end - begin), counts);
    const std::lock_guard lock(mutex);
    result.counts += counts;
    done += end - begin;
    if (progress && !progress(double(done) / double(order.size()), done)) result.complete = false;
  });
  return result;
}

}  // namespace minkray
