// SPDX-License-Identifier: MIT
#include "renderer/compare/compare_scene.h"

#include <algorithm>
#include <mutex>
#include <sstream>

#include "core/derived/shape_bounds.h"
#include "core/parallel/parallel.h"
#include "renderer/compare/half_space_check.h"
#include "renderer/compare/mesh_check.h"
#include "renderer/rays/camera.h"
#include "renderer/scene/scene_instances.h"

namespace minkray {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The pixels whose rays may meet the box: around its corners, or all if one is behind the camera.
PixelRect pixels_of(const Bounds<double>& bounds, const Camera& camera, int width, int height) {
  PixelRect rect{width, height, 0, 0};
  for (int i = 0; i < 8; ++i) {
    const Vec3<double> corner((i & 1 ? bounds.upper : bounds.lower).x(),
                              (i & 2 ? bounds.upper : bounds.lower).y(),
                              (i & 4 ? bounds.upper : bounds.lower).z());
    const auto at = camera.project(corner);
    if (!at) return {0, 0, width, height};
    const auto pixel = [](double x, int size) {
      return static_cast<int>(std::floor(std::clamp(x, -1.0, size + 1.0)));
    };
    rect.x0 = std::min(rect.x0, pixel(at->x(), width) - 1);
    rect.y0 = std::min(rect.y0, pixel(at->y(), height) - 1);
    rect.x1 = std::max(rect.x1, pixel(at->x(), width) + 2);
    rect.y1 = std::max(rect.y1, pixel(at->y(), height) + 2);
  }
  return {std::max(rect.x0, 0), std::max(rect.y0, 0), std::min(rect.x1, width),
          std::min(rect.y1, height)};
}

/// Judges one object along the camera's rays and keeps what is nearest. judge(ray) is for rays in
/// the frame of the check, a SandwichedShape or a MeshCheck.
template <class Check, class Judge>
void look_at(const Check& check, const Camera& camera, DifferencePicture& difference,
             std::mutex& mutex, const Judge& judge) {
  const PixelRect rect = pixels_of(check.bounds(), camera, difference.width, difference.height);
  for (int y = rect.y0; y < rect.y1; ++y) {
    struct Seen {
      double t = infinity;
      float gap = 0;
      bool violation = false;
    };
    std::vector<Seen> row(static_cast<std::size_t>(std::max(rect.width(), 0)));
    for (int x = rect.x0; x < rect.x1; ++x) {
      const RayInFrame ray = check.to_frame(camera.ray(x + 0.5, y + 0.5));
      const Verdict verdict = judge(ray.ray);
      Seen& seen = row[static_cast<std::size_t>(x - rect.x0)];
      seen.violation = verdict.violation.has_value();
      if (!verdict.result.found()) continue;
      seen.t = ray.t_base + verdict.result.t() * ray.t_per_length;
      seen.gap = static_cast<float>(verdict.t_inner - verdict.t_outer);
    }
    const std::lock_guard lock(mutex);
    for (int x = rect.x0; x < rect.x1; ++x) {
      const Seen& seen = row[static_cast<std::size_t>(x - rect.x0)];
      const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(difference.width) +
                         static_cast<std::size_t>(x);
      if (seen.violation) difference.violation[pixel] = true;
      if (!(seen.t < difference.t[pixel])) continue;
      difference.t[pixel] = seen.t;
      difference.gap[pixel] = seen.gap;
    }
  }
}

/// A half-space's rays go through all pixels.
void look_at(const HalfSpaceCheck& check, const Camera& camera, DifferencePicture& difference,
             std::mutex& mutex) {
  const std::lock_guard lock(mutex);
  for (int y = 0; y < difference.height; ++y)
    for (int x = 0; x < difference.width; ++x) {
      const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(difference.width) +
                         static_cast<std::size_t>(x);
      const Verdict verdict = check.judge(camera.ray(x + 0.5, y + 0.5));
      if (verdict.violation) difference.violation[pixel] = true;
      if (!verdict.result.found() || !(verdict.result.t() < difference.t[pixel])) continue;
      difference.t[pixel] = verdict.result.t();
      difference.gap[pixel] = static_cast<float>(verdict.t_inner - verdict.t_outer);
    }
}

}  // namespace

int SceneComparison::violations() const {
  int sum = 0;
  for (const ObjectComparison& object : objects) sum += object.report.total_violations();
  return sum;
}

int SceneComparison::pixel_violations() const {
  return static_cast<int>(std::ranges::count(difference.violation, true));
}

std::int64_t SceneComparison::rays() const {
  std::int64_t sum = 0;
  for (const ObjectComparison& object : objects) sum += object.report.rays;
  return sum;
}

double SceneComparison::disagreements_per_million() const {
  std::int64_t sum = 0;
  for (const ObjectComparison& object : objects)
    sum += object.report.violations[static_cast<std::size_t>(Violation::false_hit)] +
           object.report.violations[static_cast<std::size_t>(Violation::false_miss)];
  return rays() > 0 ? 1e6 * static_cast<double>(sum) / static_cast<double>(rays()) : 0;
}

void find_incomparable(const Scene& scene, Mistakes& mistakes) {
  // Boxes of 1e307 have rays whose ways through them overflow; at 1e306 all are answered.
  constexpr double furthest = 1e306;
  for (std::size_t i = 0; i < instance_count(scene); ++i) {
    const Object object = instance_object(scene, i);
    if (!object.has_shape()) continue;
    const Shape placed = Transform{Nested(object.shape), AffineMap(object.pose)};
    const Bounds<double> bounds = bounds_of(placed);
    const double reach =
        std::max(bounds.lower.cwiseAbs().maxCoeff(), bounds.upper.cwiseAbs().maxCoeff());
    if (reach <= furthest) continue;
    std::ostringstream text;
    text << "object \"" << object.name << "\": must not reach further than " << furthest
         << " to be compared, for its rays begin three sizes away (got " << reach << ")";
    mistakes.add(text.str());
  }
}

SceneComparison compare_scene(const Scene& scene, const CompareSceneOptions& options,
                              const std::function<bool(double, std::uint64_t)>& progress) {
  SceneComparison comparison;
  const std::size_t count = instance_count(scene);
  comparison.objects.resize(count);
  DifferencePicture& difference = comparison.difference;
  difference.width = options.picture.width;
  difference.height = options.picture.height;
  const auto pixels =
      static_cast<std::size_t>(difference.width) * static_cast<std::size_t>(difference.height);
  difference.t.assign(pixels, infinity);
  difference.gap.assign(pixels, 0);
  difference.violation.assign(pixels, false);
  std::optional<Camera> camera;
  if (pixels > 0) camera.emplace(scene.camera, options.picture);

  std::mutex picture_mutex, progress_mutex;
  std::size_t done = 0;
  std::uint64_t rays = 0;
  bool stopped = false;
  parallel_for(count, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      {
        const std::lock_guard lock(progress_mutex);
        if (stopped) return;
      }
      const Object object = instance_object(scene, i);
      ObjectComparison& result = comparison.objects[i];
      result.name = object.name;
      if (object.half_space) {
        result.shape = half_space_name;
        const HalfSpaceCheck check(object.half_space->posed(object.pose));
        result.report = check.compare(options.object);
        if (camera) look_at(check, *camera, difference, picture_mutex);
      } else if (object.mesh) {
        result.shape = mesh_name;
        const MeshCheck check(PosedMesh(0, object.mesh, object.pose));
        result.report = check.compare(options.object);
        if (camera)
          look_at(check, *camera, difference, picture_mutex,
                  [&](const Ray<float>& ray) { return check.judge(ray); });
      } else {
        const Shape placed = Transform{Nested(object.shape), AffineMap(object.pose)};
        const SandwichedShape shape(placed, options.object.sandwich);
        result.shape =
            std::visit([](const auto& kind) { return std::string(kind.name); }, object.shape.kind);
        result.report = shape.compare(options.object);
        if (camera)
          look_at(shape, *camera, difference, picture_mutex,
                  [&](const Ray<float>& ray) { return shape.judge(ray, options.object.cast); });
      }
      const std::lock_guard lock(progress_mutex);
      ++done;
      rays += static_cast<std::uint64_t>(result.report.rays);
      const double fraction = static_cast<double>(done) / static_cast<double>(count);
      if (progress && !progress(fraction, rays)) stopped = true;
    }
  });
  return comparison;
}

}  // namespace minkray
