// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include "renderer/query/answer.h"
#include "renderer/query/query_json.h"
#include "tests/fuzz/messages.h"
#include "tests/fuzz/target.h"

namespace minkray::fuzz {
namespace {

/// A step more is a cast more: inputs must be answered fast enough to try many.
constexpr int most_steps_of_motions = 200;

bool has_null(const Json& numbers) {
  return numbers.dump().find("null") != std::string::npos;
}

std::string check_answer(const Query& query, const AnswerOptions& options) {
  const Answer result = answer(query, options);
  const std::string status = result.facts.status;
  if (status.empty() || status == "unknown") return "no status";
  if (status != "exhausted")
    for (const char* key : {"t", "point", "normal", "distance", "point_a", "point_b"}) {
      const Json* numbers = result.json.find(key);
      if (numbers && has_null(*numbers))
        return std::string(key) + " is not a number: " + result.json.dump();
    }
  // Throws on anything that JSON cannot hold.
  if (result.json.dump().find('\n') != std::string::npos) return "an answer of several lines";
  for (const std::string& complaint : complaints(query, result.facts))
    if (complaint.empty()) return "an empty complaint";
  return "";
}

std::string check_line(std::string_view line) {
  Mistakes mistakes("queries:1");
  MeshFiles meshes("no-such-folder");
  const std::optional<Query> query = parse_query(line, meshes, mistakes);
  if (query.has_value() != mistakes.none())
    return query ? "a query, and mistakes: " + mistakes.text() : "neither a query nor a mistake";
  if (const std::string bad = check_messages(mistakes); !bad.empty()) return bad;
  if (!query) return "";
  if (const auto* shapes = std::get_if<ShapeQuery>(&query->kind))
    if (shapes->turns() && shapes->steps > most_steps_of_motions) return "";
  for (const bool trace : {false, true}) {
    AnswerOptions options;
    options.trace = trace;
    if (const std::string bad = check_answer(*query, options); !bad.empty()) return bad;
  }
  return "";
}

}  // namespace

std::string check_queries(std::string_view bytes) {
  while (!bytes.empty()) {
    const std::string_view line = bytes.substr(0, bytes.find('\n'));
    bytes.remove_prefix(std::min(line.size() + 1, bytes.size()));
    if (const std::string bad = check_line(line); !bad.empty()) return bad;
  }
  return "";
}

}  // namespace minkray::fuzz
