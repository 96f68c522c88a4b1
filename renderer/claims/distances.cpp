// SPDX-License-Identifier: MIT
// Distance algorithm: claims h and i.
#include <ctime>
#include <limits>

#include "renderer/claims/claim.h"
#include "renderer/claims/samples.h"
#include "renderer/paper/distance.h"

namespace minkray {
namespace {

struct Pair {
  CentredShape a, b;
};

/// Half of them far apart, half at a hair's breadth, which is where simplices get flat.
std::vector<Pair> make_pairs(const ClaimOptions& options, int count) {
  Samples samples(options.seed);
  std::vector<Pair> pairs;
  const auto shape = [&](int i) -> Shape {
    switch (i % 5) {
      case 0:
        return Box{{1, 0.5, 0.25}};
      case 1:
        return Cylinder{0.5, 0.75};
      case 2:
        return Cone{0.5, 0.75};
      case 3:
        return Ellipsoid{{1, 0.6, 0.3}};
      default:
        return samples.hull(32);
    }
  };
  for (int i = 0; i < count; ++i) {
    const Mat3<double> turn_a = samples.rotation(), turn_b = samples.rotation();
    CentredShape a = centred(shape(i), Affine<double>{turn_a, Vec3<double>::Zero()});
    CentredShape b = centred(shape(i / 5), Affine<double>{turn_b, unit(samples.in_ball(1)) * 4});
    if (i % 2) {
      const auto far = distance_between(a, b);
      b.centre -= (far.distance - std::pow(10, samples.in(-9, -3))) * far.axis;
    }
    pairs.push_back({a, b});
  }
  return pairs;
}

/// The distance in float or in double, with supports in double.
template <class T>
DistanceResult<T, 3> bare_distance(const Pair& pair, SubalgorithmKind kind) {
  const auto supports = [&](const Vec3<T>& v) {
    const Vec3<double> n = v.template cast<double>();
    return SupportPair<T, 3>{pair.a.about_centre.support(n).template cast<T>(),
                             pair.b.about_centre.support(Vec3<double>(-n)).template cast<T>()};
  };
  const Vec3<T> apart = (pair.b.centre - pair.a.centre).template cast<T>();
  const T radius = T(pair.a.radius + pair.b.radius);
  return with_subalgorithm<T, 3>(kind, [&]<class G>(G Y) {
    return gjk_distance<T, 3>(supports, apart, radius, DistanceOptions<T, 3>(), Y);
  });
}

struct Score {
  double worst = 0, seconds = std::numeric_limits<double>::infinity();
  int iterations = 0, backups = 0, exhausted = 0, above_tolerance = 0;
};

template <class T>
Score score(SubalgorithmKind kind, const std::vector<Pair>& pairs,
            const std::vector<double>& reference) {
  Score result;
  const std::clock_t start = std::clock();  // processor time: other load does not count
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto answer = bare_distance<T>(pairs[i], kind);
    const double error = std::abs(double(answer.distance) - reference[i]);
    result.worst = std::max(result.worst, error);
    result.above_tolerance += error > 16 * double(tolerance::epsilon<T>);
    result.iterations += answer.iterations;
    result.backups += answer.backups;
    result.exhausted += answer.status == DistanceStatus::exhausted;
  }
  result.seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
  return result;
}

using Scores = std::array<Score, named_subalgorithms.size()>;

template <class T>
Scores compare(const char* precision, const std::vector<Pair>& pairs,
               const std::vector<double>& reference, ClaimResult& result) {
  constexpr int rounds = 3;
  std::array<double, named_subalgorithms.size()> seconds;
  seconds.fill(std::numeric_limits<double>::infinity());
  Scores scores;
  for (int round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < scores.size(); ++i) {
      scores[i] = score<T>(named_subalgorithms[i].kind, pairs, reference);
      seconds[i] = std::min(seconds[i], scores[i].seconds);
    }
  for (std::size_t i = 0; i < scores.size(); ++i) scores[i].seconds = seconds[i];
  const double n = static_cast<double>(pairs.size());
  for (std::size_t i = 0; i < scores.size(); ++i)
    result.ours.push_back(
        formatted("%s %-15s %6.0f ns, %5.2f iterations, worst error %.1e, %d above 16 epsilon, "
                  "%d backups, %d gave up",
                  precision, std::string(named_subalgorithms[i].name).c_str(), 1e9 * seconds[i] / n,
                  scores[i].iterations / n, scores[i].worst, scores[i].above_tolerance,
                  scores[i].backups, scores[i].exhausted));
  return scores;
}

}  // namespace

ClaimResult subalgorithm_comparison(const ClaimOptions& options) {
  const int count = std::max(100, options.rays / 10);
  const std::vector<Pair> pairs = make_pairs(options, count);
  // The reference: the projections' result instead of long double, with its certificate checked.
  std::vector<double> reference;
  double widest = 0;
  for (const Pair& pair : pairs) {
    const auto answer = distance_between(pair.a, pair.b);
    reference.push_back(answer.distance);
    widest = std::max(widest, answer.distance - answer.lower);
  }
  ClaimResult result;
  result.ours.push_back(
      formatted("%d pairs of shapes about 1 wide, half of them 1e-9 to 1e-3 apart; "
                "reference: projections in double, proven to %.1e by planes",
                count, widest));
  const Scores in_double = compare<double>("double", pairs, reference, result),
               in_float = compare<float>("float ", pairs, reference, result);
  // In the order of the list.
  constexpr std::size_t projection = 0, johnson = 1, volumes = 2;
  const auto gave_up = [&](std::size_t i) {
    return in_double[i].exhausted + in_float[i].exhausted;
  };
  const auto time = [&](std::size_t i) {
    return in_double[i].seconds / in_double[projection].seconds;
  };
  result.verdict = formatted(
      "signs spoilt by rounding are %s: Johnson's backup ran %d times; signed volumes are %s "
      "reliable "
      "(gave up %d times, Johnson %d, projections %d) and %s (%.2f and %.2f of the projections' "
      "time)",
      in_double[johnson].backups > 0 ? "confirmed" : "not confirmed",
      in_double[johnson].backups + in_float[johnson].backups,
      gave_up(volumes) < gave_up(johnson) ? "confirmed more" : "not confirmed more",
      gave_up(volumes), gave_up(johnson), gave_up(projection),
      time(volumes) < time(johnson) ? "confirmed faster" : "not confirmed faster", time(volumes),
      time(johnson));
  return result;
}

ClaimResult distance_decreases(const ClaimOptions& options) {
  Samples samples(options.seed);
  int runs = 0, steps = 0, longest = 0, increases = 0;
  double worst = 0;
  for (int i = 0; i < options.rays / 10; ++i) {
    const auto polygon = [&] {
      std::vector<Vec3<double>> points;
      for (int k = 0; k < 9; ++k) {
        points.push_back(samples.in_cube(1));
        points.back().z() = 0;
      }
      return Shape(Hull{PointCloud(std::move(points))});
    };
    const auto a = centred(polygon());
    Vec3<double> away = samples.in_cube(3);
    away.z() = 0;
    const auto b = centred(polygon(), Affine<double>{Mat3<double>::Identity(), away});
    double length = std::numeric_limits<double>::infinity();
    const auto result = distance_in_plane(a, b, {}, SubalgorithmKind::projection,
                                          [&](const DistanceIteration<double, 2>& step) {
                                            if (step.upper > length) {
                                              ++increases;
                                              worst = std::max(worst, step.upper - length);
                                            }
                                            length = step.upper;
                                          });
    steps += result.iterations;
    longest = std::max(longest, result.iterations);
    ++runs;
  }
  ClaimResult result;
  result.ours = {
      formatted("%d pairs of polygons: %.1f iterations on average, at most %d; |V| grew %d "
                "times",
                runs, double(steps) / runs, longest, increases)};
  result.verdict = increases == 0 ? "confirmed" : "not confirmed";
  return result;
}

}  // namespace minkray
