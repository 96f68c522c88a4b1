// SPDX-License-Identifier: MIT
// --check: compares a result with a case's `expect`.
#include <sstream>

#include "renderer/query/answer.h"

namespace minkray {
namespace {

/// Tolerance of normals, which have none of their own: the rounding of a plane through points that
/// are rounded themselves.
constexpr double normal_tolerance = 1e-6;

std::string number(double value) {
  std::ostringstream text;
  text.precision(17);
  text << value;
  return text.str();
}

}  // namespace

std::vector<std::string> complaints(const Query& query, const AnswerFacts& facts) {
  std::vector<std::string> found;
  if (!query.expect) return found;
  const Expectation& expect = *query.expect;
  // Written so that NaN is wrong.
  const auto compare = [&](const std::string& what, double is, double expected, double tolerance) {
    if (std::abs(is - expected) <= tolerance) return;
    found.push_back(what + " is " + number(is) + ", expected " + number(expected) + " (off by " +
                    number(std::abs(is - expected)) + ", allowed " + number(tolerance) + ")");
  };
  const bool gave_up = facts.status == "exhausted" || facts.status == "undecided";
  if (gave_up) found.push_back("status is " + facts.status);
  if (expect.hit && !gave_up) {
    if (facts.hit != *expect.hit && !expect.either)
      found.push_back("status is " + facts.status + ", expected " +
                      (*expect.hit ? "hit or inside" : "miss"));
    if (expect.t && facts.hit) compare("t", facts.t, *expect.t, expect.t_abs_tol);
    if (expect.normal && facts.hit && facts.normal)
      compare("the normal's angle to the expected one", (*facts.normal - *expect.normal).norm(), 0,
              normal_tolerance);
    if (expect.normal && facts.hit && !facts.normal && facts.t > 0)
      found.push_back("there is no normal");
  }
  if (expect.distance) compare("distance", facts.distance, *expect.distance, expect.abs_tol);
  return found;
}

}  // namespace minkray
