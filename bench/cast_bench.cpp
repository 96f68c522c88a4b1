// SPDX-License-Identifier: MIT
// minkray-bench: rays at single shapes, our solvers beside closed forms, Embree on triangles and
// Bullet's ray cast, on the same rays in the same run, with errors beside the times.
//
// Time is per ray, on one thread. Counters: `error` is the largest |t - t_exact| * cos(incidence)
// of the hits, in units of the shape's bounding radius; `wrong` how many of the rays were hits
// taken for misses or the other way round; `supports` support calls per ray. Exact answers come
// from closed forms in long double, where there is one, else from the GJK ray cast in double.
#include <benchmark/benchmark.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bench/peers/bullet_cast.h"
#include "bench/peers/closed_forms.h"
#include "bench/peers/embree_triangles.h"
#include "core/shape/convert.h"
#include "core/solver/cast.h"
#include "tests/oracle/closed_form.h"
#include "tests/support/random.h"

namespace {

using namespace minkray;

/// A power of two, so that a mask can wrap the index around.
constexpr std::size_t ray_count = 4096;

struct Case {
  std::string name;
  Shape<double> shape;
  std::function<float(const Ray<float>&)> closed_form = {};
  int mesh_longitudes = 256;  ///< an error of about 1e-4 of the size
};

struct Truth {
  bool hit;
  double t;
  double cosine_per_radius;  ///< |direction . normal| / R: turns an error of t into one of distance
};

struct Rays {
  std::vector<Ray<float>> rays;
  std::vector<Truth> truths;
};

/// From a sphere of five radii, towards points in 0.6 of the bounding ball.
Rays make_rays(const Shape<double>& shape) {
  Rays made;
  const PreparedShape<double> prepared(shape);
  const Ball<double> ball = prepared.inner_ball();
  testing::Random random(2004);
  for (std::size_t i = 0; i < ray_count; ++i) {
    const Vec3<double> origin = ball.centre + 5 * ball.radius * random.direction();
    const Vec3<double> aim =
        ball.centre + 0.6 * ball.radius * std::cbrt(random.uniform(0, 1)) * random.direction();
    const Vec3<double> direction = (aim - origin) / 5;
    const Ray<float> ray{origin.cast<float>(), direction.cast<float>(), 10.0f};
    made.rays.push_back(ray);

    const Ray<double> same{ray.origin.cast<double>(), ray.direction.cast<double>(), 10.0};
    const CastResult<double> slow = cast_ray(prepared, same, {SolverKind::paper});
    Truth truth{slow.found(), slow.t(), std::abs(slow.normal.dot(same.direction)) / ball.radius};
    const auto exact = testing::line_in_shape(shape, same.origin.cast<long double>(),
                                              same.direction.cast<long double>());
    if (exact) {
      truth.hit = !exact->empty() && exact->lower >= 0;
      truth.t = static_cast<double>(exact->lower);
    }
    made.truths.push_back(truth);
  }
  return made;
}

struct Answer {
  bool hit;
  double t;
  int supports = 0;
};

template <class Cast>
void run(benchmark::State& state, const Rays& rays, const Cast& cast) {
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(cast(rays.rays[i]));
    i = (i + 1) & (ray_count - 1);
  }
  double error = 0, wrong = 0, supports = 0;
  for (std::size_t k = 0; k < ray_count; ++k) {
    const Answer answer = cast(rays.rays[k]);
    const Truth& truth = rays.truths[k];
    supports += answer.supports;
    if (answer.hit != truth.hit)
      wrong += 1;
    else if (answer.hit)
      error = std::max(error, std::abs(answer.t - truth.t) * truth.cosine_per_radius);
  }
  state.counters["error"] = error;
  state.counters["wrong"] = wrong;
  if (supports > 0) state.counters["supports"] = supports / static_cast<double>(ray_count);
}

template <class T>
Answer ours(const PreparedShape<T>& shape, const Ray<float>& ray, const CastOptions<T>& options) {
  const CastResult<T> result =
      cast_ray<T>(shape, {ray.origin.cast<T>(), ray.direction.cast<T>(), T(ray.t_max)}, options);
  return {result.found(), static_cast<double>(result.t()), result.supports};
}

Answer plain(float t) {
  return {std::isfinite(t), static_cast<double>(t)};
}

void add(const Case& subject) {
  const auto rays = std::make_shared<Rays>(make_rays(subject.shape));
  const auto f = std::make_shared<PreparedShape<float>>(convert<float>(subject.shape));
  const auto d = std::make_shared<PreparedShape<double>>(subject.shape);
  const auto enter = [&](const std::string& who, auto cast) {
    benchmark::RegisterBenchmark(
        (subject.name + "/" + who).c_str(),
        [rays, cast](benchmark::State& state) { run(state, *rays, cast); });
  };
  for (const SolverDescription& solver : solver_descriptions) {
    if (solver.kind != SolverKind::automatic && solver.kind != SolverKind::jet &&
        solver.kind != SolverKind::paper)
      continue;
    const std::string name(solver.name);
    enter(name + "/float",
          [f, kind = solver.kind](const Ray<float>& ray) { return ours<float>(*f, ray, {kind}); });
    enter(name + "/double",
          [d, kind = solver.kind](const Ray<float>& ray) { return ours<double>(*d, ray, {kind}); });
  }
  enter("paper-1e-4/float", [f](const Ray<float>& ray) {
    return ours<float>(*f, ray, {SolverKind::paper, 1e-4f});
  });
  if (subject.closed_form)
    enter("closed-form/float",
          [form = subject.closed_form](const Ray<float>& ray) { return plain(form(ray)); });
  const auto mesh =
      std::make_shared<bench::EmbreeTriangles>(subject.shape, subject.mesh_longitudes);
  enter("embree-" + std::to_string(mesh->triangles()) + "-triangles",
        [mesh](const Ray<float>& ray) { return plain(mesh->entry(ray)); });
  const std::shared_ptr<bench::BulletCast> bullet = bench::BulletCast::make(subject.shape);
  if (bullet)
    enter("bullet", [bullet](const Ray<float>& ray) { return plain(bullet->entry(ray)); });
}

std::vector<Case> cases() {
  using S = Shape<double>;
  const Vec3<float> radii(1.0f, 0.5f, 0.25f), extents(1.0f, 0.7f, 0.5f);
  testing::Random random(16);
  std::vector<Vec3<double>> few, many;
  for (int i = 0; i < 16; ++i) few.push_back(random.direction());
  for (int i = 0; i < 256; ++i) many.push_back(random.direction());
  const S box = Box<double>{extents.cast<double>()};
  const auto ball = [](const Ray<float>& ray) {
    return bench::ellipsoid_entry<float>({1, 1, 1}, ray);
  };
  return {
      {"sphere", Sphere<double>{1}, ball},
      {"ellipsoid", Ellipsoid<double>{radii.cast<double>()},
       [radii](const Ray<float>& ray) { return bench::ellipsoid_entry(radii, ray); }},
      {"box", box, [extents](const Ray<float>& ray) { return bench::box_entry(extents, ray); }},
      {"cylinder", Cylinder<double>{1, 1},
       [](const Ray<float>& ray) { return bench::cylinder_entry(1.0f, 1.0f, ray); }},
      {"capsule", Capsule<double>{1, 1},
       [](const Ray<float>& ray) { return bench::capsule_entry(1.0f, 1.0f, ray); }},
      {"cone", Cone<double>{1, 1}},
      {"frustum", Frustum<double>{{1, 0.3}, 1}},
      {"tapered_capsule", TaperedCapsule<double>{{1, 0.3}, 1}},
      {"rounded_box", Rounded<double>{0.2, box}},
      {"hull-16", Hull<double>{PointCloud<double>(few)}},
      {"hull-256", Hull<double>{PointCloud<double>(many)}},
      {"rounded_hull-16", Rounded<double>{0.1, S(Hull<double>{PointCloud<double>(few)})}},
      {"ellipsoid+ellipsoid", MinkowskiSum<double>{{S(Ellipsoid<double>{{1, 0.5, 0.25}}),
                                                    S(Ellipsoid<double>{{0.3, 0.5, 1}})}}},
      {"superellipsoid", Superellipsoid<double>{{1, 1, 1}, 4}},
  };
}

}  // namespace

int main(int argc, char** argv) {
  // Interleaved in random order, so that a noisy moment does not favour anybody.
  std::vector<std::string> words = {argv[0],
                                    "--benchmark_enable_random_interleaving=true",
                                    "--benchmark_counters_tabular=true",
                                    "--benchmark_min_time=0.05",
                                    "--benchmark_repetitions=3",
                                    "--benchmark_report_aggregates_only=true"};
  for (int i = 1; i < argc; ++i)
    words.push_back(std::string(argv[i]) == "--json" ? "--benchmark_format=json" : argv[i]);
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  int count = static_cast<int>(pointers.size());
  benchmark::Initialize(&count, pointers.data());
  if (benchmark::ReportUnrecognizedArguments(count, pointers.data())) return 2;
  for (const Case& subject : cases()) add(subject);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
