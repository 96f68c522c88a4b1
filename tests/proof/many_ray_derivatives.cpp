// SPDX-License-Identifier: MIT
// Derivatives of many rays' t, by the ray and by the body, compared with central differences of
// entries in long double (tests/oracle/line_entry.h): a row for each kind of shape. Errors outside
// of their bounds are counted; `bound` is the median of the bounds, relative to the derivative.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "minkray/minkray_c_pairs.h"
#include "renderer/member_json/shape_json.h"
#include "tests/core/pair_derivative/derivative_judge.h"
#include "tests/oracle/line_entry.h"

namespace {

using namespace minkray;
using namespace minkray::testing;
using Long = long double;

struct Row {
  long hits = 0, smooth = 0, flagged = 0, needless = 0, missed = 0, unsure = 0, large = 0,
       outside = 0, judged = 0;
  double error = 0;
  std::vector<double> bounds;

  void add(const Row& other) {
    hits += other.hits;
    smooth += other.smooth;
    flagged += other.flagged;
    needless += other.needless;
    missed += other.missed;
    unsure += other.unsure;
    large += other.large;
    outside += other.outside;
    judged += other.judged;
    bounds.insert(bounds.end(), other.bounds.begin(), other.bounds.end());
    error = std::max(error, other.error);
  }
  void print(std::string_view name) {
    std::ranges::sort(bounds);
    const auto known = std::ranges::count_if(bounds, [](double one) { return std::isfinite(one); });
    std::printf("%-18.*s %9ld %9ld %8ld %8ld %7ld %7ld %8ld %9.1e %8ld %8ld %9ld %9.1e\n",
                static_cast<int>(name.size()), name.data(), hits, smooth, flagged, needless, missed,
                unsure, large, error, outside, judged, static_cast<long>(known),
                bounds.empty() ? 0 : bounds[bounds.size() / 2]);
  }
};

void require(int code) {
  if (code == MINKRAY_OK) return;
  std::fprintf(stderr, "%s\n", minkray_last_error());
  std::exit(3);
}

/// A ray and a body, moved along one of both.
struct Placed {
  Affine<Long> pose;
  Real3 origin, direction;

  Placed moved(bool of_ray, const Real3& first, const Real3& second, Long step) const {
    Placed moved = *this;
    if (of_ray) {
      moved.origin += step * first;
      moved.direction += step * second;
    } else {
      moved.pose = twisted({nullptr, pose}, first, second, step).pose;
    }
    return moved;
  }
};

class RayJudge {
 public:
  RayJudge(const LineEntries& entries, const Placed& placed, double size,
           const Vec3<double>& normal)
      : entries_(entries), placed_(placed), size_(size), normal_(normal) {
    middle_ = t_at(placed);
  }

  struct Truth {
    Slope slope = Slope::unsure;
    Long derivative = 0;
  };
  /// The derivative along one of both, and by how much it may be off: differences of fourth order
  /// by shorter and shorter steps, those that agree best.
  struct Precise {
    Long derivative = 0, unsure = std::numeric_limits<Long>::infinity();
  };
  Precise precise(bool of_ray, const Real3& first, const Real3& second) const {
    const auto central = [&](Long step) {
      return (t_at(placed_.moved(of_ray, first, second, step)) -
              t_at(placed_.moved(of_ray, first, second, -step))) /
             (2 * step);
    };
    Precise best;
    Long before = std::numeric_limits<Long>::infinity();
    for (Long step = 1e-3L; step > 0.9e-7L; step /= 10) {
      const Long slope = (4 * central(step / 2) - central(step)) / 3;
      const Long rounding =
          64 * std::numeric_limits<Long>::epsilon() * (1 + std::abs(middle_)) / step;
      const Long off = std::abs(slope - before) + rounding;
      if (off < best.unsure) best = {slope, off};
      before = slope;
    }
    return best;
  }

  Truth along(bool of_ray, const Real3& first, const Real3& second) const {
    constexpr Long agreed = 1e-7L, kinked = 1e-4L;
    Truth best;
    if (!std::isfinite(middle_)) return best;
    Long least = agreed, before = 0, kink_before = 0;
    int kinks = 0, steps = 0;
    for (Long step = 1e-5L; step > 0.9e-9L; step /= 10, ++steps) {
      const Long up = t_at(placed_.moved(of_ray, first, second, step)),
                 down = t_at(placed_.moved(of_ray, first, second, -step));
      if (!std::isfinite(up) || !std::isfinite(down)) {
        // Misses on one side as long as steps are seen.
        if (steps == 4) return {Slope::ridge, 0};
        before = std::numeric_limits<Long>::infinity();
        continue;
      }
      const Long slope = (up - down) / (2 * step);
      const Long kink = std::abs(up + down - 2 * middle_) / step / std::max(std::abs(slope), 1.0L);
      const Long rounding = 64 * std::numeric_limits<Long>::epsilon() * (1 + std::abs(middle_));
      if (steps > 0) {
        kinks += kink > kinked && kink > kink_before / 3 ? 1 : 0;
        const Long off =
            std::abs(slope - before) / std::max(std::abs(slope), 1.0L) + rounding / step;
        if (off < least) {
          least = off;
          best = {Slope::smooth, slope};
        }
      }
      before = slope;
      kink_before = kink;
    }
    if (kinks >= 4) return {Slope::ridge, 0};
    return kinks > 0 && kink_before > kinked ? Truth{} : best;
  }

 private:
  Long t_at(const Placed& at) const {
    const Mat3<Long> inverse = at.pose.linear.inverse();
    const LineEntry entry =
        entries_(inverse * (at.origin - at.pose.translation), inverse * at.direction, normal_);
    if (entry.answer != LineEntry::Answer::hit) return std::numeric_limits<Long>::infinity();
    return entry.t;
  }

  const LineEntries& entries_;
  Placed placed_;
  double size_;
  Vec3<double> normal_;
  Long middle_ = 0;
};

constexpr std::size_t rays_of_a_shape = 200;

/// Rays at one shape from some sizes away, some of them at its corners and edges.
Row judge_shape(const Shape& shape, RandomShapes& random) {
  Row row;
  const LineEntries entries(shape);
  const ContactShape ready(shape);
  const double size = ready.ball_radius();
  const Affine<double> pose{random.turn(), size * random.direction()};
  const Vec3<double> middle = middle_in_world(ready, pose);
  minkray_scene scene = {};
  minkray_shape handle = {};
  require(minkray_shape_read(write_shape(shape).dump().c_str(), nullptr, &handle));
  require(minkray_scene_make(&scene));
  minkray_pose plain = {};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) plain.rows[i][j] = pose.linear(i, j);
    plain.rows[i][3] = pose.translation[i];
  }
  require(minkray_scene_add(scene, handle, &plain, nullptr, nullptr));
  require(minkray_scene_commit(scene));
  std::vector<double> origins, directions;
  for (std::size_t i = 0; i < rays_of_a_shape; ++i) {
    Vec3<double> origin = middle + 4 * size * random.direction(),
                 target = middle + 0.8 * size * random.in(0, 1) * random.direction();
    if (i % 16 == 0) {
      // At a support point, which is a corner or on an edge, if the shape has any.
      const Vec3<double> n = random.direction();
      target = pose(shape.support(Vec3<double>(pose.linear.transpose() * n)));
      origin = target + 2 * size * (n + 0.5 * random.direction());
    }
    const Vec3<double> direction = target - origin;
    origins.insert(origins.end(), origin.data(), origin.data() + 3);
    directions.insert(directions.end(), direction.data(), direction.data() + 3);
  }
  constexpr std::size_t n = rays_of_a_shape;
  std::vector<double> t(n), lo(n), hi(n), points(3 * n), normals(3 * n), by_ray(6 * n),
      by_body(6 * n), of_ray_error(2 * n), of_body_error(2 * n);
  std::vector<std::uint32_t> objects(n);
  std::vector<std::uint8_t> status(n), is_ridge(n);
  minkray_ray_arrays rays = {};
  rays.size = sizeof rays;
  rays.origins = origins.data();
  rays.directions = directions.data();
  rays.origin_stride = rays.direction_stride = 3 * sizeof(double);
  minkray_hit_arrays hits = {};
  hits.size = sizeof hits;
  hits.t = t.data();
  hits.t_lo = lo.data();
  hits.t_hi = hi.data();
  hits.points = points.data();
  hits.normals = normals.data();
  hits.objects = objects.data();
  hits.status = status.data();
  const minkray_ray_derivatives derivatives = {sizeof derivatives,  by_ray.data(),
                                               by_body.data(),      is_ridge.data(),
                                               of_ray_error.data(), of_body_error.data()};
  require(minkray_scene_cast_arrays(scene, &rays, n, &hits, nullptr));
  require(minkray_scene_ray_derivatives(scene, &rays, n, &hits, &derivatives, nullptr));
  for (std::size_t i = 0; i < n; ++i) {
    if (status[i] != MINKRAY_HIT) continue;
    ++row.hits;
    row.flagged += is_ridge[i];
    const auto vector = [&](const std::vector<double>& of, std::size_t at) {
      return Vec3<double>(of[at], of[at + 1], of[at + 2]);
    };
    const RayJudge judge(entries,
                         {pose.cast<Long>(), vector(origins, 3 * i).cast<Long>(),
                          vector(directions, 3 * i).cast<Long>()},
                         size, pose.linear.transpose() * vector(normals, 3 * i));
    bool is_ridged = false, is_unsure = false;
    double error = 0, bound = 0;
    int outside = 0, judged = 0;
    for (int k = 0; k < (is_ridge[i] != 0 ? 8 : 2); ++k) {
      const bool of_ray = k % 2 == 0;
      const double angle = random.in(0, 1.5707963);
      // Lengths for points, angles for turns; directions are some sizes long.
      const Vec3<double> first = size * std::cos(angle) * random.direction(),
                         second = (of_ray ? size : 1) * std::sin(angle) * random.direction();
      const std::vector<double>& by = of_ray ? by_ray : by_body;
      const Vec3<double> by_first = vector(by, 6 * i), by_second = vector(by, 6 * i + 3);
      const auto truth = judge.along(of_ray, first.cast<Long>(), second.cast<Long>());
      is_ridged = is_ridged || truth.slope == Slope::ridge;
      is_unsure = is_unsure || truth.slope == Slope::unsure;
      const double told = by_first.dot(first) + by_second.dot(second);
      const double length =
          std::hypot(size * by_first.norm(), (of_ray ? size : 1) * by_second.norm());
      error = std::max(error, std::abs(static_cast<double>(truth.derivative) - told) / length);
      if (is_ridge[i] != 0 || truth.slope != Slope::smooth) continue;
      const std::vector<double>& errors = of_ray ? of_ray_error : of_body_error;
      const double allowed = errors[2 * i] * first.norm() + errors[2 * i + 1] * second.norm();
      bound = std::max(bound, allowed / length);
      const RayJudge::Precise slope =
          judge.precise(of_ray, first.cast<Long>(), second.cast<Long>());
      const Long exact = by_first.cast<Long>().dot(first.cast<Long>()) +
                         by_second.cast<Long>().dot(second.cast<Long>());
      // Differences that are much coarser than the bound judge nothing.
      judged += std::isfinite(allowed) && slope.unsure <= 10 * allowed ? 1 : 0;
      outside += std::abs(slope.derivative - exact) - 3 * slope.unsure > allowed ? 1 : 0;
    }
    if (is_ridged) {
      row.missed += is_ridge[i] != 0 ? 0 : 1;
    } else if (is_unsure) {
      ++row.unsure;
    } else {
      ++row.smooth;
      row.needless += is_ridge[i];
      if (is_ridge[i] != 0) continue;
      row.large += error > 1e-6 ? 1 : 0;
      row.outside += outside > 0 ? 1 : 0;
      row.judged += judged > 1 ? 1 : 0;
      row.bounds.push_back(bound);
      row.error = std::max(row.error, error);
    }
  }
  minkray_scene_release(scene);
  minkray_shape_release(handle);
  return row;
}

}  // namespace

int main(int count, char** words) {
  const long wanted = count > 1 ? std::atol(words[1]) : 100000;
  RandomShapes random(count > 2 ? static_cast<unsigned>(std::atol(words[2])) : 1);
  std::vector<Row> of_kinds(kinds_of_derived_bodies);
  Row all;
  std::vector<bool> is_known(kinds_of_derived_bodies, true);
  for (int kind = 0; all.hits < wanted; kind = (kind + 1) % kinds_of_derived_bodies) {
    const auto k = static_cast<std::size_t>(kind);
    if (!is_known[k]) continue;
    try {
      const Row row = judge_shape(derived_shape(kind, 1, random), random);
      of_kinds[k].add(row);
      all.add(row);
    } catch (const std::invalid_argument&) {
      is_known[k] = false;
    }
  }
  std::printf("%-18s %9s %9s %8s %8s %7s %7s %8s %9s %8s %8s %9s %9s\n", "kind", "hits", "smooth",
              "flagged", "needless", "missed", "unsure", "> 1e-6", "largest", "outside", "judged",
              "bounded", "bound");
  for (int i = 0; i < kinds_of_derived_bodies; ++i)
    if (is_known[static_cast<std::size_t>(i)])
      of_kinds[static_cast<std::size_t>(i)].print(name_of_derived(i));
  all.print("all");
  return all.missed + all.large + all.outside > 0 ? 1 : 0;
}
