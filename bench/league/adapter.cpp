// SPDX-License-Identifier: MIT
#include "bench/league/adapter.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <iostream>
#include <nlohmann/json.hpp>

#include "bench/league/query.h"

namespace league {
namespace {

using Json = nlohmann::json;

/// The median of some repetitions, few of slow ones.
double nanoseconds(const Ask& ask) {
  using Clock = std::chrono::steady_clock;
  constexpr int most = 25;
  constexpr double enough = 5e6;
  std::vector<double> times;
  double sum = 0;
  while (static_cast<int>(times.size()) < most && sum < enough) {
    const auto start = Clock::now();
    ask();
    times.push_back(std::chrono::duration<double, std::nano>(Clock::now() - start).count());
    sum += times.back();
  }
  std::nth_element(times.begin(), times.begin() + static_cast<long>(times.size() / 2), times.end());
  return times[times.size() / 2];
}

Json json_of(const Answer& answer, bool is_cast) {
  static constexpr const char* names[] = {"hit",         "miss",   "separated",
                                          "overlapping", "failed", "unsupported"};
  Json json = {{"status", names[static_cast<int>(answer.status)]}};
  if (answer.value) json[is_cast ? "t" : "value"] = *answer.value;
  if (!answer.why.empty()) json["why"] = answer.why;
  return json;
}

Json respond(const Json& json, const Solver& solver) {
  if (json.at("query") == "about")
    return {{"name", solver.name}, {"version", solver.version}, {"settings", solver.settings}};
  try {
    const std::string asked = json.at("query");
    const bool is_cast = asked == "ray" || asked == "shape";
    const Ask ask =
        solver.prepare_line ? solver.prepare_line(json.dump()) : solver.prepare(read_query(json));
    const Answer answer = ask();
    Json out = json_of(answer, is_cast);
    if (answer.status != Answer::Status::unsupported && answer.status != Answer::Status::failed)
      out["ns"] = nanoseconds(ask);
    return out;
  } catch (const Unsupported& shape) {
    return json_of(unsupported(shape.why), true);
  } catch (const std::exception& error) {
    return json_of(failed(error.what()), true);
  }
}

}  // namespace

int serve(int argc, char** argv, const std::vector<Solver>& solvers) {
  const std::string wanted = argc > 1 ? argv[1] : "";
  for (const Solver& solver : solvers) {
    if (solver.name != wanted) continue;
    for (std::string line; std::getline(std::cin, line);)
      std::cout << respond(Json::parse(line), solver).dump() << std::endl;
    return 0;
  }
  for (const Solver& solver : solvers) std::cout << solver.name << '\n';
  return wanted.empty() ? 0 : 2;
}

}  // namespace league
