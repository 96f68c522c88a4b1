// SPDX-License-Identifier: MIT
#include "renderer/sensor/scan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numbers>
#include <numeric>

#include "core/math/outward_sum.h"
#include "core/parallel/parallel.h"
#include "renderer/sensor/moving_scene.h"

namespace minkray {
namespace {

/// Rays of one index range: some hundred microseconds of work.
constexpr std::size_t rays_a_range = 2048;

/// Random numbers of one ray, whatever else is cast (Steele, Lea and Flood 2014: SplitMix).
class RayRandom {
 public:
  RayRandom(std::uint64_t seed, std::uint64_t ray)
      : state_(mixed(seed) ^ (ray * 0x9e3779b97f4a7c15u)) {}

  /// It is in (0, 1].
  double uniform() {
    state_ += 0x9e3779b97f4a7c15u;
    return (static_cast<double>(mixed(state_) >> 11) + 1) * 0x1p-53;
  }
  /// They have mean 0 and deviation 1 (Box and Muller 1958).
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

/// Two directions across, each of the given length.
Vec3<double> turned(const Vec3<double>& direction, double a, double b) {
  const Vec3<double> along = unit(direction);
  const Vec3<double> helper =
      std::abs(along.x()) < 0.5 ? Vec3<double>(1, 0, 0) : Vec3<double>(0, 1, 0);
  const Vec3<double> u = unit<double>(helper - along.dot(helper) * along);
  const Vec3<double> v = along.cross(u);
  return direction.norm() * unit<double>(along + std::tan(a) * u + std::tan(b) * v);
}

class Scanner {
 public:
  Scanner(const MovingScene& scene, const SensorRays& rays, const ScanOptions& options, Scan& scan)
      : scene_(scene), rays_(rays), options_(options), scan_(scan) {}

  /// Casts rays in the order of their times.
  void cast(std::span<const std::uint32_t> order, QueryCounts& counts) const {
    SceneWhile scene(scene_, time_of(order.front()), time_of(order.back()));
    std::vector<WorldRay> asked(order.size());
    std::vector<WorldHit> hits(order.size());
    std::vector<double> times(order.size());
    double time_of_pose = time_of(order.front());
    Affine<double> pose = pose_at(time_of_pose);
    for (std::size_t i = 0; i < order.size(); ++i) {
      times[i] = time_of(order[i]);
      if (times[i] != time_of_pose) pose = pose_at(time_of_pose = times[i]);
      asked[i] = {ray_of(order[i], pose)};
    }
    scene.closest_hits(asked, times, hits, counts);
    for (std::size_t i = 0; i < order.size(); ++i)
      keep(order[i], {asked[i].ray, times[i]}, hits[i], scene, counts);
  }

  double time_of(std::uint32_t index) const { return options_.start + rays_.rays[index].time; }

 private:
  struct TimedRay {
    Ray<double> ray;
    double time;
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
    return {pose(own.origin), pose.linear * direction, own.t_max};
  }

  void keep(std::uint32_t index, const TimedRay& at, WorldHit hit, SceneWhile& scene,
            QueryCounts& counts) const {
    const Ray<double>& ray = at.ray;
    RayRandom random(options_.seed + 1, index);
    const bool is_dropped = options_.dropout > 0 && random.uniform() <= options_.dropout;
    const double speed = ray.direction.norm();
    Echo* const echoes = scan_.echoes.data() + index * static_cast<std::size_t>(options_.returns);
    for (int k = 0; k < options_.returns; ++k) {
      Echo& echo = echoes[k];
      if (is_dropped) {
        echo.status = 3;
        continue;
      }
      if (!hit.found()) return;
      const double noise =
          options_.range_noise > 0 ? options_.range_noise * random.normals()[0] : 0;
      const CastResult<double>& cast = hit.cast;
      echo.status = cast.status == Status::hit ? 0 : 2;
      echo.t = speed > 0 ? std::max(0.0, cast.t() + noise / speed) : cast.t();
      echo.distance = speed > 0 ? echo.t * speed : 0;
      echo.point = ray.at(echo.t);
      echo.normal = cast.normal;
      echo.object = static_cast<std::int32_t>(hit.instance);
      echo.t_lo = sum_or_less(cast.t_base, cast.offset_lo);
      echo.t_hi = sum_or_more(cast.t_base, cast.offset_hi);
      if (k + 1 < options_.returns) hit = behind(at, hit, scene, counts);
    }
  }

  /// What the ray enters next, behind where it leaves what it met: bodies that overlap are passed
  /// as one.
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
      if (exit.status != Status::hit) return none;  // the ray ends in it
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
  const SensorRays& rays_;
  const ScanOptions& options_;
  Scan& scan_;
};

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
  std::vector<std::uint32_t> order(rays.rays.size());
  std::iota(order.begin(), order.end(), 0u);
  const MovingScene moving(scene);
  const Scanner scanner(moving, rays, options, result);
  if (moving.movers() > 0)
    std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return scanner.time_of(i); });
  // Where much moves, it is prepared for more rays at a time.
  const std::size_t some = std::max(rays_a_range, moving.movers());
  std::mutex mutex;
  std::size_t done = 0;
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
