// SPDX-License-Identifier: MIT
#include "renderer/verify/referee.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/parallel/parallel.h"
#include "core/support/named_kind.h"

namespace minkray {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Number of steps processed in sequence, each starting with the planes of the previous one.
constexpr std::size_t steps_in_one_go = 8;

/// Resolution of the ends of stretches, as a part of a step.
constexpr double finest_end = 1.0 / 1024;

/// Parts of a step up to this length have no digits left to halve.
constexpr double finest_part = 0x1p-40;

/// An interval of a pair, to be joined with its neighbours to a stretch.
struct Piece {
  std::size_t pair = 0;
  double begin = 0, end = 0;
  std::optional<Stretch> witness = {};
};

/// Results of some steps.
struct Found {
  LeastClearance least;
  std::vector<LeastClearance> steps;
  std::vector<Piece> pieces;
  std::vector<SeparatingPlane> planes;
  std::vector<std::size_t> without_planes = {};
  std::size_t distances = 0;
};

/// True if the bodies are closer than the margin. Meshes that cross have no depth.
bool is_closer(const SignedDistance& there, double margin) {
  return there.upper - margin < 0 || (there.status == SignedStatus::overlapping && margin <= 0);
}

class StepsSearch {
 public:
  StepsSearch(const JointPath& path, const std::vector<ClearanceBody>& bodies,
              const std::vector<RefereePair>& pairs, const RefereeOptions& options,
              double least_gap)
      : path_(path),
        bodies_(bodies),
        pairs_(pairs),
        options_(options),
        least_gap_(least_gap),
        hints_(pairs.size(), Vec3<double>::Zero()) {}

  /// Measures distances at the rows only. The least one is an upper bound for the whole path.
  LeastClearance sample(std::size_t first, std::size_t last) {
    for (std::size_t step = first; step < last; ++step) {
      StepPairs at(path_, bodies_, step);
      sample_moment(at, 0);
      if (step + 1 == path_.steps()) sample_moment(at, 1);
    }
    return found_.least;
  }

  Found run(std::size_t first, std::size_t last, const LeastClearance& seen) {
    const std::size_t sampled = found_.distances;
    found_ = {};
    found_.distances = sampled;
    found_.least = seen;
    for (std::size_t step = first; step < last; ++step) {
      StepPairs at(path_, bodies_, step);
      if (options_.every_step) {
        found_.least = {};
        sample_moment(at, 0);
        sample_moment(at, 1);
      }
      const std::size_t before = found_.pieces.size();
      for (std::size_t pair = 0; pair < pairs_.size(); ++pair) search_pair(at, pair, step);
      if (!options_.every_step) continue;
      // Pieces that no proof covers have no lower bound.
      const bool is_open = found_.pieces.size() > before;
      LeastClearance& least = found_.least;
      least.lower = is_open ? -infinity : std::min(least.lower, least.upper);
      found_.steps.push_back(least);
    }
    return std::move(found_);
  }

 private:
  /// Least bound that a proof must exceed; otherwise the part is halved.
  double target() const {
    const double upper = found_.least.upper;
    if (!(upper > 0)) return 0;
    const double near = upper - std::max(least_gap_, options_.tolerance * upper);
    return std::max(0.0, std::min(near, options_.enough));
  }

  void sample_moment(StepPairs& at, double s) {
    for (std::size_t index = 0; index < pairs_.size(); ++index) {
      const RefereePair& pair = pairs_[index];
      const double upper = found_.least.upper;
      if (at.lower_by_balls(pair) > upper) continue;
      const StepBound bound = at.bound(pair);
      if (!bound.is_within_numbers) continue;
      Vec3<double>& hint = hints_[index];
      if (!hint.isZero(0) && at.gap(pair, bound, hint, s) - pair.margin > upper) continue;
      const SignedDistance there = distance(at, index, bound, s, std::max(upper, 0.0));
      if (there.lower > 0) hint = there.normal;
    }
  }

  /// Measures the distance, and stores it if it is the least.
  SignedDistance distance(StepPairs& at, std::size_t index, const StepBound& bound, double s,
                          double at_most, bool only_sign = false) {
    const RefereePair& pair = pairs_[index];
    ++found_.distances;
    // Distances below a margin above 0 are no overlap.
    only_sign &= pair.margin == 0 && !has_mesh(pair);
    // Meshes that are further apart have no normal, from which a plane is made.
    if (options_.keep_planes && has_mesh(pair)) at_most = infinity;
    SignedDistance there = at.at(pair, bound, s, at_most + pair.margin, only_sign);
    LeastClearance& least = found_.least;
    if (there.upper - pair.margin < least.upper) {
      least.upper = there.upper - pair.margin;
      least.pair = index;
      least.time = at.time_at(s);
      least.distance = at.in_world(pair, bound, there, s);
    }
    return there;
  }

  struct Part {
    double first, last;
    Vec3<double> hint;
    std::optional<bool> collides_first = {}, collides_last = {};  ///< collisions at the two ends,
                                                                  ///< if known
  };

  void search_pair(StepPairs& at, std::size_t index, std::size_t step) {
    const RefereePair& pair = pairs_[index];
    if (const double by_balls = at.lower_by_balls(pair); by_balls > target()) {
      found_.least.lower = std::min(found_.least.lower, by_balls);
      return;
    }
    const StepBound bound = at.bound(pair);
    if (!bound.is_within_numbers) return add_piece(at, index, 0, 1, {});
    std::vector<Part>& open = open_;
    open.assign(1, {0, 1, hints_[index]});
    std::size_t distances = 0;
    bool has_collided = false;
    std::optional<Stretch> witness;
    while (!open.empty()) {
      const Part part = open.back();
      open.pop_back();
      const double length = part.last - part.first;
      if (!has_collided && proves(at, index, bound, step, part, part.hint)) continue;
      const double middle = part.first + length / 2;
      const double bend = bound.acceleration * length * length / 8;
      const SignedDistance there =
          distance(at, index, bound, middle,
                   target() + bound.speed * length / 2 + bend + least_gap_, has_collided);
      ++distances;
      const bool collides = is_closer(there, pair.margin);
      if (collides && (!has_collided || !witness)) {
        has_collided = true;
        witness = witness_of(at, index, bound, middle, there);
      }
      if (!there.normal.isZero(0) && there.lower > pair.margin &&
          proves(at, index, bound, step, part, there.normal)) {
        hints_[index] = there.normal;
        continue;
      }
      if (proves_by_speed(index, bound, length, there)) continue;
      Part low{part.first, middle, there.normal, part.collides_first, collides},
          high{middle, part.last, there.normal, collides, part.collides_last};
      if (collides) {
        distances += know_ends(at, index, bound, low, high);
        if (*low.collides_first && *high.collides_last) {
          add_piece(at, index, part.first, part.last, witness);
          continue;
        }
      }
      const bool is_fine = has_collided ? length <= finest_end : length <= finest_part;
      if (is_fine || distances >= options_.budget) {
        add_piece(
            at, index, part.first, part.last,
            collides ? witness_of(at, index, bound, middle, there) : std::optional<Stretch>());
        continue;
      }
      open.push_back(std::move(high));
      open.push_back(std::move(low));
    }
  }

  /// True if the plane across n proves the part; the plane is then stored if requested.
  bool proves(StepPairs& at, std::size_t index, const StepBound& bound, std::size_t step,
              const Part& part, const Vec3<double>& n) {
    if (n.isZero(0)) return false;
    const RefereePair& pair = pairs_[index];
    const double length = part.last - part.first;
    const double least = target() + bound.acceleration * length * length / 8 + pair.margin;
    const double at_first = at.gap(pair, bound, n, part.first);
    if (!(at_first > least)) return false;
    const double at_last = at.gap(pair, bound, n, part.last);
    if (!(at_last > least)) return false;
    const double lower = std::min(at_first, at_last) - (least - target());
    found_.least.lower = std::min(found_.least.lower, lower);
    if (options_.keep_planes) found_.planes.push_back({index, step, part.first, part.last, n});
    return true;
  }

  bool has_mesh(const RefereePair& pair) const {
    return bodies_[pair.a].mesh || bodies_[pair.b].mesh;
  }

  /// True if the two cannot reach each other from their poses in the middle of the part. Proves
  /// meshes that are in each other's hollows to be apart.
  bool proves_by_speed(std::size_t index, const StepBound& bound, double length,
                       const SignedDistance& there) {
    const RefereePair& pair = pairs_[index];
    if (!has_mesh(pair) || options_.only_planes) return false;
    const double lower = there.lower - pair.margin - bound.speed * length / 2;
    if (!(lower > target())) return false;
    found_.least.lower = std::min(found_.least.lower, lower);
    if (options_.keep_planes) found_.without_planes.push_back(index);
    return true;
  }

  /// Tests the two outer ends of a part that collides in its middle. Returns the number of tests.
  std::size_t know_ends(StepPairs& at, std::size_t index, const StepBound& bound, Part& low,
                        Part& high) {
    std::size_t asked = 0;
    const auto know = [&](std::optional<bool>& collides, double s) {
      if (collides) return;
      ++asked;
      collides = is_closer(distance(at, index, bound, s, 0, true), pairs_[index].margin);
    };
    know(low.collides_first, low.first);
    know(high.collides_last, high.last);
    return asked;
  }

  Stretch witness_of(StepPairs& at, std::size_t index, const StepBound& bound, double s,
                     const SignedDistance& there) {
    const SignedDistance in_world = at.in_world(pairs_[index], bound, there, s);
    Stretch stretch;
    stretch.pair = index;
    stretch.collides = true;
    stretch.time = at.time_at(s);
    stretch.upper = there.upper - pairs_[index].margin;
    stretch.point = (in_world.point_a + in_world.point_b) / 2;
    return stretch;
  }

  void add_piece(const StepPairs& at, std::size_t index, double first, double last,
                 std::optional<Stretch> witness) {
    found_.pieces.push_back({index, at.time_at(first), at.time_at(last), std::move(witness)});
  }

  const JointPath& path_;
  const std::vector<ClearanceBody>& bodies_;
  const std::vector<RefereePair>& pairs_;
  const RefereeOptions& options_;
  const double least_gap_;
  std::vector<Vec3<double>> hints_;  ///< last normal of a separating plane of each pair; zero: none
  std::vector<Part> open_;
  Found found_;
};

/// Joins adjacent pieces of a pair.
std::vector<Stretch> stretches_of(std::vector<Piece> pieces) {
  std::ranges::stable_sort(pieces, [](const Piece& a, const Piece& b) {
    return a.pair != b.pair ? a.pair < b.pair : a.begin < b.begin;
  });
  std::vector<Stretch> stretches;
  for (const Piece& piece : pieces) {
    const bool goes_on = !stretches.empty() && stretches.back().pair == piece.pair &&
                         piece.begin <= stretches.back().end;
    if (!goes_on) {
      stretches.emplace_back();
      stretches.back().pair = piece.pair;
      stretches.back().begin = piece.begin;
    }
    Stretch& stretch = stretches.back();
    stretch.end = std::max(piece.end, goes_on ? stretch.end : piece.end);
    if (!piece.witness || (stretch.collides && stretch.upper <= piece.witness->upper)) continue;
    const double begin = stretch.begin, end = stretch.end;
    stretch = *piece.witness;
    stretch.begin = begin;
    stretch.end = end;
  }
  return stretches;
}

}  // namespace

std::string_view name_of(MotionStatus status) {
  return name_at({"free", "collides", "undecided"}, status);
}

MotionVerdict verdict_of(const JointPath& path, const std::vector<ClearanceBody>& bodies,
                         const std::vector<RefereePair>& pairs, const RefereeOptions& options) {
  double size = 0;
  for (const RefereePair& pair : pairs)
    size = std::max({size, bodies[pair.a].ball_radius(), bodies[pair.b].ball_radius()});
  constexpr double least_gap = 1e-7;
  const std::size_t steps = path.steps();
  const std::size_t goes = (steps + steps_in_one_go - 1) / steps_in_one_go;
  std::vector<StepsSearch> searches(goes, {path, bodies, pairs, options, least_gap * size});
  const auto for_all = [&](const std::function<void(std::size_t, std::size_t, std::size_t)>& call) {
    parallel_for(goes, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        call(i, i * steps_in_one_go, std::min((i + 1) * steps_in_one_go, steps));
    });
  };
  // Distances at the rows show which pairs need no closer search.
  std::vector<LeastClearance> seen(goes);
  if (!options.every_step)
    for_all([&](std::size_t i, std::size_t first, std::size_t last) {
      seen[i] = searches[i].sample(first, last);
    });
  const auto is_less = [](const LeastClearance& a, const LeastClearance& b) {
    return a.upper < b.upper;
  };
  LeastClearance least = *std::ranges::min_element(seen, is_less);
  std::vector<Found> all(goes);
  for_all([&](std::size_t i, std::size_t first, std::size_t last) {
    all[i] = searches[i].run(first, last, least);
  });

  MotionVerdict verdict;
  std::vector<Piece> pieces;
  for (Found& found : all) {
    verdict.distances += found.distances;
    std::ranges::copy(found.without_planes, std::back_inserter(verdict.without_planes));
    for (LeastClearance& step : found.steps) {
      if (step.upper < least.upper) least = step;
      verdict.steps.push_back(std::move(step));
    }
    if (found.least.upper < least.upper) least = found.least;
    std::ranges::move(found.pieces, std::back_inserter(pieces));
    std::ranges::move(found.planes, std::back_inserter(verdict.planes));
  }
  std::ranges::sort(verdict.without_planes);
  const auto repeated = std::ranges::unique(verdict.without_planes);
  verdict.without_planes.erase(repeated.begin(), repeated.end());
  least.lower = infinity;
  for (const Found& found : all) least.lower = std::min(least.lower, found.least.lower);
  for (const LeastClearance& step : verdict.steps) least.lower = std::min(least.lower, step.lower);
  verdict.stretches = stretches_of(std::move(pieces));
  const bool collides = std::ranges::any_of(verdict.stretches, &Stretch::collides);
  verdict.status = collides                    ? MotionStatus::collides
                   : verdict.stretches.empty() ? MotionStatus::free
                                               : MotionStatus::undecided;
  // With any stretch, undecided or colliding, there is no lower bound.
  if (!verdict.stretches.empty()) least.lower = -infinity;
  least.lower = std::min(least.lower, least.upper);
  verdict.least = least;
  return verdict;
}

}  // namespace minkray
