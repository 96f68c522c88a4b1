// SPDX-License-Identifier: MIT
// Results of queries, as JSON and for comparison with a case's `expect`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/cast/cast.h"
#include "core/pair_distance/signed_distance.h"
#include "core/proof/check_certificate.h"
#include "renderer/json/json.h"
#include "renderer/paper/subalgorithm.h"
#include "renderer/query/query.h"

namespace minkray {

struct AnswerOptions {
  const Solver* solver = &solver::automatic;
  SubalgorithmKind subalgorithm = SubalgorithmKind::projection;  ///< for distances
  double tolerance = 1e-10;  ///< of signed distances, relative to the shapes' sizes
  bool trace = false;
  bool certify = false;  ///< prove the answers of casts
};

/// Facts of a result that --check compares.
struct AnswerFacts {
  std::string status;
  bool hit = false;  ///< hit or inside
  double t = 0;
  std::optional<Vec3<double>> normal;
  double distance = 0;
};

struct Answer {
  Json json;
  AnswerFacts facts;
  std::optional<CertificateVerdict> verdict;      ///< on the answer's certificate, if requested
  std::optional<SignedDistance> signed_distance;  ///< the result of such a query
};

Answer answer(const Query& query, const AnswerOptions& options);

/// Lists the errors of the answer: empty if it is as expected.
std::vector<std::string> complaints(const Query& query, const AnswerFacts& facts);

}  // namespace minkray
