// SPDX-License-Identifier: MIT
#include "renderer/sensor/scan.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <mutex>
#include <numbers>
#include <numeric>

#include "core/parallel/parallel.h"
#include "renderer/base/errors.h"
#include "renderer/film/render.h"
#include "renderer/json/mistakes.h"

namespace minkray {
namespace {

/// Rays of one index range: some hundred microseconds of work.
constexpr std::size_t rays_a_range = 2048;
constexpr auto together = static_cast<std::size_t>(most_rays_at_once);

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
  Scanner(const RenderWorld& world, const SensorRays& rays, const ScanOptions& options, Scan& scan)
      : world_(world), rays_(rays), options_(options), scan_(scan) {}

  /// The rays order[begin] to order[end - 1], with the sensor at this pose.
  void cast(std::span<const std::uint32_t> order, const Affine<double>& pose, QueryCounts& counts) {
    std::array<WorldRay<Real>, together> asked;
    std::array<WorldHit<Real>, together> hits;
    for (std::size_t first = 0; first < order.size(); first += together) {
      const std::size_t count = std::min(together, order.size() - first);
      for (std::size_t i = 0; i < count; ++i) asked[i] = {ray_of(order[first + i], pose)};
      world_.closest_hits(std::span(asked).first(count), std::span(hits).first(count), counts);
      for (std::size_t i = 0; i < count; ++i) keep(order[first + i], asked[i].ray, hits[i], counts);
    }
  }

 private:
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

  void keep(std::uint32_t index, const Ray<double>& ray, WorldHit<Real> hit, QueryCounts& counts) {
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
      const CastResult<Real>& cast = hit.cast;
      echo.status = cast.status == Status::hit ? 0 : 2;
      echo.t = speed > 0 ? std::max(0.0, cast.t() + noise / speed) : cast.t();
      echo.distance = speed > 0 ? echo.t * speed : 0;
      echo.point = ray.at(echo.t);
      echo.normal = cast.normal;
      echo.object = static_cast<std::int32_t>(hit.instance);
      echo.t_lo = cast.t_base + cast.offset_lo;
      echo.t_hi = cast.t_base + cast.offset_hi;
      if (k + 1 < options_.returns) hit = behind(ray, hit, counts);
    }
  }

  /// What the ray enters next, behind where it leaves what it met: bodies that overlap are passed
  /// as one.
  WorldHit<Real> behind(const Ray<double>& ray, WorldHit<Real> hit, QueryCounts& counts) const {
    double passed = 0;
    std::uint32_t left = hit.instance;
    WorldHit<Real> none;
    none.cast.status = Status::miss;
    if (world_.instances().is_half_space(left)) return none;
    for (int i = 0; i < 64; ++i) {
      const CastResult<Real> exit = cast_exit(world_.instances().at(left), ray);
      if (exit.status != Status::hit) return none;  // the ray ends in it
      passed = std::max(passed, exit.t());
      const Ray<double> rest{ray.at(passed), ray.direction, ray.t_max - passed};
      WorldHit<Real> next = world_.closest_hit(rest, counts, left);
      if (!next.found()) return none;
      if (next.cast.status == Status::hit) {
        next.cast.t_base += passed;
        return next;
      }
      left = next.instance;
      if (world_.instances().is_half_space(left)) return none;
    }
    return none;
  }

  const RenderWorld& world_;
  const SensorRays& rays_;
  const ScanOptions& options_;
  Scan& scan_;
};

/// The pose of what the sensor is mounted on, with what it scales.
Affine<double> mount_pose(const Scene& scene, std::size_t mount) {
  return mount < scene.objects.size() ? scene.objects[mount].pose : Affine<double>();
}

std::size_t mount_of(const Scene& scene, const std::string& name) {
  if (name.empty()) return scene.objects.size();
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    if (scene.objects[i].name == name) return i;
  throw WrongUsage("--on: the scene has no object \"" + printable(name, 60) + "\"");
}

}  // namespace

Scan scan(Scene& scene, const SensorRays& rays, const ScanOptions& options,
          const std::function<bool(double, std::uint64_t)>& progress) {
  const std::size_t mount = mount_of(scene, options.mount);
  Scan result;
  result.echoes.resize(rays.rays.size() * static_cast<std::size_t>(options.returns));
  std::vector<std::uint32_t> order(rays.rays.size());
  std::iota(order.begin(), order.end(), 0u);
  scene.camera.shutter = 0;
  set_time(scene, options.start);
  RenderWorld world = make_world(scene);
  Scanner scanner(world, rays, options, result);
  std::mutex mutex;
  std::size_t done = 0;
  const auto tell = [&](std::size_t count, const QueryCounts& counts) {
    const std::lock_guard lock(mutex);
    result.counts += counts;
    done += count;
    if (progress && !progress(double(done) / double(std::max<std::size_t>(order.size(), 1)), done))
      result.complete = false;
  };
  const auto cast_all = [&](std::span<const std::uint32_t> some) {
    const Affine<double> pose = mount_pose(scene, mount) * options.pose;
    parallel_for(some.size(), rays_a_range, [&](std::size_t begin, std::size_t end) {
      {
        const std::lock_guard lock(mutex);
        if (!result.complete) return;
      }
      QueryCounts counts;
      scanner.cast(some.subspan(begin, end - begin), pose, counts);
      tell(end - begin, counts);
    });
  };
  if (!moves(scene)) {
    cast_all(order);
    return result;
  }
  // At each moment the scene is put where it is then, for all rays of that moment.
  const auto time_of = [&](std::uint32_t i) { return rays.rays[i].time; };
  std::ranges::stable_sort(order, {}, time_of);
  for (std::size_t begin = 0; begin < order.size() && result.complete;) {
    std::size_t end = begin;
    while (end < order.size() && time_of(order[end]) == time_of(order[begin])) ++end;
    set_time(scene, options.start + time_of(order[begin]));
    follow(world, scene);
    cast_all(std::span(order).subspan(begin, end - begin));
    begin = end;
  }
  return result;
}

}  // namespace minkray
