// SPDX-License-Identifier: MIT
// Distances, penetration depths and times of impact of all pairs of nine shapes, compared with FCL,
// libccd, Bullet, ODE, MuJoCo, Minkray's older functions and the speed goals. Prints a table of the
// best round in processor time, one thread; exit code 1 if a goal is missed.
//   contact-bench [--rounds N] [--queries N] [NAME]   NAME: only pairs whose name contains it
// Not timed: making the shapes, converting poses to each library's types.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <optional>

#include "bench/contact/peers.h"
#include "core/pair_motion/impact.h"

namespace {

using namespace minkray;
using namespace minkray::bench;

struct Options {
  std::size_t queries = 1000;
  int rounds = 7;
  std::string name;
};

/// The widest proven bounds, in sizes.
double widest(const Asked& asked) {
  double most = 0;
  for (const Placement& at : asked.where) {
    const SignedDistance found = signed_distance(asked.a.ready, at.a, asked.b.ready, at.b);
    most = std::max(most, (found.upper - found.lower) /
                              (asked.a.ready.ball_radius() + asked.b.ready.ball_radius()));
  }
  return most;
}

class Table {
 public:
  void head() const {
    std::printf(
        "| what | pair | ns | beside | its ns | times | asked | | ours off by | it off by | wrong "
        "of "
        "it |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  }
  /// Ours is the first contestant.
  void row(const char* what, const Asked& asked, const Contestant& ours, const Contestant& other,
           double times, const std::vector<double>& proven) {
    const double ratio = other.nanoseconds / ours.nanoseconds;
    const Errors of_ours = errors(ours.answers, proven), of_other = errors(other.answers, proven);
    const bool holds = times <= 0 || (ratio >= times && of_ours.wrong == 0);
    (holds ? held_ : missed_) += times > 0;
    std::printf("| %s | %s | %.0f | %s | %.0f | %.2f | %s | %s | %.0e | %.0e | %.1f %% |\n", what,
                asked.name().c_str(), ours.nanoseconds, other.name.c_str(), other.nanoseconds,
                ratio, times > 0 ? shortest(times).c_str() : "",
                times > 0 ? (holds ? "held" : "MISSED") : "", of_ours.worst, of_other.worst,
                100.0 * of_other.wrong / static_cast<double>(proven.size()));
    std::fflush(stdout);
  }
  void width(const Asked& asked, double found) {
    constexpr double most = 1e-9;
    const bool holds = found <= most;
    (holds ? held_ : missed_) += 1;
    std::printf("| bounds, in sizes | %s | | | | %.0e | %.0e | %s | | | |\n", asked.name().c_str(),
                found, most, holds ? "held" : "MISSED");
  }
  int finish() const {
    std::printf("\n%d of %d hold\n", held_, held_ + missed_);
    return missed_ > 0 ? 1 : 0;
  }

 private:
  static std::string shortest(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", number);
    return text;
  }
  int held_ = 0, missed_ = 0;
};

/// The fastest of those whose name begins so, but the first two (ours).
const Contestant* fastest(const std::vector<Contestant>& all, const char* begin, std::size_t from) {
  const Contestant* best = nullptr;
  for (std::size_t i = from; i < all.size(); ++i)
    if (all[i].name.starts_with(begin) && (!best || all[i].nanoseconds < best->nanoseconds))
      best = &all[i];
  return best;
}

/// All others, with the goal against the fastest.
void rows(Table& table, const char* what, const Asked& asked, const std::vector<Contestant>& all,
          std::size_t first_other, const Contestant* judged, double times,
          const std::vector<double>& proven) {
  for (std::size_t i = first_other; i < all.size(); ++i)
    table.row(what, asked, all[0], all[i], &all[i] == judged ? times : 0, proven);
}

constexpr double than_before = 3;

void compare_distances(Table& table, const Asked& asked, const Options& options) {
  std::vector<Contestant> all = distances(asked);
  race(all, asked.where.size(), options.rounds);
  std::vector<double> proven;
  for (const Placement& at : asked.where) {
    const SignedDistance found = signed_distance(asked.a.ready, at.a, asked.b.ready, at.b);
    proven.push_back(std::max(0.0, (found.lower + found.upper) / 2));
  }
  const auto is_hard = [](const Everybody& body) {
    return body.name == "cylinder" || body.name == "cone" || body.name == "ellipsoid" ||
           body.is_hull();
  };
  table.row("distance", asked, all[0], all[1], than_before, proven);
  rows(table, "distance", asked, all, 2, fastest(all, "", 2),
       is_hard(asked.a) || is_hard(asked.b) ? 2 : 1, proven);
}

void compare_impacts(Table& table, const Asked& all_asked, const Options& options) {
  // Libraries do not agree on an overlap at the start.
  Asked asked{all_asked.a, all_asked.b, {}};
  std::vector<double> proven;
  for (const Placement& at : all_asked.where) {
    if (signed_distance(asked.a.ready, at.a, asked.b.ready, at.b).lower < 0.01) continue;
    // Computed in another way than the timed one: a turn of next to nothing.
    const RigidMotion still{at.a};
    const RigidMotion moving{at.b, at.motion, Vec3<double>(0, 0, 1e-100)};
    const Impact found = first_impact(asked.a.ready, still, asked.b.ready, moving, 1);
    asked.where.push_back(at);
    proven.push_back(found.status == ImpactStatus::hit ? found.t_lo : no_answer);
  }
  std::vector<Contestant> all = impacts(asked);
  race(all, asked.where.size(), options.rounds);
  table.row("impact", asked, all[0], all[1], than_before, proven);
  double times = 1.4;
  if (asked.a.name == "box" && asked.b.name == "box") times = 5;
  if (asked.a.is_hull() && asked.b.is_hull()) times = 2.5;
  rows(table, "impact", asked, all, 2, fastest(all, "Bullet", 2), times, proven);
}

void compare_depths(Table& table, const Asked& all_asked, const Options& options) {
  Asked asked{all_asked.a, all_asked.b, {}};
  std::vector<double> proven;
  for (const Placement& at : all_asked.where) {
    const SignedDistance found = signed_distance(asked.a.ready, at.a, asked.b.ready, at.b);
    if (found.upper > -1e-3) continue;
    asked.where.push_back(at);
    proven.push_back(-(found.lower + found.upper) / 2);
  }
  std::vector<Contestant> all = depths(asked);
  race(all, asked.where.size(), options.rounds);
  const Contestant* judged = nullptr;
  double times = 0;
  if (asked.a.name == "hull 64" && asked.b.name == "hull 64") {
    judged = fastest(all, "libccd", 1);
    times = 3;
  }
  if (asked.a.name == "box" && asked.b.name == "box") {
    judged = fastest(all, "FCL", 1);
    times = 10;
  }
  rows(table, "depth", asked, all, 1, judged, times, proven);
}

}  // namespace

int main(int count, char** words) {
  Options options;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    if (word == "--rounds" && i + 1 < count)
      options.rounds = std::max(1, std::atoi(words[++i]));
    else if (word == "--queries" && i + 1 < count)
      options.queries = static_cast<std::size_t>(std::max(10, std::atoi(words[++i])));
    else
      options.name = word;
  }
  dInitODE2(0);
  const std::vector<Everybody> shapes = everybody();
  std::printf(
      "%zu queries a pair, best of %d interleaved rounds, one thread, nanoseconds a query.\n\n",
      options.queries, options.rounds);
  Table table;
  table.head();
  for (std::size_t i = 0; i < shapes.size(); ++i)
    for (std::size_t j = i; j < shapes.size(); ++j) {
      Asked asked{shapes[i], shapes[j], {}};
      if (asked.name().find(options.name) == std::string::npos) continue;
      asked.where = placements(shapes[i], shapes[j], options.queries);
      compare_distances(table, asked, options);
      compare_impacts(table, asked, options);
      compare_depths(table, asked, options);
      table.width(asked, widest(asked));
    }
  return table.finish();
}
