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
  verb.add_option("--cases", words->cases, "Files of cases (default: all of tests/cases)")
      .reads_file();
  verb.add_option("--only", words->only, "Run only cases whose names contain this text")
      .takes("NAME");
  verb.add_option("--solvers", words->solvers,
                  "Solvers to run, comma-separated (default: all available)")
      .takes("NAMES");
  verb.add_flag("--npm", words->npm, "Also run MuJoCo 3, Rapier and Jolt (in Node.js)");
  verb.add_option("--exec", words->commands,
                  "Add a solver: a command that works like `minkray cast -`")
      .takes("COMMAND")
      .one_value_each();
  verb.add_option("--random", words->random,
                  "Also cast N random rays for each pair of a shape and a kind of ray")
      .between(0, 100000)
      .show_default();
  verb.add_option("--seed", words->seed, "Random seed for --random").show_default();
  verb.add_option("--limit", words->limit, "Time limit per query in seconds")
      .between(0.01, 3600.0)
      .show_default();
  verb.add_option("-o,--html", words->html,
                  "HTML report to write: a table of all cases and solvers")
      .writes_file();
  verb.add_option("--json", words->json, "JSON file to write: all results and verdicts")
      .writes_file();
  verb.add_flag("-q,--quiet", words->quiet, "Print no progress");
  verb.on_call([words] { run_beside("league", "minkray-league", own_words()); });
}

}  // namespace minkray
