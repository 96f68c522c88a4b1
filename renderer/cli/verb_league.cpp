// SPDX-License-Identifier: MIT
// minkray league: compares solvers on the hard cases. A separate program, minkray-league
// (bench/league), does the work, since it needs the solvers.
#include <memory>
#include <string>
#include <vector>

#include "renderer/cli/options.h"
#include "renderer/cli/program_beside.h"
#include "renderer/cli/verbs.h"

namespace minkray {
namespace {

/// Describes the options for help only; minkray-league reads the same words.
struct LeagueWords {
  std::vector<std::string> cases, commands;
  std::string only, solvers, html, json;
  bool npm = false, quiet = false;
  int random = 0, seed = 1;
  double limit = 5;
};

}  // namespace

void add_league(Parser& parser, ExitCode&) {
  const Verb verb = parser.add_verb("league");
  const auto words = std::make_shared<LeagueWords>();
  verb.add_option("--cases", words->cases, "Files of cases, in place of all of tests/cases")
      .reads_file();
  verb.add_option("--only", words->only, "Only cases whose names contain this").takes("NAME");
  verb.add_option("--solvers", words->solvers,
                  "Of the solvers that are there, those named, with commas between")
      .takes("NAMES");
  verb.add_flag("--npm", words->npm, "Also MuJoCo 3, Rapier and Jolt, in Node");
  verb.add_option("--exec", words->commands,
                  "Also a solver of your own: a command that answers a query a line, as `minkray "
                  "cast -` does")
      .takes("COMMAND")
      .one_value_each();
  verb.add_option("--random", words->random,
                  "Also so many random rays of each family at each of ten shapes")
      .between(0, 100000)
      .show_default();
  verb.add_option("--seed", words->seed, "Of the random rays").show_default();
  verb.add_option("--limit", words->limit, "Seconds for an answer")
      .between(0.01, 3600.0)
      .show_default();
  verb.add_option("-o,--html", words->html, "A report: case by solver").writes_file();
  verb.add_option("--json", words->json, "A file of all answers and verdicts").writes_file();
  verb.add_flag("-q,--quiet", words->quiet, "No progress");
  verb.on_call([words] { run_beside("league", "minkray-league", own_words()); });
}

}  // namespace minkray
