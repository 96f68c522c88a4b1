// SPDX-License-Identifier: MIT
// minkray distance: how far apart two shapes are, or how deep in each other, with its proof.
#include <cmath>
#include <iostream>
#include <limits>
#include <memory>

#include "renderer/cli/options.h"
#include "renderer/cli/shape_file.h"
#include "renderer/cli/tolerance_option.h"
#include "renderer/cli/verbs.h"
#include "renderer/query/answer.h"

namespace minkray {
namespace {

struct DistanceVerbOptions {
  std::string a, b;
  double tolerance = AnswerOptions{}.tolerance;
  double at_most = std::numeric_limits<double>::infinity();
  bool only_sign = false;
};

void distance(const DistanceVerbOptions& options) {
  check_tolerance(options.tolerance);
  if (std::isnan(options.at_most)) throw WrongUsage("--at-most: must be a number");
  SignedDistanceQuery query{shape_in(options.a), shape_in(options.b)};
  query.at_most = options.at_most;
  query.only_sign = options.only_sign;
  AnswerOptions how;
  how.tolerance = options.tolerance;
  std::cout << answer({{}, query, {}}, how).json.dump() << '\n';
}

}  // namespace

void add_distance(Parser& parser, ExitCode&) {
  const Verb verb = parser.add_verb("distance");
  const auto options = std::make_shared<DistanceVerbOptions>();
  verb.add_option("a", options->a, "A file with a shape, as scenes have them")
      .required()
      .reads_file();
  verb.add_option("b", options->b, "Another").required().reads_file();
  add_tolerance(verb, options->tolerance);
  verb.add_option("--at-most", options->at_most,
                  "Beyond this distance a lower bound of it is enough");
  verb.add_flag("--only-sign", options->only_sign, "Whether they overlap is enough");
  verb.on_call([options] { distance(*options); });
}

}  // namespace minkray
