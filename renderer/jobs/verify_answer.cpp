// SPDX-License-Identifier: MIT
#include "renderer/jobs/verify_answer.h"

#include <cmath>
#include <cstdio>

#include "renderer/base/csv.h"
#include "renderer/json/number_json.h"

namespace minkray {
namespace {

/// Limit of stretches in text; JSON has all.
constexpr std::size_t most_shown = 10;

std::string number_text(double number, const char* format) {
  char text[40];
  std::snprintf(text, sizeof text, format, number);
  return text;
}

/// Lengths are in metres.
std::string length_text(double length) {
  const double size = std::abs(length);
  if (size >= 1) return number_text(length, "%.3g m");
  if (size >= 0.001 || size == 0) return number_text(1e3 * length, "%.3g mm");
  return number_text(1e6 * length, "%.3g um");
}

class Words {
 public:
  Words(const Plan& plan, const Workcell& cell) : plan_(plan), cell_(cell) {}

  /// Without times, rows are one second apart.
  std::string time(double time) const {
    return plan_.trajectory.has_times ? number_text(time, "%.4g s")
                                      : "row " + number_text(time + 1, "%.5g");
  }
  std::string pair(std::size_t index, const char* between) const {
    const RefereePair& pair = cell_.pairs[index];
    return printable(cell_.bodies[pair.a].name, 60) + between +
           printable(cell_.bodies[pair.b].name, 60);
  }

 private:
  const Plan& plan_;
  const Workcell& cell_;
};

std::string stretch_text(const Stretch& stretch, const Words& words) {
  std::string text = "  " + words.pair(stretch.pair, " and ") +
                     (stretch.collides ? " collide" : " may collide") + " from " +
                     words.time(stretch.begin) + " to " + words.time(stretch.end);
  if (stretch.collides) text += ", at " + words.time(stretch.time);
  // Meshes have no depth.
  if (stretch.collides && stretch.upper < 0) text += " by at least " + length_text(-stretch.upper);
  return text + "\n";
}

Json stretch_json(const Stretch& stretch, const Workcell& cell) {
  const RefereePair& pair = cell.pairs[stretch.pair];
  Json json = {{"a", cell.bodies[pair.a].name},
               {"b", cell.bodies[pair.b].name},
               {"begin", number_json(stretch.begin)},
               {"end", number_json(stretch.end)}};
  if (stretch.collides) {
    json["time"] = number_json(stretch.time);
    json["upper"] = number_json(stretch.upper);
    json["point"] = point_json(stretch.point);
  }
  return json;
}

}  // namespace

std::string verdict_text(const std::string& name, const MotionVerdict& verdict, const Plan& plan,
                         const Workcell& cell) {
  const Words words(plan, cell);
  std::string text = printable(name, 200) + ": " + std::string(name_of(verdict.status));
  const LeastClearance& least = verdict.least;
  if (verdict.status == MotionStatus::free) {
    if (!std::isfinite(least.lower)) return text + ": no pair of bodies can collide\n";
    text += ": every pair stays at least " + length_text(least.lower) + " apart";
    if (std::isfinite(least.upper))
      text += " (" + words.pair(least.pair, ", ") + " at " + words.time(least.time) + ")";
    return text + "\n";
  }
  text += "\n";
  std::size_t shown = 0;
  // Lists stretches that collide first.
  for (const bool collides : {true, false})
    for (const Stretch& stretch : verdict.stretches)
      if (stretch.collides == collides && shown++ < most_shown)
        text += stretch_text(stretch, words);
  if (shown > most_shown)
    text += "  and " + std::to_string(shown - most_shown) + " more (--json lists all)\n";
  return text;
}

std::string steps_table(const MotionVerdict& verdict, const Plan& plan, const Workcell& cell) {
  std::string text = "begin,end,lower,upper,time,a,b\n";
  const std::vector<double>& times = plan.path.times;
  for (std::size_t i = 0; i < verdict.steps.size(); ++i) {
    const LeastClearance& step = verdict.steps[i];
    for (const double number :
         {times[i], times[std::min(i + 1, times.size() - 1)], step.lower, step.upper, step.time})
      text += number_text(number, "%.9g") + ",";
    if (!std::isfinite(step.upper)) {
      text += ",\n";
      continue;
    }
    const RefereePair& pair = cell.pairs[step.pair];
    text += csv_cell(cell.bodies[pair.a].name) + "," + csv_cell(cell.bodies[pair.b].name) + "\n";
  }
  return text;
}

Json verdict_json(const std::string& name, const MotionVerdict& verdict, const Plan& plan,
                  const Workcell& cell) {
  const LeastClearance& least = verdict.least;
  Json json = {{"plan", printable(name)},
               {"status", std::string(name_of(verdict.status))},
               {"lower", number_json(least.lower)},
               {"upper", number_json(least.upper)}};
  if (std::isfinite(least.upper)) {
    const RefereePair& pair = cell.pairs[least.pair];
    json["time"] = number_json(least.time);
    json["a"] = cell.bodies[pair.a].name;
    json["b"] = cell.bodies[pair.b].name;
    json["margin"] = number_json(pair.margin);
    json["point_a"] = point_json(least.distance.point_a);
    json["point_b"] = point_json(least.distance.point_b);
  }
  Json collisions = Json::array(), undecided = Json::array();
  for (const Stretch& stretch : verdict.stretches)
    (stretch.collides ? collisions : undecided).push_back(stretch_json(stretch, cell));
  json["collisions"] = std::move(collisions);
  json["undecided"] = std::move(undecided);
  json["rows"] = plan.path.times.size();
  json["begin"] = number_json(plan.path.times.front());
  json["end"] = number_json(plan.path.times.back());
  json["pairs"] = cell.pairs.size();
  json["distances"] = verdict.distances;
  if (!plan.trajectory.notes.empty()) json["notes"] = plan.trajectory.notes;
  return json;
}

}  // namespace minkray
