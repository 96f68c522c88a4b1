// SPDX-License-Identifier: MIT
// Batches of pairs: distances and times of impact of all pairs of nine shapes, compared with FCL
// and Bullet; what derivatives and threads cost; the near pairs of a scene.
#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btSubSimplexConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include <chrono>
#include <functional>

#include "clock.h"
#include "nine_bodies.h"
#include "random.h"
#include "sections.h"

namespace bench {
namespace {

constexpr double distance_goal = 3, impact_goal = 4;  // peer / Minkray
constexpr double derivative_goal = 1.15;              // with derivatives / without
constexpr double threads_goal = 1.85;                 // one thread / two
constexpr std::size_t queries_of_a_batch = 100;       // batches per query of single pairs

/// A query a pair, one after the other: ask(i) answers a number, infinite if there is none.
class Loop : public Caster {
 public:
  Loop(std::string name_, std::size_t count, std::function<double(std::size_t)> ask)
      : Caster(std::move(name_)), found_(count), ask_(std::move(ask)) {}
  void cast() override {
    for (std::size_t i = 0; i < found_.size(); ++i) found_[i] = ask_(i);
  }
  std::vector<Answer> answers() const override {
    std::vector<Answer> all;
    for (const double t : found_) all.push_back(std::isfinite(t) ? Answer{t, 0} : Answer{});
    return all;
  }

 private:
  std::vector<double> found_;
  std::function<double(std::size_t)> ask_;
};

/// Two shapes at many poses; B moves by a way within a time of 1.
struct Batch {
  const NinthBody& a;
  const NinthBody& b;
  std::vector<mk::Pose> poses_a, poses_b, ends;
  std::vector<mk::Twist> ways;

  std::size_t size() const { return poses_a.size(); }
  mk::Bodies bodies_a() const { return {{&a.ours, 1}, poses_a, {}}; }
  mk::Bodies bodies_b(bool moving) const {
    return {{&b.ours, 1},
            poses_b,
            moving ? mk::View<const mk::Twist>(ways) : mk::View<const mk::Twist>()};
  }
};

/// Random turns; apart by a thousandth of their size at least and by twice their size at most, or
/// overlapping by as much. Most motions meet A.
Batch batch_of(const NinthBody& a, const NinthBody& b, std::size_t count, bool apart) {
  constexpr double least = 1e-3;
  Random random(11);
  const double size = a.radius + b.radius;
  Batch batch{a, b, {}, {}, {}, {}};
  while (batch.size() < count) {
    const Vec where =
        (apart ? random.within(0.6, 2) : random.within(0, 0.6)) * size * random.direction();
    const mk::Pose of_a = mk::pose({}, random.rotation()),
                   of_b = mk::pose(where, random.rotation());
    const Vec way = -2 * where + 0.7 * random.direction();
    const mk::Distance found = mk::signed_distance(a.ours, of_a, b.ours, of_b);
    if (apart ? found.lower <= least * size : found.upper >= -least * size) continue;
    batch.poses_a.push_back(of_a);
    batch.poses_b.push_back(of_b);
    batch.ends.push_back(mk::translation({way.x, way.y, way.z}) * of_b);
    batch.ways.push_back({{way.x, way.y, way.z}, {}});
  }
  return batch;
}

template <class Pose>
std::vector<Pose> all_of(const std::vector<mk::Pose>& poses, Pose (*convert)(const mk::Pose&)) {
  std::vector<Pose> all;
  for (const mk::Pose& pose : poses) all.push_back(convert(pose));
  return all;
}

std::function<double(std::size_t)> bullet_distance(const Batch& batch) {
  return [a = batch.a.bullet, b = batch.b.bullet,
          poses_a = all_of<btTransform>(batch.poses_a, to_bullet),
          poses_b = all_of<btTransform>(batch.poses_b, to_bullet)](std::size_t i) {
    btVoronoiSimplexSolver simplex;
    btGjkPairDetector detector(a.get(), b.get(), &simplex, nullptr);
    btGjkPairDetector::ClosestPointInput input;
    input.m_transformA = poses_a[i];
    input.m_transformB = poses_b[i];
    btPointCollector output;
    detector.getClosestPoints(input, output, nullptr);
    return output.m_hasResult ? double(output.m_distance) : INFINITY;
  };
}

std::function<double(std::size_t)> fcl_distance(const Batch& batch, fcl::GJKSolverType solver) {
  return [=, a = batch.a.fcl, b = batch.b.fcl,
          poses_a = all_of<fcl::Transform3d>(batch.poses_a, to_fcl),
          poses_b = all_of<fcl::Transform3d>(batch.poses_b, to_fcl)](std::size_t i) {
    fcl::DistanceRequestd request;
    request.gjk_solver_type = solver;
    request.enable_signed_distance = false;
    fcl::DistanceResultd result;
    try {
      fcl::distance(a.get(), poses_a[i], b.get(), poses_b[i], request, result);
    } catch (const std::exception&) {
      return double(INFINITY);
    }
    return result.min_distance;
  };
}

template <class Make>
std::function<double(std::size_t)> bullet_impact(const Batch& batch, const Make& make) {
  return [=, a = batch.a.bullet_for_casts, b = batch.b.bullet_for_casts,
          poses_a = all_of<btTransform>(batch.poses_a, to_bullet),
          poses_b = all_of<btTransform>(batch.poses_b, to_bullet),
          ends = all_of<btTransform>(batch.ends, to_bullet)](std::size_t i) {
    btVoronoiSimplexSolver simplex;
    auto caster = make(a.get(), b.get(), &simplex);
    btConvexCast::CastResult result;
    const bool met = caster.calcTimeOfImpact(poses_a[i], poses_a[i], poses_b[i], ends[i], result);
    return met && result.m_fraction <= 1 ? double(result.m_fraction) : INFINITY;
  };
}

std::function<double(std::size_t)> fcl_impact(const Batch& batch) {
  return
      [a = batch.a.fcl, b = batch.b.fcl, poses_a = all_of<fcl::Transform3d>(batch.poses_a, to_fcl),
       poses_b = all_of<fcl::Transform3d>(batch.poses_b, to_fcl),
       ends = all_of<fcl::Transform3d>(batch.ends, to_fcl)](std::size_t i) {
        fcl::ContinuousCollisionRequestd request;
        request.ccd_motion_type = fcl::CCDM_TRANS;
        request.ccd_solver_type = fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
        request.gjk_solver_type = fcl::GST_INDEP;
        fcl::ContinuousCollisionResultd result;
        try {
          fcl::continuousCollide(a.get(), poses_a[i], poses_a[i], b.get(), poses_b[i], ends[i],
                                 request, result);
        } catch (const std::exception&) {
          return double(INFINITY);
        }
        return result.is_collide ? double(result.time_of_contact) : INFINITY;
      };
}

class OurDistances : public Caster {
 public:
  explicit OurDistances(const Batch& batch, bool derive = false)
      : Caster(derive ? "with derivatives" : "signed_distances"),
        batch_(batch),
        found_(batch.size()) {
    options_.how.threads = 1;
    if (!derive) return;
    by_a_.resize(batch.size());
    by_b_.resize(batch.size());
    is_ridge_.resize(batch.size());
    options_.derivatives = {by_a_, by_b_, is_ridge_};
  }
  void cast() override {
    mk::signed_distances(batch_.bodies_a(), batch_.bodies_b(false), found_, options_);
  }
  std::vector<Answer> answers() const override {
    std::vector<Answer> all;
    for (const mk::Distance& found : found_) all.push_back({found.value, 0});
    return all;
  }

 private:
  const Batch& batch_;
  std::vector<mk::Distance> found_;
  std::vector<mk::Twist> by_a_, by_b_;
  std::vector<std::uint8_t> is_ridge_;
  mk::PairOptions options_;
};

class OurImpacts : public Caster {
 public:
  explicit OurImpacts(const Batch& batch, bool derive = false)
      : Caster(derive ? "with derivatives" : "times_of_impact"),
        batch_(batch),
        found_(batch.size()) {
    options_.how.threads = 1;
    if (!derive) return;
    by_a_.resize(batch.size());
    by_b_.resize(batch.size());
    is_ridge_.resize(batch.size());
    options_.derivatives = {by_a_, by_b_, is_ridge_};
  }
  void cast() override {
    constexpr double t_max[] = {1};
    mk::times_of_impact(batch_.bodies_a(), batch_.bodies_b(true), t_max, found_, options_);
  }
  std::vector<Answer> answers() const override {
    std::vector<Answer> all;
    for (const mk::Impact& found : found_)
      all.push_back(static_cast<int>(found.status) == MINKRAY_IMPACT ? Answer{found.t_lo, 0}
                                                                     : Answer{});
    return all;
  }

 private:
  const Batch& batch_;
  std::vector<mk::Impact> found_;
  std::vector<mk::Twist> by_a_, by_b_;
  std::vector<std::uint8_t> is_ridge_;
  mk::PairOptions options_;
};

void add_duel(Table& table, const Options& options, const std::string& what, const Batch& batch,
              std::unique_ptr<Caster> mine, const Casters& peers, double goal, const Trust& trust) {
  if (peers.empty()) return;
  Casters ours;
  ours.push_back(std::move(mine));
  race({&ours, &peers}, options.rounds);
  const auto right = [&](const Caster& peer) {
    return compare(ours[0]->answers(), peer.answers(), trust).holds;
  };
  table.add(Duel{what + batch.a.name + ", " + batch.b.name, "batch of " + with_commas(batch.size()),
                 *ours[0], fastest(peers, right), "", batch.size(), goal, trust});
}

void measure_distances(Table& table, const Options& options, const Batch& batch) {
  // Bullet counts in floats and stops at a thousandth of the distance.
  const Trust trust = {1e-4};
  Casters peers;
  const auto add = [&](const char* name, std::function<double(std::size_t)> ask) {
    peers.push_back(std::make_unique<Loop>(name, batch.size(), std::move(ask)));
  };
  if (batch.a.bullet && batch.b.bullet) add("Bullet, GJK", bullet_distance(batch));
  if (batch.a.fcl && batch.b.fcl) {
    add("FCL, own GJK", fcl_distance(batch, fcl::GST_INDEP));
    add("FCL, libccd", fcl_distance(batch, fcl::GST_LIBCCD));
  }
  add_duel(table, options, "distances: ", batch, std::make_unique<OurDistances>(batch), peers,
           distance_goal, trust);
}

void measure_impacts(Table& table, const Options& options, const Batch& batch) {
  // Bullet's casts stop at a thousandth; in one of twenty of their misses and hits they are wrong.
  const Trust trust = {1e-3, 0.05};
  Casters peers;
  const auto add = [&](const char* name, std::function<double(std::size_t)> ask) {
    peers.push_back(std::make_unique<Loop>(name, batch.size(), std::move(ask)));
  };
  btGjkEpaPenetrationDepthSolver depth;
  if (batch.a.bullet_for_casts && batch.b.bullet_for_casts) {
    using Shape = const btConvexShape*;
    using Simplex = btSimplexSolverInterface*;
    add("Bullet, subsimplex", bullet_impact(batch, [](Shape a, Shape b, Simplex simplex) {
          return btSubsimplexConvexCast(a, b, simplex);
        }));
    add("Bullet, GJK", bullet_impact(batch, [](Shape a, Shape b, Simplex simplex) {
          return btGjkConvexCast(a, b, simplex);
        }));
    add("Bullet, continuous", bullet_impact(batch, [&depth](Shape a, Shape b, Simplex simplex) {
          return btContinuousConvexCollision(a, b, simplex, &depth);
        }));
  }
  if (batch.a.fcl_casts && batch.b.fcl_casts)
    add("FCL, conservative advancement", fcl_impact(batch));
  add_duel(table, options, "times of impact: ", batch, std::make_unique<OurImpacts>(batch), peers,
           impact_goal, trust);
}

template <class Ours>
void add_cost(Table& table, const Options& options, const Batch& batch, const std::string& what) {
  Casters without, with;
  without.push_back(std::make_unique<Ours>(batch));
  with.push_back(std::make_unique<Ours>(batch, true));
  race({&without, &with}, options.rounds);
  const auto each = [&](const Caster& caster) {
    return std::to_string(std::lround(1e9 * caster.seconds / static_cast<double>(batch.size()))) +
           " ns";
  };
  table.add(Figure{"derivatives: " + batch.a.name + ", " + batch.b.name, what, each(*with[0]),
                   each(*without[0]) + " without", with[0]->seconds / without[0]->seconds,
                   derivative_goal, true});
}

void measure_derivatives(Table& table, const Options& options) {
  const std::vector<NinthBody> bodies = nine_bodies();
  const std::size_t count = queries_of_a_batch * options.queries / 10;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const NinthBody &a = bodies[i], &b = bodies[(i + 1) % bodies.size()];
    const Batch apart = batch_of(a, b, count, true);
    add_cost<OurDistances>(table, options, apart, "distances");
    add_cost<OurDistances>(table, options, batch_of(a, b, count / 10, false), "depths");
    add_cost<OurImpacts>(table, options, apart, "times of impact");
  }
}

double wall_seconds(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

std::string text_of(const char* format, double value) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

void measure_threads(Table& table, const Options& options) {
  const std::vector<NinthBody> bodies = nine_bodies();
  const Batch batch =
      batch_of(bodies[2], bodies[2], 10 * queries_of_a_batch * options.queries, true);
  std::vector<mk::Distance> found(batch.size());
  double best[2] = {INFINITY, INFINITY};
  for (int round = 0; round < options.rounds; ++round)
    for (const int threads : {1, 2}) {
      mk::PairOptions how;
      how.how.threads = threads;
      double& least = best[threads - 1];
      least = std::min(least, wall_seconds([&] {
                         mk::signed_distances(batch.bodies_a(), batch.bodies_b(false), found, how);
                       }));
    }
  table.add(Figure{"distances: box, box", "two threads, by the clock, " + with_commas(batch.size()),
                   text_of("%.3f s", best[1]), text_of("%.3f s, one thread", best[0]),
                   best[0] / best[1], threads_goal});
}

/// Bodies of nine shapes that fill a tenth of a cube, and all pairs nearer than a tenth of a size.
void measure_near_pairs(Table& table, const Options& options) {
  constexpr std::size_t object_count = 100'000;
  constexpr double within = 0.1, seconds_goal = 1;
  const std::vector<NinthBody> bodies = nine_bodies();
  Random random(5);
  const double half = 0.5 * std::cbrt(10.0 * object_count);
  mk::Scene scene;
  for (std::size_t i = 0; i < object_count; ++i)
    scene.add(bodies[i % bodies.size()].ours,
              mk::translation({random.within(-half, half), random.within(-half, half),
                               random.within(-half, half)}) *
                  mk::pose({}, random.rotation()));
  scene.commit();
  mk::NearOptions asked;
  asked.within = within;
  asked.how.threads = 1;
  mk::ScenePairs found = scene.distances(asked);  // the first query builds its data
  double least = INFINITY;
  for (int round = 0; round < options.rounds; ++round) {
    const Clock clock;
    found = scene.distances(asked);
    least = std::min(least, clock.processor());
  }
  table.add(Figure{"near pairs of 100,000 bodies", with_commas(found.size()) + " pairs",
                   text_of("%.3f s", least), "", least, seconds_goal, true});
}

}  // namespace

std::vector<Section> batch_sections() {
  std::vector<Section> sections;
  const auto of_pairs = [&](const char* name, auto measure) {
    sections.push_back(
        {name, [measure](Table& table, const Options& options) {
           const std::vector<NinthBody> bodies = nine_bodies();
           for (std::size_t i = 0; i < bodies.size(); ++i)
             for (std::size_t j = i; j < bodies.size(); ++j)
               measure(table, options,
                       batch_of(bodies[i], bodies[j], queries_of_a_batch * options.queries, true));
         }});
  };
  of_pairs("batches of distances", measure_distances);
  of_pairs("batches of impacts", measure_impacts);
  sections.push_back({"cost of derivatives", measure_derivatives});
  sections.push_back({"threads of batches", measure_threads});
  sections.push_back({"near pairs", measure_near_pairs});
  return sections;
}

}  // namespace bench
